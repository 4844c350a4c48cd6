// rbush: an R-tree of objects. It is either bulk-loaded each frame, which its authors advise if everything moves, or
// retained, with every box that moved removed and inserted.
import RBush from 'rbush';
import { movingPairs } from './kit/moving-pairs.mjs';
import { PairList } from './kit/pair-list.mjs';

export const dimensions = [2];
export const variants = ['load', 'remove + insert'];

export function create({ count, boxes, variant }) {
  const tree = new RBush();
  const items = Array.from({ length: count }, (_, id) => ({ id, minX: 0, minY: 0, maxX: 0, maxY: 0 }));
  const fill = (item, frame) => {
    const k = 4 * item.id;
    item.minX = frame[k];
    item.minY = frame[k + 1];
    item.maxX = frame[k + 2];
    item.maxY = frame[k + 3];
  };
  if (variant === 'load') {
    const list = new PairList();
    return {
      update(frame) {
        for (const item of items) fill(item, frame);
        tree.clear().load(items);
        list.clear();
        for (const item of items) for (const { id } of tree.search(item)) if (id > item.id) list.add(item.id, id);
        return list.count;
      },
      pairs: () => list.pairs(),
    };
  }
  for (const item of items) fill(item, boxes);
  tree.load(items);
  return movingPairs({
    dimensions: 2,
    count,
    boxes,
    move(id) {
      tree.remove(items[id]);
      fill(items[id], boxes);
      tree.insert(items[id]);
    },
    search(id, _, found) {
      for (const other of tree.search(items[id])) found(other.id);
    },
  });
}
