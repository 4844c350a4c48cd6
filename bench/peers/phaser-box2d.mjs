// phaser-box2d: Box2D v3's dynamic tree in JavaScript. Boxes that moved are moved in it and searched for again. The
// package cannot be imported by its name, so its file is imported.
import * as box2d from 'phaser-box2d/dist/PhaserBox2D.js';
import { movingPairs } from './kit/moving-pairs.mjs';

export const dimensions = [2];

const all = 1;

export function create({ count, boxes }) {
  const tree = box2d.b2DynamicTree_Create();
  const at = (k) => new box2d.b2AABB(boxes[k], boxes[k + 1], boxes[k + 2], boxes[k + 3]);
  const proxies = Array.from({ length: count }, (_, id) => box2d.b2DynamicTree_CreateProxy(tree, at(4 * id), all, id));
  let tell;
  const hit = (_, id) => {
    tell(id);
    return true;
  };
  return movingPairs({
    dimensions: 2,
    count,
    boxes,
    move: (id, k) => box2d.b2DynamicTree_MoveProxy(tree, proxies[id], at(k)),
    search(_, k, found) {
      tell = found;
      box2d.b2DynamicTree_Query(tree, at(k), all, hit, null);
    },
  });
}
