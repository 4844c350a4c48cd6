// planck: its dynamic tree of fat boxes, which its worlds use for ray casts. What it finds is tested.
import { AABB, internal, Vec2 } from 'planck';
import { lengthOf, overlap, rayEntry, reach } from '../harness/queries.mjs';

export const dimensions = [2];
export const answers = ['queryBox', 'rayCast'];

export function create({ count, boxes: first }) {
  const tree = new internal.DynamicTree();
  const box = new AABB(new Vec2(), new Vec2());
  const still = new Vec2();
  let boxes = first;
  const at = (numbers, k) => {
    box.lowerBound.setNum(numbers[k], numbers[k + 1]);
    box.upperBound.setNum(numbers[k + 2], numbers[k + 3]);
    return box;
  };
  const proxies = Array.from({ length: count }, (_, id) => tree.createProxy(at(boxes, 4 * id), id));
  let query;
  let place;
  let ids;
  const collect = (proxy) => {
    const id = tree.getUserData(proxy);
    if (overlap(boxes, 4 * id, query, place, 2)) ids.push(id);
    return true;
  };
  const ray = { p1: new Vec2(), p2: new Vec2(), maxFraction: 1 };
  let length;
  const meet = (input, proxy) => {
    const id = tree.getUserData(proxy);
    const fraction = (rayEntry(boxes, 4 * id, query, place, 2) * length) / reach;
    if (!(fraction <= input.maxFraction)) return input.maxFraction;
    ids[0] = id;
    return fraction;
  };
  return {
    update(frame) {
      boxes = frame;
      for (let id = 0; id < count; id++) tree.moveProxy(proxies[id], at(boxes, 4 * id), still);
    },
    queryBox(q, k) {
      query = q;
      place = k;
      ids = [];
      tree.query(at(q, k), collect);
      return ids;
    },
    rayCast(q, k) {
      query = q;
      place = k;
      ids = [];
      length = lengthOf(q, k + 2, 2);
      const scale = reach / length;
      ray.p1.setNum(q[k], q[k + 1]);
      ray.p2.setNum(q[k] + scale * q[k + 2], q[k + 1] + scale * q[k + 3]);
      tree.rayCast(ray, meet);
      return ids;
    },
  };
}
