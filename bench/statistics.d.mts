export interface Figures {
  median: number;
  mean: number;
  p95: number;
  worst: number;
  range: [number, number];
  frames: number;
}
export function median(values: readonly number[]): number;
export function summary(rounds: readonly (readonly number[])[]): Figures;
export function change(
  before: Pick<Figures, 'median' | 'range'>,
  after: Pick<Figures, 'median' | 'range'>,
): { ratio: number; beyondNoise: boolean };
export function leastOfEach(playings: readonly (readonly number[])[]): number[];
export function spread(times: readonly number[]): { mean: number; p95: number; worst: number };
export function against(
  times: readonly number[],
  others: readonly number[],
  boxes: number,
): { ratio: number; worstRatio: number; worstFrame: number };
export function guessTime(
  points: readonly { count: number; ms: number | undefined }[],
  count: number,
): number | undefined;
