import type { Notes } from './player.mts';

export interface Difference {
  frame: number;
  saw?: boolean;
  pairs?: number;
  exact?: number;
}
export function difference(notes: Notes[], reference: Notes): Difference | undefined;
