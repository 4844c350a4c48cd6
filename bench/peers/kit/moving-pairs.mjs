// For peers with a retained structure that can be searched: only boxes that moved are moved in it and searched for
// again, and pairs of boxes at rest are retained. A tree of fat boxes gives candidates, so each is tested.
import { PairList } from './pair-list.mjs';

/**
 * `move(id, at)` moves box `id`, whose numbers start at `boxes[at]`. `ready()` is called when all have moved.
 * `search(id, at, found)` calls `found(other)` for every box that may overlap it. They read the frame from `boxes`,
 * which is the same array in all frames.
 */
export function movingPairs({ dimensions, count, boxes, move, ready = () => {}, search }) {
  const stride = 2 * dimensions;
  const known = new boxes.constructor(boxes.length).fill(Number.NaN);
  const moved = new Uint8Array(count);
  const list = new PairList();
  let box = 0;

  function found(other) {
    // Two boxes that both moved are found twice: only the search of the lower id counts.
    if (other === box || (moved[other] && other < box)) return;
    for (let a = stride * box, b = stride * other, axis = 0; axis < dimensions; axis++, a++, b++) {
      if (boxes[a] > boxes[b + dimensions] || boxes[b] > boxes[a + dimensions]) return;
    }
    list.add(box, other);
  }

  return {
    update() {
      for (let id = 0, at = 0; id < count; id++, at += stride) {
        moved[id] = 0;
        for (let k = at; k < at + stride; k++) {
          if (known[k] === boxes[k]) continue;
          known[k] = boxes[k];
          moved[id] = 1;
        }
        if (moved[id]) move(id, at);
      }
      ready();
      list.keep((a, b) => !moved[a] && !moved[b]);
      for (box = 0; box < count; box++) if (moved[box]) search(box, stride * box, found);
      return list.count;
    },
    pairs: () => list.pairs(),
  };
}
