// This library, each of its techniques: the frame is copied into the kernel's memory, and the pairs are a view of it.
import { BroadPhase } from '../../build/bench/library.mjs';

export const npm = null;
export const dimensions = [2, 3];
export const variants = BroadPhase.techniques;

export function create({ dimensions, count, variant }) {
  const space = new BroadPhase({ dimensions, technique: variant });
  return {
    update(boxes) {
      space.boxes(count).set(boxes);
      space.update();
      return space.pairs.length / 2;
    },
    pairs: () => space.pairs,
  };
}
