// `boxes()` makes every box float32, rounded to the nearest. It was rounded outward, so that boxes grew.
import { BroadPhase } from 'broadphase';
import { expect, test } from 'vitest';

test.each([2, 3] as const)('a box is rounded like Math.fround, in %i dimensions', (dimensions) => {
  const space = new BroadPhase({ dimensions });
  const boxes = [0.1, 1 / 3, 16777217, -0.7, 1e-50, 1e39].map((x) => Array<number>(2 * dimensions).fill(x));
  space.setAll(boxes.flat());
  expect([...space.boxes(boxes.length)]).toEqual(boxes.flat().map(Math.fround));
  expect(space.get(1, [])).toEqual(boxes[1]!.map(Math.fround));
});

test('boxes further apart than rounding errors are not a pair', () => {
  const space = new BroadPhase();
  space.setAll([0, 0, 0.1, 1, 0.1 + 1e-8, 0, 1, 1]); // nearest: 0.10000000149, 0.10000000894
  space.boxes(2);
  expect(space.update().pairCount).toBe(0);
});
