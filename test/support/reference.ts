// The exact answer, in doubles and independent of the library: every pair of closed boxes that overlap.
// `referencePairs` sorts along the axis that should need the fewest tests, and sweeps: O(n log n + tests).
// `naivePairs` tests every pair; the sweep is checked against it.
//
// A set of pairs is a sorted Float64Array with one number per pair a < b: a * 2^24 + b.

export type Numbers = ArrayLike<number>;

export const keyOf = (a: number, b: number): number => Math.min(a, b) * 2 ** 24 + Math.max(a, b);

export const pairOf = (key: number): [number, number] => [Math.floor(key / 2 ** 24), key % 2 ** 24];

/** The keys of [a0, b0, a1, b1, …], sorted; a pair given twice occurs twice. */
export function keysOf(pairs: Numbers): Float64Array {
  const keys = new Float64Array(pairs.length / 2);
  for (let k = 0; k < keys.length; k++) keys[k] = keyOf(pairs[2 * k], pairs[2 * k + 1]);
  return keys.sort();
}

/** Whether box `i` of `p` and box `j` of `q` overlap or touch. */
export function overlap(p: Numbers, i: number, q: Numbers, j: number, dimensions: number): boolean {
  for (let axis = 0; axis < dimensions; axis++) {
    const a = 2 * dimensions * i + axis;
    const b = 2 * dimensions * j + axis;
    if (p[a] > q[b + dimensions] || q[b] > p[a + dimensions]) return false;
  }
  return true;
}

/** Box k has the id `ids[k]`, or k itself. */
export function naivePairs(boxes: Numbers, dimensions: number, ids?: Numbers): Float64Array {
  const count = boxes.length / (2 * dimensions);
  const keys: number[] = [];
  for (let i = 0; i < count; i++) {
    for (let j = i + 1; j < count; j++) {
      if (overlap(boxes, i, boxes, j, dimensions)) keys.push(ids ? keyOf(ids[i], ids[j]) : keyOf(i, j));
    }
  }
  return Float64Array.from(keys).sort();
}

export function referencePairs(boxes: Numbers, dimensions: number, ids?: Numbers): Float64Array {
  const { order, sorted, axis } = sortedAlongBestAxis(boxes, dimensions);
  const stride = 2 * dimensions;
  const keys: number[] = [];
  for (let i = 0; i < order.length; i++) {
    const end = sorted[i * stride + dimensions + axis];
    for (let j = i + 1; j < order.length && sorted[j * stride + axis] <= end; j++) {
      if (overlap(sorted, i, sorted, j, dimensions)) {
        keys.push(ids ? keyOf(ids[order[i]], ids[order[j]]) : keyOf(order[i], order[j]));
      }
    }
  }
  return Float64Array.from(keys).sort();
}

function sortedAlongBestAxis(boxes: Numbers, dimensions: number) {
  const stride = 2 * dimensions;
  const count = boxes.length / stride;
  const axes = Array.from({ length: dimensions }, (_, axis) => {
    const mins = Float64Array.from({ length: count }, (_, k) => boxes[k * stride + axis]);
    const ascending = mins.slice().sort();
    let tests = 0;
    for (let k = 0; k < count; k++) {
      tests += atMost(ascending, boxes[k * stride + dimensions + axis]) - atMost(ascending, mins[k]);
    }
    return { axis, mins, tests };
  });
  const { axis, mins } = axes.reduce((best, next) => (next.tests < best.tests ? next : best));
  const order = Uint32Array.from({ length: count }, (_, k) => k);
  order.sort((a, b) => (mins[a] < mins[b] ? -1 : mins[a] > mins[b] ? 1 : 0));
  const sorted = new Float64Array(count * stride);
  order.forEach((from, to) => {
    for (let k = 0; k < stride; k++) sorted[to * stride + k] = boxes[from * stride + k];
  });
  return { order, sorted, axis };
}

/** How many of the ascending values are at most `limit`. */
function atMost(ascending: Float64Array, limit: number): number {
  let low = 0;
  let high = ascending.length;
  while (low < high) {
    const middle = (low + high) >>> 1;
    if (ascending[middle] <= limit) low = middle + 1;
    else high = middle;
  }
  return low;
}
