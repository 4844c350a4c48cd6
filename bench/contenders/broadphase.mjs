// This library. The row's `by` says how boxes are given: each by `set`, only those that moved, all in place by
// `boxes()`, or all by `setAll`. Boxes that rest in the scene are set to static.
import { BroadPhase } from '../../build/bench/library.mjs';

export function create({ dimensions, count, boxes: first, fixed = 0, variant, row, scene }) {
  const space = new BroadPhase({ dimensions, technique: variant });
  if (fixed > 0 || scene.movers) {
    space.setAll(first);
    for (let id = 0; id < fixed; id++) space.setStatic(id);
  }
  return {
    give: giving(space, { dimensions, count, fixed, by: row.by, movers: scene.movers }),
    update() {
      space.update();
      return space.pairs.length;
    },
    pairs: () => space.pairs,
    stats: () => ({ bytes: space.stats.bytes, kept: variant === 'auto' && space.stats.technique === 'incremental' }),
    dispose: () => space.dispose(),
  };
}

function giving(space, { dimensions, count, fixed, by, movers }) {
  if (by === 'boxes' && fixed === 0) return (boxes) => space.boxes(count).set(boxes);
  if (by === 'setAll' && fixed === 0) return (boxes) => space.setAll(boxes);
  if (by === 'movers') {
    return (boxes) => {
      for (const id of movers) space.set(id, boxes[4 * id], boxes[4 * id + 1], boxes[4 * id + 2], boxes[4 * id + 3]);
    };
  }
  if (dimensions === 2) {
    return (boxes) => {
      for (let id = fixed, k = 4 * fixed; id < count; id++, k += 4) {
        space.set(id, boxes[k], boxes[k + 1], boxes[k + 2], boxes[k + 3]);
      }
    };
  }
  return (boxes) => {
    for (let id = fixed, k = 6 * fixed; id < count; id++, k += 6) {
      space.set(id, boxes[k], boxes[k + 1], boxes[k + 2], boxes[k + 3], boxes[k + 4], boxes[k + 5]);
    }
  };
}
