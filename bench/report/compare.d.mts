export interface Measured {
  median: number;
  range: readonly number[];
}
export function change(before: Measured, after: Measured): { ratio: number; beyondNoise: boolean };
export function compare(before: object, after: object): string;
