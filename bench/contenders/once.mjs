// Contenders that find all pairs of boxes in one call. In two colours, the first half of the boxes are red, and only
// pairs of both colours count. Boxes are numbered across both colours, so that results can be compared.
import { findPairs, findPairsBetween } from '../../build/bench/library.mjs';
import { PairList } from '../peers/kit/pair-list.mjs';

export async function create({ boxes, count, variant, row }) {
  const list = new PairList();
  const red = row.between ? count >> 1 : 0;
  const find = await callers[variant](list, count, red, boxes);
  let pairs;
  return {
    update() {
      list.clear();
      pairs = find() ?? list.pairs();
      return pairs.length;
    },
    pairs: () => pairs,
  };
}

const callers = {
  broadphase(_, _count, red, boxes) {
    if (red === 0) return () => findPairs(boxes);
    return () => {
      const pairs = findPairsBetween(boxes.subarray(0, 4 * red), boxes.subarray(4 * red));
      for (let k = 1; k < pairs.length; k += 2) pairs[k] += red;
      return pairs;
    };
  },

  async flatbush(list, count, red, boxes) {
    const { default: Flatbush } = await import('flatbush');
    return () => {
      const index = new Flatbush(count - red, 16, Float64Array);
      for (let id = red, k = 4 * red; id < count; id++, k += 4) {
        index.add(boxes[k], boxes[k + 1], boxes[k + 2], boxes[k + 3]);
      }
      index.finish();
      let box = 0;
      const collect = (other) => {
        if (other + red > box) list.add(box, other + red);
        return false;
      };
      for (const end = red || count; box < end; box++) {
        const k = 4 * box;
        index.search(boxes[k], boxes[k + 1], boxes[k + 2], boxes[k + 3], collect);
      }
    };
  },

  async 'box-intersect'(list, count, red, boxes) {
    const { default: boxIntersect } = await import('box-intersect');
    const rowsOf = (from, end) => {
      const rows = [];
      for (let k = 4 * from; k < 4 * end; k += 4) rows.push([boxes[k], boxes[k + 1], boxes[k + 2], boxes[k + 3]]);
      return rows;
    };
    if (red === 0) return () => void boxIntersect(rowsOf(0, count), (a, b) => list.add(a, b));
    return () => void boxIntersect(rowsOf(0, red), rowsOf(red, count), (a, b) => list.add(a, b + red));
  },

  async rbush(list, count, red, boxes) {
    const { default: RBush } = await import('rbush');
    const itemOf = (id) => {
      const k = 4 * id;
      return { id, minX: boxes[k], minY: boxes[k + 1], maxX: boxes[k + 2], maxY: boxes[k + 3] };
    };
    return () => {
      const items = Array.from({ length: count }, (_, id) => itemOf(id));
      const tree = new RBush().load(items.slice(red));
      for (const item of items.slice(0, red || count)) {
        for (const { id } of tree.search(item)) if (id > item.id) list.add(item.id, id);
      }
    };
  },
};
