// The exact reference as if it were a contender: its fingerprints are what all others are held against. Never timed.
import { referencePairs } from '../../build/bench/library.mjs';

export const dimensions = [2, 3];

export function create({ dimensions }) {
  let keys = new Float64Array();
  return {
    update(boxes) {
      keys = referencePairs(boxes, dimensions);
      return keys.length;
    },
    pairs() {
      const pairs = new Uint32Array(2 * keys.length);
      keys.forEach((key, k) => {
        pairs[2 * k] = Math.floor(key / 2 ** 24);
        pairs[2 * k + 1] = key % 2 ** 24;
      });
      return pairs;
    },
  };
}
