import type { Duel, Result } from './techniques.mjs';

export function duellists(results: readonly Result[]): Result[];
export function verdict(names: readonly string[], times: readonly (readonly number[])[]): Duel;
