// quadtree-js: cleared and refilled each frame, as its authors advise. It returns candidates. A leaf holds up to 10
// boxes, and the tree may be as deep as the number of boxes requires.
import Quadtree from '@timohausmann/quadtree-js';
import { PairList } from './kit/pair-list.mjs';

export const npm = '@timohausmann/quadtree-js';
export const dimensions = [2];

const perLeaf = 10;

export function create({ count }) {
  const items = Array.from({ length: count }, (_, id) => ({ id, x: 0, y: 0, width: 0, height: 0 }));
  const levels = Math.max(4, Math.ceil(Math.log(count / perLeaf) / Math.log(4)));
  const list = new PairList();
  return {
    update(boxes) {
      let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
      for (let id = 0, k = 0; id < count; id++, k += 4) {
        const item = items[id];
        item.x = boxes[k];
        item.y = boxes[k + 1];
        item.width = boxes[k + 2] - boxes[k];
        item.height = boxes[k + 3] - boxes[k + 1];
        left = Math.min(left, boxes[k]);
        top = Math.min(top, boxes[k + 1]);
        right = Math.max(right, boxes[k + 2]);
        bottom = Math.max(bottom, boxes[k + 3]);
      }
      const tree = new Quadtree({ x: left, y: top, width: right - left, height: bottom - top }, perLeaf, levels);
      for (const item of items) tree.insert(item);
      list.clear();
      for (let id = 0, a = 0; id < count; id++, a += 4) {
        for (const other of tree.retrieve(items[id])) {
          if (other.id <= id) continue;
          const b = 4 * other.id;
          if (boxes[a] > boxes[b + 2] || boxes[b] > boxes[a + 2]) continue;
          if (boxes[a + 1] > boxes[b + 3] || boxes[b + 1] > boxes[a + 3]) continue;
          list.add(id, other.id);
        }
      }
      return list.count;
    },
    pairs: () => list.pairs(),
  };
}
