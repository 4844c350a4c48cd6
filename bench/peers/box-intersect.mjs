// box-intersect: takes an array of arrays, which is reused and refilled each frame, and calls back with each pair.
import boxIntersect from 'box-intersect';
import { PairList } from './kit/pair-list.mjs';

export const dimensions = [2, 3];

export function create({ dimensions, count }) {
  const stride = 2 * dimensions;
  const list = new PairList();
  const rows = Array.from({ length: count }, () => new Array(stride).fill(0));
  const collect = (a, b) => list.add(a, b);
  return {
    update(boxes) {
      for (let row = 0, k = 0; row < count; row++) {
        for (let column = 0; column < stride; column++, k++) rows[row][column] = boxes[k];
      }
      list.clear();
      boxIntersect(rows, collect);
      return list.count;
    },
    pairs: () => list.pairs(),
  };
}
