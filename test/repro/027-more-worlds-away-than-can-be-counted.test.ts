// In a world that wraps around, the number of worlds between a point and a box was infinite where both differ by more
// than 2^1024 worlds. The box then was infinitely far away, instead of somewhere within a world.
import { expect, test } from 'vitest';
import { BroadPhase } from '../../src/all.ts';

test.each([
  [1e300, 0, 1e299],
  [-1e300, 0, 1e299],
  [0, 1e300, 1e280],
  [1e300, 1e300, 1e280],
  [1e300, -1e300, 1e299],
])('a point at %d finds a box at %d within %d', (at, low, radius) => {
  const space = new BroadPhase({ wrap: [7e-21, 1] }).set(3, low, 0.1, low + 1e-21, 0.2).update();
  expect(space.queryCircle(at, 0.5, radius)).toEqual([3]);
  const distances: number[] = [];
  expect(space.nearest(at, 0.5, 1, { distances })).toEqual([3]);
  expect(distances[0]).toBeLessThan(1);
});
