// bvh.js: a bounding volume hierarchy for three.js. It is either rebuilt each frame, or retained, with the boxes that
// moved moved in it. It has no margin: with a margin of 1, pairs of dense3d were missing, for an unknown reason.
import { BVH, HybridBuilder } from 'bvh.js';
import { movingPairs } from './kit/moving-pairs.mjs';

export const dimensions = [2, 3];
export const variants = ['build', 'move'];

export function create({ dimensions, count, boxes, variant }) {
  const hierarchy = new BVH(new HybridBuilder());
  const ids = Array.from({ length: count }, (_, id) => id);
  const rows = ids.map(() => new Float32Array(6));
  const nodes = new Array(count);
  const fill = (row, at) => {
    for (let axis = 0; axis < dimensions; axis++) {
      row[2 * axis] = boxes[at + axis];
      row[2 * axis + 1] = boxes[at + axis + dimensions];
    }
  };
  /** It sorts both arrays in place, so it gets copies. */
  const build = () => {
    const keep = (node) => {
      nodes[node.object] = node;
    };
    hierarchy.clear();
    hierarchy.createFromArray(ids.slice(), rows.slice(), keep);
  };
  for (const id of ids) fill(rows[id], 2 * dimensions * id);
  build();

  const query = new Float32Array(6);
  let tell;
  const hit = (id) => {
    tell(id);
    return false;
  };
  return movingPairs({
    dimensions,
    count,
    boxes,
    move(id, at) {
      if (variant === 'build') return fill(rows[id], at);
      const { box } = nodes[id];
      fill(box, at);
      hierarchy.move(nodes[id], 0);
    },
    ready: variant === 'build' ? build : undefined,
    search(_, at, found) {
      tell = found;
      fill(query, at);
      hierarchy.intersectsBox(query, hit);
    },
  });
}
