// Brute force as in tutorials, in plain JavaScript: an array of objects, each tested against all after it.
import { PairList } from './kit/pair-list.mjs';
import { fill, objects } from './kit/tutorial.mjs';

export const npm = null;
export const dimensions = [2, 3];

export function create({ dimensions, count }) {
  const list = new PairList();
  const entities = objects(count);
  const flat = dimensions === 2;
  return {
    update(boxes) {
      fill(entities, boxes, dimensions);
      list.clear();
      for (let i = 0; i < count; i++) {
        const a = entities[i];
        for (let j = i + 1; j < count; j++) {
          const b = entities[j];
          if (a.minX <= b.maxX && b.minX <= a.maxX && a.minY <= b.maxY && b.minY <= a.maxY) {
            if (flat || (a.minZ <= b.maxZ && b.minZ <= a.maxZ)) list.add(i, j);
          }
        }
      }
      return list.count;
    },
    pairs: () => list.pairs(),
  };
}
