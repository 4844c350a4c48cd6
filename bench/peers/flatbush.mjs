// flatbush: a packed R-tree cannot be changed, so it is rebuilt each frame and searched once per box.
import Flatbush from 'flatbush';
import { PairList } from './kit/pair-list.mjs';

export const dimensions = [2];

export function create({ count }) {
  const list = new PairList();
  return {
    update(boxes) {
      const index = new Flatbush(count, 16, boxes.constructor);
      for (let k = 0; k < 4 * count; k += 4) index.add(boxes[k], boxes[k + 1], boxes[k + 2], boxes[k + 3]);
      index.finish();
      list.clear();
      let box = 0;
      const collect = (other) => {
        if (other > box) list.add(box, other);
        return false;
      };
      for (; box < count; box++) {
        const k = 4 * box;
        index.search(boxes[k], boxes[k + 1], boxes[k + 2], boxes[k + 3], collect);
      }
      return list.count;
    },
    pairs: () => list.pairs(),
  };
}
