import type { SceneName } from '../src/scenes/index.ts';
import type { Case } from './cases.mjs';

export interface Row {
  name: string;
  kind: string;
  scene?: SceneName;
  recording?: string;
  count?: number;
  by?: 'set' | undefined;
  cold?: boolean;
}
export interface Times {
  mean: number;
  p95: number;
  worst: number;
  ratio?: number;
  worstRatio?: number;
  /** From the first frame of the phase. */
  worstFrame?: number;
}
export type Figures = Record<string, Times & { filling: Times; bytes: number }>;
/** Of frames against the same of another: by the mean, and in the worst, and which that is. */
export interface Against {
  ratio: number;
  worstRatio: number;
  worstFrame: number;
}
export interface Played {
  count: number;
  pairs: number;
  kept: number;
  playings: number;
  wrong?: { technique: string; frame: number } | undefined;
}
export const phases: { settled: number; steady: number };
export function rows(cases: Map<string, Case>, traces?: string): Row[];
export function judge(
  answer: Played & { bytes: Record<string, number>; times: number[][][] },
): Played & { figures: Figures; itself: Record<'filling' | 'steady', Against> };
