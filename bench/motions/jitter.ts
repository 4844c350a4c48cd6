// A given number of boxes jitter by up to half their side around their places, in every frame, while all others rest.
import { Bodies } from './bodies.ts';
import type { MotionScene } from './index.ts';

export function createJitter(count: number, movers: number, seed: number): MotionScene & { movers: Uint32Array } {
  const bodies = new Bodies(2, count, seed);
  const { at, boxes, world, sides } = bodies;
  const homes = at.slice();
  // Picked at random: ids are unrelated to positions.
  const ids = Uint32Array.from({ length: movers }, (_, k) => Math.floor((k * count) / movers));
  return {
    dimensions: 2,
    count,
    boxes,
    world,
    movers: ids,
    step() {
      for (const id of ids) {
        for (let k = 2 * id; k < 2 * id + 2; k++) at[k] = homes[k] + bodies.symmetric(sides[id] / 2);
        bodies.put(id, id + 1);
      }
    },
  };
}
