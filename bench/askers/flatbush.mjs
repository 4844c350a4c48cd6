// flatbush: rebuilt every frame. It has no ray casts.
import Flatbush from 'flatbush';
import { most } from '../harness/queries.mjs';

export const dimensions = [2];
export const answers = ['queryBox', 'nearest'];

export function create({ count }) {
  let index;
  return {
    update(boxes) {
      index = new Flatbush(count, 16, Float32Array);
      for (let k = 0; k < 4 * count; k += 4) index.add(boxes[k], boxes[k + 1], boxes[k + 2], boxes[k + 3]);
      index.finish();
    },
    queryBox: (q, at) => index.search(q[at], q[at + 1], q[at + 2], q[at + 3]),
    nearest: (q, at) => index.neighbors(q[at], q[at + 1], most),
  };
}
