import type { judge } from './coherence.mjs';

export type PlayedRow = ReturnType<typeof judge> & { name: string; kind: string; nativeMs?: number; problem?: string };

export function coherenceGoals(rows: readonly PlayedRow[]): { goal: string; figure: string; met?: boolean }[];
export function coherenceCells(rows: readonly PlayedRow[]): { titles: string[]; rows: string[][] };
export function coherenceVerdicts(rows: readonly PlayedRow[]): string[][];
