// What every test of a BroadPhase asks in the end: are its pairs the reference's, each once, a < b?
// Compared in one pass with a message of a few pairs, for sets far too large to print.
import { expect } from 'vitest';
import { keysOf, type Numbers, pairOf, referencePairs } from './reference.ts';

interface HasPairs {
  readonly pairs: Uint32Array;
  readonly pairCount: number;
}

export function expectKeys(space: HasPairs, expected: Float64Array): void {
  const { pairs } = space;
  expect(pairs).toBeInstanceOf(Uint32Array);
  expect(pairs.length).toBe(2 * space.pairCount);
  for (let k = 0; k < pairs.length; k += 2) {
    if (!(pairs[k] < pairs[k + 1])) expect.fail(`pair ${k / 2} is [${pairs[k]}, ${pairs[k + 1]}], not a < b`);
  }
  const difference = firstDifference(keysOf(pairs), expected);
  if (difference) expect.fail(difference);
}

/** Updates, then compares with the reference for these boxes (box k has the id ids[k], or k). */
export function expectPairs(
  space: HasPairs & { update(): unknown; readonly dimensions?: number },
  boxes: Numbers,
  dimensions: number,
  ids?: Numbers,
): void {
  space.update();
  expectKeys(space, referencePairs(boxes, dimensions, ids));
}

/** What is wrong with the sorted keys `found`, in words; undefined when nothing is. */
export function firstDifference(found: Float64Array, expected: Float64Array): string | undefined {
  const counts = `${found.length} pairs found, ${expected.length} expected`;
  const name = (key: number) => `[${pairOf(key).join(', ')}]`;
  const length = Math.max(found.length, expected.length);
  for (let k = 0; k < length; k++) {
    if (found[k] === expected[k]) continue;
    if (k > 0 && found[k] === found[k - 1]) return `${name(found[k])} is there twice (${counts})`;
    if (k >= found.length || found[k] > expected[k]) return `${name(expected[k])} is missing (${counts})`;
    return `${name(found[k])} does not overlap (${counts})`;
  }
  return undefined;
}
