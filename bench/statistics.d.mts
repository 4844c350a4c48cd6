export interface Figures {
  median: number;
  mean: number;
  p95: number;
  worst: number;
  frames: number;
}
export function summary(rounds: readonly (readonly number[])[]): Figures;
