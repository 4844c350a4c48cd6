// kdbush indexes points: here the centres of the boxes. It finds the centres within half of the largest box from the
// query, and each is tested. It has no nearest neighbours in the plane, so circles are doubled until they hold enough.
import KDBush from 'kdbush';
import { most, overlap, squaredDistance } from '../harness/queries.mjs';

export const dimensions = [2];
export const answers = ['queryBox', 'nearest'];

export function create({ count }) {
  let boxes;
  let index;
  let half = 0; // of the widest box
  let start = 0; // radius of a circle that on average holds as many centres as are wanted
  const found = [];
  const ranks = new Float64Array(most);
  return {
    update(frame) {
      boxes = frame;
      index = new KDBush(count, 64, Float32Array);
      half = 0;
      let right = 0;
      for (let k = 0; k < 4 * count; k += 4) {
        half = Math.max(half, boxes[k + 2] - boxes[k], boxes[k + 3] - boxes[k + 1]);
        right = Math.max(right, boxes[k + 2]);
        index.add((boxes[k] + boxes[k + 2]) / 2, (boxes[k + 1] + boxes[k + 3]) / 2);
      }
      half = (half / 2) * (1 + 1e-6); // and what rounding of the centres may add
      start = right * Math.sqrt(most / count / Math.PI);
      index.finish();
    },
    queryBox(q, at) {
      const ids = index.range(q[at] - half, q[at + 1] - half, q[at + 2] + half, q[at + 3] + half);
      let kept = 0;
      for (const id of ids) if (overlap(boxes, 4 * id, q, at, 2)) ids[kept++] = id;
      ids.length = kept;
      return ids;
    },
    nearest(q, at) {
      for (let radius = start; ; radius *= 2) {
        // A box within `radius` has its centre within that and half of its diagonal.
        const near = index.withinInto(q[at], q[at + 1], radius + half * Math.SQRT2, found);
        const ids = [];
        for (let k = 0; k < near; k++) {
          const rank = squaredDistance(boxes, 4 * found[k], q, at, 2);
          if (rank > radius * radius || (ids.length === most && !(rank < ranks[most - 1]))) continue;
          let place = ids.length === most ? most - 1 : ids.length;
          for (; place > 0 && rank < ranks[place - 1]; place--) {
            ids[place] = ids[place - 1];
            ranks[place] = ranks[place - 1];
          }
          ids[place] = found[k];
          ranks[place] = rank;
        }
        if (ids.length === Math.min(most, count)) return ids;
      }
    },
  };
}
