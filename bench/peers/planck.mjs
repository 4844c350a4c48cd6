// planck: its dynamic tree of fat boxes. Boxes that moved are moved in it and searched for again.
import { AABB, internal, Vec2 } from 'planck';
import { movingPairs } from './kit/moving-pairs.mjs';

export const dimensions = [2];

export function create({ count, boxes }) {
  const tree = new internal.DynamicTree();
  const box = new AABB(new Vec2(), new Vec2());
  const still = new Vec2();
  const at = (k) => {
    box.lowerBound.setNum(boxes[k], boxes[k + 1]);
    box.upperBound.setNum(boxes[k + 2], boxes[k + 3]);
    return box;
  };
  const proxies = Array.from({ length: count }, (_, id) => tree.createProxy(at(4 * id), id));
  let tell;
  const hit = (proxy) => {
    tell(tree.getUserData(proxy));
    return true;
  };
  return movingPairs({
    dimensions: 2,
    count,
    boxes,
    move: (id, k) => tree.moveProxy(proxies[id], at(k), still),
    search(_, k, found) {
      tell = found;
      tree.query(at(k), hit);
    },
  });
}
