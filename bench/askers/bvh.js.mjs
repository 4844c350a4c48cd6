// bvh.js: rebuilt every frame, or retained with every leaf moved. It reports every box that a ray may hit; the first
// hit is kept. In 2D the third axis is 0.
import { BVH, HybridBuilder } from 'bvh.js';
import { lengthOf, rayEntry, reach } from '../harness/queries.mjs';

export const dimensions = [2, 3];
export const answers = ['queryBox', 'rayCast'];
export const variants = ['build', 'move'];

export function create({ dimensions, count, boxes: first, variant }) {
  const stride = 2 * dimensions;
  const hierarchy = new BVH(new HybridBuilder());
  const ids = Array.from({ length: count }, (_, id) => id);
  const rows = ids.map(() => new Float32Array(6));
  const nodes = new Array(count);
  let boxes = first;
  const fill = (row, numbers, at) => {
    for (let axis = 0; axis < dimensions; axis++) {
      row[2 * axis] = numbers[at + axis];
      row[2 * axis + 1] = numbers[at + axis + dimensions];
    }
  };
  const keep = (node) => {
    nodes[node.object] = node;
  };
  const build = () => {
    for (const id of ids) fill(rows[id], boxes, stride * id);
    hierarchy.clear();
    hierarchy.createFromArray(ids.slice(), rows.slice(), keep);
  };
  build();

  const box = new Float32Array(6);
  const origin = new Float32Array(3);
  const direction = new Float64Array(3);
  let query;
  let place;
  let length;
  let found;
  let limit;
  const collect = (id) => {
    found.push(id);
    return false;
  };
  const meet = (id) => {
    const distance = rayEntry(boxes, stride * id, query, place, dimensions) * length;
    if (!(distance <= limit)) return;
    limit = distance;
    found[0] = id;
  };
  return {
    update(frame) {
      boxes = frame;
      if (variant === 'build') return build();
      for (const id of ids) {
        fill(nodes[id].box, boxes, stride * id);
        hierarchy.move(nodes[id], 0);
      }
    },
    queryBox(q, at) {
      found = [];
      fill(box, q, at);
      hierarchy.intersectsBox(box, collect);
      return found;
    },
    rayCast(q, at) {
      query = q;
      place = at;
      found = [];
      limit = reach;
      length = lengthOf(q, at + dimensions, dimensions);
      for (let axis = 0; axis < dimensions; axis++) {
        origin[axis] = q[at + axis];
        direction[axis] = q[at + dimensions + axis] / length;
      }
      hierarchy.rayIntersections(direction, origin, meet, 0, reach);
      return found;
    },
  };
}
