// The exact answer in a wrapped world, in integers of any size: two boxes are a pair if, along each axis, one can be
// moved by a whole number of worlds so that they overlap or touch.
import { exactly } from './extreme.ts';
import { keyOf } from './reference.ts';

const floor = (a: bigint, b: bigint): bigint => (a >= 0n || a % b === 0n ? a / b : a / b - 1n);

/** How many worlds a place is away from the one that begins at 0. */
export const worldsOf = (place: number, world: number): number => Number(floor(exactly(place), exactly(world)));

function meet(aMin: number, aMax: number, bMin: number, bMax: number, world: number, closed: boolean): boolean {
  if (![aMin, aMax, bMin, bMax].every(Number.isFinite)) return true; // an infinite box reaches all around
  const size = exactly(world);
  if (exactly(aMax) - exactly(aMin) >= size || exactly(bMax) - exactly(bMin) >= size) return true;
  if (!closed) {
    // Strict comparisons: of integers, x < y is x <= y - 1.
    const below = floor(exactly(bMax) - exactly(aMin) - 1n, size);
    return -floor(exactly(aMax) - exactly(bMin) - 1n, size) <= below;
  }
  const most = floor(exactly(bMax) - exactly(aMin), size);
  const least = -floor(exactly(aMax) - exactly(bMin), size);
  return least <= most;
}

/** Whether one lies within the other, if moved by a whole number of worlds. */
function lies(aMin: number, aMax: number, bMin: number, bMax: number, world: number): boolean {
  const size = exactly(world);
  const isFull = (min: number, max: number) =>
    !(Number.isFinite(min) && Number.isFinite(max)) || exactly(max) - exactly(min) >= size;
  if (isFull(bMin, bMax)) return true;
  if (isFull(aMin, aMax)) return false;
  return -floor(exactly(aMin) - exactly(bMin), size) <= floor(exactly(bMax) - exactly(aMax), size);
}

export function wrappedWithin(a: readonly number[], b: readonly number[], wrap: readonly number[]): boolean {
  return wrap.every((world, k) => lies(a[k], a[k + wrap.length], b[k], b[k + wrap.length], world));
}

export function wrappedOverlap(
  a: readonly number[],
  b: readonly number[],
  wrap: readonly number[],
  closed = true,
): boolean {
  return wrap.every((world, k) => meet(a[k], a[k + wrap.length], b[k], b[k + wrap.length], world, closed));
}

/** The sorted keys of the pairs of these boxes, by their ids; `closed`: including those that only touch. */
export function wrappedPairs(
  boxes: ReadonlyMap<number, readonly number[]>,
  wrap: readonly number[],
  closed = true,
): Float64Array {
  const entries = [...boxes];
  const keys: number[] = [];
  entries.forEach(([a, box], k) => {
    for (const [b, other] of entries.slice(k + 1)) if (wrappedOverlap(box, other, wrap, closed)) keys.push(keyOf(a, b));
  });
  return Float64Array.from(keys).sort();
}
