// detect-collisions: bodies in its own R-tree, tested as polygons. Bodies that moved are moved, then all are checked.
import { System } from 'detect-collisions';
import { PairList } from './kit/pair-list.mjs';
import { resized } from './kit/resized.mjs';

export const dimensions = [2];

export function create({ count, boxes }) {
  const system = new System();
  const bodies = Array.from({ length: count }, (_, id) => {
    const [minX, minY, maxX, maxY] = boxes.subarray(4 * id, 4 * id + 4);
    return system.createBox({ x: minX, y: minY }, maxX - minX, maxY - minY, { userData: id });
  });
  const list = new PairList();
  const collect = ({ a, b }) => {
    if (a.userData < b.userData) list.add(a.userData, b.userData);
  };
  return {
    update(frame) {
      for (let id = 0, k = 0; id < count; id++, k += 4) {
        const body = bodies[id];
        const width = frame[k + 2] - frame[k];
        const height = frame[k + 3] - frame[k + 1];
        if (resized(body.width, width, frame[k + 2])) body.width = width;
        if (resized(body.height, height, frame[k + 3])) body.height = height;
        if (body.x !== frame[k] || body.y !== frame[k + 1]) body.setPosition(frame[k], frame[k + 1]);
      }
      list.clear();
      system.checkAll(collect);
      return list.count;
    },
    pairs: () => list.pairs(),
  };
}
