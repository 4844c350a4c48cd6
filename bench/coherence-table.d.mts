import type { Figures, Played } from './coherence.mjs';

export type PlayedRow = Played & { name: string; kind: string; nativeMs?: number; problem?: string; figures: Figures };

export function coherenceGoals(rows: readonly PlayedRow[]): { goal: string; figure: string; met?: boolean }[];
export function coherenceCells(rows: readonly PlayedRow[]): { titles: string[]; rows: string[][] };
export function coherenceVerdicts(rows: readonly PlayedRow[]): string[][];
