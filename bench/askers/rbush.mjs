// rbush, bulk-loaded every frame, as its authors advise if everything moves; and rbush-knn on it.
import RBush from 'rbush';
import knn from 'rbush-knn';
import { most } from '../harness/queries.mjs';
import { fill, objects } from '../peers/kit/tutorial.mjs';

export const dimensions = [2];
export const answers = ['queryBox', 'nearest'];

export function create({ count }) {
  const tree = new RBush();
  const items = objects(count);
  const box = { minX: 0, minY: 0, maxX: 0, maxY: 0 };
  return {
    update(boxes) {
      fill(items, boxes, 2);
      tree.clear().load(items);
    },
    queryBox(q, at) {
      box.minX = q[at];
      box.minY = q[at + 1];
      box.maxX = q[at + 2];
      box.maxY = q[at + 3];
      return idsOf(tree.search(box));
    },
    nearest: (q, at) => idsOf(knn(tree, q[at], q[at + 1], most)),
  };
}

/** In place: each answer is a new array. */
function idsOf(found) {
  for (let k = 0; k < found.length; k++) found[k] = found[k].id;
  return found;
}
