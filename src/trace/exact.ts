// The exact pairs, computed without the kernel, to check a replay. Sorts along one axis and sweeps, in doubles. A set
// of pairs is a sorted Float64Array with one number per pair: the smaller id times 2^24, plus the larger.
import { badValue, checkBoolean, checkWrap } from '../errors.ts';
import type { Own } from '../watch.ts';
import { checkBoxes, checkLength, marks } from './format.ts';

const idLimit = 2 ** 24;

/**
 * The pairs of boxes that overlap and may meet. Box k has the id `ids[k]`, or k; `rules` are those of {@link
 * Frame.rules}. `own` has the groups and reaches of the boxes, and says whether boxes that only touch are pairs, which is
 * true by default. In a world that wraps around, all pairs of boxes are compared.
 *
 * @param given minima then maxima, box after box
 * @throws RangeError for dimensions other than 2 and 3, for a box with NaN or a minimum above its maximum, for a bad size
 *   of the world, and if lengths do not fit; TypeError for anything but arrays
 * @returns the sorted set of pairs, one number for each: the smaller id times 2^24, plus the larger
 *
 * @example
 * exactPairs([0, 0, 10, 10, 5, 5, 15, 15], 2); // → Float64Array [1]
 */
export function exactPairs(
  given: ArrayLike<number>,
  dimensions: 2 | 3,
  ids?: ArrayLike<number>,
  rules?: ArrayLike<number>,
  wrap?: readonly number[],
  own: Own & { touching?: boolean | undefined } = {},
): Float64Array {
  if (dimensions !== 2 && dimensions !== 3) badValue('dimensions', dimensions, '2 or 3');
  if (typeof given !== 'object' || !Number.isInteger(given?.length))
    badValue('boxes', given, 'an array of numbers', true);
  const count = Math.floor(given.length / (2 * dimensions));
  checkLength('boxes', given, 2 * dimensions * count);
  checkBoxes('exactPairs', given, dimensions);
  checkLength('ids', ids, count);
  checkLength('rules', rules, 3 * count);
  checkLength('groups', own.groups, count);
  checkLength('reaches', own.reaches, count);
  if (wrap !== undefined) checkWrap(wrap, dimensions);
  const apart = (a: number, b: number) => (rules && !mayMeet(rules, 3 * a, 3 * b)) || areOne(own.groups, a, b);
  const closed = own.touching ?? true;
  checkBoolean('touching', closed);
  const boxes = own.reaches ? grownBy(own.reaches, given, dimensions) : given;
  if (wrap) return wrappedPairs(boxes, wrap, ids, apart, closed);
  const width = 2 * dimensions;
  const axis = longestAxis(boxes, dimensions);
  const starts = Float64Array.from({ length: count }, (_, box) => boxes[box * width + axis]);
  const order = Uint32Array.from(starts, (_, box) => box).sort((a, b) =>
    starts[a] < starts[b] ? -1 : starts[a] > starts[b] ? 1 : 0,
  );
  const others = [0, 1, 2].slice(0, dimensions).filter((other) => other !== axis || !closed);
  const keys: number[] = [];
  for (let i = 0; i < count; i++) {
    const box = order[i];
    const at = box * width;
    const end = boxes[at + dimensions + axis];
    for (let j = i + 1; j < count && starts[order[j]] <= end; j++) {
      const other = order[j];
      let misses = false;
      for (const a of others) {
        const p = at + a;
        const q = other * width + a;
        misses ||= !(closed
          ? boxes[p] <= boxes[q + dimensions] && boxes[q] <= boxes[p + dimensions]
          : boxes[p] < boxes[q + dimensions] && boxes[q] < boxes[p + dimensions]);
      }
      if (!(misses || apart(box, other))) keys.push(ids ? key(ids[box], ids[other]) : key(box, other));
    }
  }
  return Float64Array.from(keys).sort();
}

function wrappedPairs(
  boxes: ArrayLike<number>,
  wrap: readonly number[],
  ids: ArrayLike<number> | undefined,
  apart: (a: number, b: number) => boolean,
  closed: boolean,
): Float64Array {
  const d = wrap.length;
  const count = boxes.length / (2 * d);
  const keys: number[] = [];
  for (let i = 0; i < count; i++) {
    for (let j = i + 1; j < count; j++) {
      if (apart(i, j)) continue;
      const [p, q] = [2 * d * i, 2 * d * j];
      const meet = wrap.every((size, a) =>
        wrapsOver(boxes[p + a], boxes[p + d + a], boxes[q + a], boxes[q + d + a], size, closed),
      );
      if (meet) keys.push(ids ? key(ids[i], ids[j]) : key(i, j));
    }
  }
  return Float64Array.from(keys).sort();
}

