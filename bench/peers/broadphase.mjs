// This library, one technique: the frame is copied into the kernel's memory, and the pairs are a view of it.
import { BroadPhase } from '../../build/bench/library.mjs';

export const dimensions = [2, 3];

export function create({ dimensions, count, technique }) {
  const space = new BroadPhase({ dimensions, technique });
  return {
    update(boxes) {
      space.boxes(count).set(boxes);
      space.update();
      return space.pairs.length / 2;
    },
    pairs: () => space.pairs,
  };
}
