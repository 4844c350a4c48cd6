// A grid as in tutorials, in plain JavaScript: a Map from each cell to its objects, rebuilt each frame. Cells are twice
// as wide as the average box. A Set has the pairs found so far, since two boxes may share several cells.
import { PairList } from './kit/pair-list.mjs';
import { fill, objects } from './kit/tutorial.mjs';

export const npm = null;
export const dimensions = [2, 3];

/** Cells are numbered within ±2^16 per axis: exact in a double in 3D too. */
const half = 2 ** 16;

export function create({ dimensions, count, boxes }) {
  const list = new PairList();
  const entities = objects(count);
  const cellSize = 2 * averageSide(boxes, dimensions);
  const cellOf = (value) => Math.floor(value / cellSize) + half;

  function meet(a, b, seen) {
    if (a.minX > b.maxX || b.minX > a.maxX || a.minY > b.maxY || b.minY > a.maxY) return;
    if (a.minZ > b.maxZ || b.minZ > a.maxZ) return;
    const key = a.id * count + b.id;
    if (seen.has(key)) return;
    seen.add(key);
    list.add(a.id, b.id);
  }

  return {
    update(frame) {
      fill(entities, frame, dimensions);
      const cells = new Map();
      for (const entity of entities) {
        const [lastX, lastY, lastZ] = [cellOf(entity.maxX), cellOf(entity.maxY), cellOf(entity.maxZ)];
        for (let x = cellOf(entity.minX); x <= lastX; x++) {
          for (let y = cellOf(entity.minY); y <= lastY; y++) {
            for (let z = cellOf(entity.minZ); z <= lastZ; z++) {
              const key = (x * 2 * half + y) * 2 * half + z;
              const cell = cells.get(key);
              if (cell) cell.push(entity);
              else cells.set(key, [entity]);
            }
          }
        }
      }
      list.clear();
      const seen = new Set();
      for (const cell of cells.values()) {
        for (let i = 0; i < cell.length; i++) for (let j = i + 1; j < cell.length; j++) meet(cell[i], cell[j], seen);
      }
      return list.count;
    },
    pairs: () => list.pairs(),
  };
}

function averageSide(boxes, dimensions) {
  let sum = 0;
  for (let k = 0; k < boxes.length; k++) sum += k % (2 * dimensions) < dimensions ? -boxes[k] : boxes[k];
  return sum / (boxes.length / 2);
}
