// p2-es: its sweep and prune, on bodies whose bounding boxes are written in place. They are added in sorted order, so
// that its insertion sort does not start with the worst case.
import { Body, Box, SAPBroadphase, World } from 'p2-es';
import { orderAlongX } from './kit/order.mjs';
import { PairList } from './kit/pair-list.mjs';

export const dimensions = [2];

export function create({ count, boxes }) {
  const broadphase = new SAPBroadphase();
  const world = new World({ broadphase, gravity: [0, 0] });
  const bodies = new Array(count);
  for (const id of orderAlongX(boxes, 2)) {
    const body = new Body({ mass: 1 });
    body.addShape(new Box({ width: 1, height: 1 }));
    body.aabbNeedsUpdate = false;
    bodies[id] = body;
    world.addBody(body);
  }
  const ids = new Map(bodies.map((body, id) => [body.id, id]));
  const list = new PairList();
  return {
    update(frame) {
      for (let id = 0, k = 0; id < count; id++, k += 4) {
        const { aabb, position } = bodies[id];
        aabb.lowerBound[0] = frame[k];
        aabb.lowerBound[1] = frame[k + 1];
        aabb.upperBound[0] = frame[k + 2];
        aabb.upperBound[1] = frame[k + 3];
        position[0] = (frame[k] + frame[k + 2]) / 2;
        position[1] = (frame[k + 1] + frame[k + 3]) / 2;
      }
      const found = broadphase.getCollisionPairs(world);
      list.clear();
      for (let k = 0; k < found.length; k += 2) list.add(ids.get(found[k].id), ids.get(found[k + 1].id));
      return list.count;
    },
    pairs: () => list.pairs(),
  };
}
