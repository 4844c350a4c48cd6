import type { Plan } from './frames.mjs';
import type { Notes } from './player.mjs';

export interface Difference {
  frame: number;
  saw?: boolean;
  pairs?: number;
  exact?: number;
}
export interface Figures {
  median: number;
  mean: number;
  p95: number;
  worst: number;
}
export interface Entrant {
  name: string;
  peer: string;
  error?: string;
  /** Milliseconds of a frame of one that was too slow to be timed. */
  slow?: number;
  stride?: number;
  count?: number;
  notes?: Notes[];
}
export interface Contender {
  name: string;
  peer: string;
  timed?: number;
  total?: Figures;
  update?: Figures;
  /** The median of its updates divided by those of the first contender in the same frames. */
  share?: number;
  wrong?: Difference;
  error?: string;
  slow?: number;
}
export interface Judged {
  pairs: { mean: number; least: number; most: number };
  frames: number;
  count: number;
  contenders: Contender[];
}
export function judge<Row extends { plan: Plan }>(row: Row, entrants: readonly Entrant[]): Omit<Row, 'plan'> & Judged;
export function difference(notes: readonly Notes[], reference: Notes): Difference | undefined;
