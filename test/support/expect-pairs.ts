// What every test of a BroadPhase checks in the end: its pairs are the reference's, each once, a < b. They are compared
// in one pass, and the message has only a few pairs, since the sets are far too large to print.
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
  if (same(pairs, expected)) return;
  expect.fail(firstDifference(keysOf(pairs), expected) ?? 'the pairs are not the same');
}

/** A hash table of a set of pairs: many spaces can be compared with it without sorting their pairs. */
class Places {
  readonly #pairs: Uint32Array;
  /** By hash: the place of a pair, or -1. */
  readonly #table: Int32Array;
  /** Per pair: the last comparison in which it was found. */
  readonly #seen: Int32Array;
  #comparison = 0;

  constructor(keys: Float64Array) {
    this.#pairs = Uint32Array.from(Array.from(keys, pairOf).flat());
    this.#seen = new Int32Array(keys.length);
    this.#table = new Int32Array(2 ** Math.ceil(Math.log2(2 * keys.length + 2))).fill(-1);
    for (let place = 0; place < keys.length; place++) {
      this.#table[this.#slot(this.#pairs[2 * place], this.#pairs[2 * place + 1])] = place;
    }
  }

  /** The index of a pair in the table, or of the gap for it. */
  #slot(a: number, b: number): number {
    const pairs = this.#pairs;
    const table = this.#table;
    const mask = table.length - 1;
    let at = ((Math.imul(a, 0x9e3779b1) ^ Math.imul(b, 0x85ebca6b)) >>> 7) & mask;
    for (let place = table[at]; place >= 0; place = table[at]) {
      if (pairs[2 * place] === a && pairs[2 * place + 1] === b) return at;
      at = (at + 1) & mask;
    }
    return at;
  }

  /** Whether these are exactly those pairs, each once. */
  are(pairs: Uint32Array): boolean {
    if (pairs.length !== this.#pairs.length) return false;
    this.#comparison++;
    for (let k = 0; k < pairs.length; k += 2) {
      const place = this.#table[this.#slot(pairs[k], pairs[k + 1])];
      if (place < 0 || this.#seen[place] === this.#comparison) return false;
      this.#seen[place] = this.#comparison;
    }
    return true;
  }
}

const known = new WeakMap<Float64Array, Places | 'once'>();

/** From its second use on, a set is compared by its table. For one use, sorting the pairs is faster. */
function same(pairs: Uint32Array, expected: Float64Array): boolean {
  const places = known.get(expected);
  if (places === undefined) {
    known.set(expected, 'once');
    return firstDifference(keysOf(pairs), expected) === undefined;
  }
  if (places !== 'once') return places.are(pairs);
  const made = new Places(expected);
  known.set(expected, made);
  return made.are(pairs);
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

/** Expects the same pairs, in any order. Faster than `toEqual` of their keys. */
export function expectSamePairs(found: Uint32Array, expected: Uint32Array, what: string): void {
  const difference = firstDifference(keysOf(found), keysOf(expected));
  if (difference) expect.fail(`${what}: ${difference}`);
}

/** Expects the same numbers in the same order. Faster than `toEqual`, which compares every property. */
export function expectSameWords(found: Uint32Array, expected: Uint32Array, what: string): void {
  if (found.length !== expected.length) expect.fail(`${what}: ${found.length} numbers, expected ${expected.length}`);
  for (let k = 0; k < found.length; k++) {
    if (found[k] !== expected[k]) expect.fail(`${what}: number ${k} is ${found[k]}, expected ${expected[k]}`);
  }
}

/** What is wrong with the sorted keys `found`, in words; undefined if nothing is. */
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
