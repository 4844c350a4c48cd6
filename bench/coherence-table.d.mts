import type { Figures, Played } from './coherence.mjs';

export function coherenceGoals(
  rows: readonly (Played & { name: string; kind: string; nativeMs?: number; figures: Figures })[],
): { goal: string; figure: string; met?: boolean }[];
