// This library, each of its techniques: the frame is copied into the kernel's memory, and the pairs are a view of it.
// Where boxes are known to rest, they are told to be static, and only the others are set, one by one.
import { BroadPhase } from '../../build/bench/library.mjs';

export const npm = null;
export const dimensions = [2, 3];
export const variants = BroadPhase.techniques;

export function create({ dimensions, count, boxes: first, fixed = 0, variant }) {
  const space = new BroadPhase({ dimensions, technique: variant });
  if (fixed > 0) space.setAll(first);
  for (let id = 0; id < fixed; id++) space.setStatic(id);

  function setMoving(boxes) {
    for (let id = fixed, k = 2 * dimensions * fixed; id < count; id++, k += 2 * dimensions) {
      if (dimensions === 2) space.set(id, boxes[k], boxes[k + 1], boxes[k + 2], boxes[k + 3]);
      else space.set(id, boxes[k], boxes[k + 1], boxes[k + 2], boxes[k + 3], boxes[k + 4], boxes[k + 5]);
    }
  }

  return {
    update(boxes) {
      if (fixed > 0) setMoving(boxes);
      else space.boxes(count).set(boxes);
      space.update();
      return space.pairs.length / 2;
    },
    pairs: () => space.pairs,
  };
}
