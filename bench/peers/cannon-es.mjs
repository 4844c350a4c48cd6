// cannon-es: its sweep and prune by bounding boxes, on bodies whose boxes are written in place. They are added in
// sorted order, so that its insertion sort does not start with the worst case.
import { Body, SAPBroadphase, World } from 'cannon-es';
import { orderAlongX } from './kit/order.mjs';
import { PairList } from './kit/pair-list.mjs';

export const dimensions = [3];

export function create({ count, boxes }) {
  const world = new World();
  const broadphase = new SAPBroadphase(world);
  broadphase.useBoundingBoxes = true;
  const bodies = new Array(count);
  for (const id of orderAlongX(boxes, 3)) {
    const body = new Body({ mass: 1 });
    body.aabbNeedsUpdate = false;
    bodies[id] = body;
    world.addBody(body);
  }
  const ids = new Map(bodies.map((body, id) => [body.id, id]));
  const list = new PairList();
  const first = [];
  const second = [];
  return {
    update(frame) {
      for (let id = 0, k = 0; id < count; id++, k += 6) {
        const body = bodies[id];
        const { lowerBound, upperBound } = body.aabb;
        lowerBound.set(frame[k], frame[k + 1], frame[k + 2]);
        upperBound.set(frame[k + 3], frame[k + 4], frame[k + 5]);
        body.position.set(
          (frame[k] + frame[k + 3]) / 2,
          (frame[k + 1] + frame[k + 4]) / 2,
          (frame[k + 2] + frame[k + 5]) / 2,
        );
        body.boundingRadius =
          Math.hypot(frame[k + 3] - frame[k], frame[k + 4] - frame[k + 1], frame[k + 5] - frame[k + 2]) / 2;
      }
      first.length = 0;
      second.length = 0;
      broadphase.dirty = true;
      broadphase.collisionPairs(world, first, second);
      list.clear();
      for (let k = 0; k < first.length; k++) list.add(ids.get(first[k].id), ids.get(second[k].id));
      return list.count;
    },
    pairs: () => list.pairs(),
  };
}
