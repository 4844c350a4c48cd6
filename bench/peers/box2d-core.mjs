// @box2d/core: its dynamic tree of fat boxes. Boxes that moved are moved in it and searched for again.
import core from '@box2d/core';
import { movingPairs } from './kit/moving-pairs.mjs';

export const npm = '@box2d/core';
export const dimensions = [2];

export function create({ count, boxes }) {
  const tree = new core.b2DynamicTree();
  const box = new core.b2AABB();
  const still = new core.b2Vec2(0, 0);
  const at = (k) => {
    box.lowerBound.Set(boxes[k], boxes[k + 1]);
    box.upperBound.Set(boxes[k + 2], boxes[k + 3]);
    return box;
  };
  const proxies = Array.from({ length: count }, (_, id) => tree.CreateProxy(at(4 * id), id));
  let tell;
  const hit = (node) => {
    tell(node.userData);
    return true;
  };
  return movingPairs({
    dimensions: 2,
    count,
    boxes,
    move: (id, k) => tree.MoveProxy(proxies[id], at(k), still),
    search(_, k, found) {
      tell = found;
      tree.Query(at(k), hit);
    },
  });
}
