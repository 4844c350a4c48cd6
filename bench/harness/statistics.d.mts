import type { Figures } from './judge.mjs';

export function mean(values: readonly number[]): number;
export function median(values: readonly number[]): number;
export function quantile(values: readonly number[], share: number): number;
export function spread(times: readonly number[]): Figures & { range: [number, number] };
export function leastOfEach(playings: readonly (readonly number[])[]): number[];