/** Whether the two overlap if one is shifted by some whole number of worlds. A box that covers the world meets all. */
function wrapsOver(aMin: number, aMax: number, bMin: number, bMax: number, size: number, closed: boolean): boolean {
  if (![aMin, aMax, bMin, bMax].every(Number.isFinite)) return true; // it covers the world
  const most = (bMax - aMin) / size;
  const least = (bMin - aMax) / size;
  // Whether an integer lies between the two; computed exactly if rounding may have crossed one, or if they overflow.
  const rounded = 1e-12 + 1e-15 * ((Math.abs(aMin) + Math.abs(aMax) + Math.abs(bMin) + Math.abs(bMax)) / size);
  const sure = (x: number) => Math.abs(x - Math.round(x)) > rounded && Math.abs(x) < 1e9;
  if (sure(most) && sure(least)) return Math.ceil(least) <= Math.floor(most);
  const world = whole(size);
  const [a, c, b, d] = [whole(aMin), whole(aMax), whole(bMin), whole(bMax)];
  if (closed || c - a >= world || d - b >= world) return floorOf(d - a, world) >= -floorOf(c - b, world);
  return floorOf(d - a - 1n, world) >= -floorOf(c - b - 1n, world);
}

const floorOf = (a: bigint, b: bigint): bigint => (a >= 0n || a % b === 0n ? a / b : a / b - 1n);

/** A double in units of the smallest positive one. */
function whole(x: number): bigint {
  const bits = new BigUint64Array(Float64Array.of(x).buffer)[0]!;
  const exponent = (bits >> 52n) & 0x7ffn;
  const fraction = bits & 0xfffffffffffffn;
  const size = exponent === 0n ? fraction : (fraction | 0x10000000000000n) << (exponent - 1n);
  return x < 0 ? -size : size;
}

/** The pairs [a, b, a, b, …] as a sorted set, in which duplicates remain. */
export function pairKeys(pairs: ArrayLike<number>): Float64Array {
  return Float64Array.from({ length: pairs.length / 2 }, (_, k) => key(pairs[2 * k], pairs[2 * k + 1])).sort();
}

/** How two sets of pairs differ. */
export interface Difference {
  /** How many pairs were expected and not found. */
  missing: number;
  /** How many were found but not expected, or twice. */
  extra: number;
  /** The first pair of either kind. */
  pair: [number, number];
}

/** How the pairs `found` differ from those expected; `undefined` if they do not. */
export function differenceOf(found: Float64Array, expected: Float64Array): Difference | undefined {
  let missing = 0;
  let extra = 0;
  let first = Number.NaN;
  for (let f = 0, e = 0; f < found.length || e < expected.length; ) {
    if (found[f] === expected[e]) {
      f++;
      e++;
      continue;
    }
    const isExtra = e >= expected.length || found[f] < expected[e];
    if (Number.isNaN(first)) first = isExtra ? found[f] : expected[e];
    if (isExtra) {
      extra++;
      f++;
    } else {
      missing++;
      e++;
    }
  }
  return missing + extra > 0 ? { missing, extra, pair: [Math.floor(first / idLimit), first % idLimit] } : undefined;
}

/** Whether each one's layer is in the other's mask, at most one is static, and neither is off. */
function mayMeet(rules: ArrayLike<number>, a: number, b: number): boolean {
  const filtered = (rules[a] & rules[b + 1]) !== 0 && (rules[b] & rules[a + 1]) !== 0;
  const off = (rules[a + 2] | rules[b + 2]) & marks.off;
  return filtered && !off && !(rules[a + 2] & rules[b + 2] & marks.still);
}

/** Boxes enlarged by their reaches. */
const grownBy = (reaches: ArrayLike<number>, boxes: ArrayLike<number>, dimensions: number): Float64Array =>
  Float64Array.from(boxes, (x, k) => {
    const reach = reaches[Math.floor(k / (2 * dimensions))];
    return k % (2 * dimensions) < dimensions ? x - reach : x + reach;
  });

/** Whether two boxes are in the same group. */
const areOne = (groups: ArrayLike<number> | undefined, a: number, b: number): boolean =>
  groups !== undefined && groups[a] !== 0 && groups[a] === groups[b];

const key = (a: number, b: number): number => (a < b ? a * idLimit + b : b * idLimit + a);

/** The axis along which the boxes are spread furthest, measured in their usual extent. */
function longestAxis(boxes: ArrayLike<number>, dimensions: number): number {
  const width = 2 * dimensions;
  const count = boxes.length / width;
  let best = 0;
  let longest = -1;
  for (let axis = 0; axis < dimensions; axis++) {
    const starts = Float64Array.from({ length: count }, (_, box) => boxes[box * width + axis]).sort();
    const extents = Float64Array.from(
      { length: count },
      (_, box) => boxes[box * width + dimensions + axis] - boxes[box * width + axis],
    ).sort();
    const spread = starts[Math.floor(0.9 * count)] - starts[Math.floor(0.1 * count)];
    const ratio = spread / (extents[count >> 1] + Number.MIN_VALUE);
    if (ratio > longest) {
      longest = ratio;
      best = axis;
    }
  }
  return best;
}
