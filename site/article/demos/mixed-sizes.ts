// Boxes of very different sizes: a few giants over a crowd of dwarfs, in a world of 480 by 300.
import { createRandom } from '../../../src/scenes/random.ts';
import type { Box } from './cells.ts';

/** @param giants how many of the boxes are giants */
export function mixedSizes(count: number, giants: number): Box[] {
  const random = createRandom(12);
  const dwarfs = Array.from({ length: count - giants }, (): Box => {
    const side = 3 + 12 * random() ** 2;
    return [random() * (480 - side), random() * (300 - side), side, side];
  });
  const large = Array.from({ length: giants }, (): Box => {
    const [width, height] = [120 + 100 * random(), 90 + 80 * random()];
    return [random() * (480 - width), random() * (300 - height), width, height];
  });
  return [...large, ...dwarfs];
}
