// Blocks of boxes that all are at infinity have no size as a number: infinity less infinity is none. `nearestsOfAll`
// took such blocks to be too far away once it had found a box that touches.
import { BroadPhase } from 'broadphase';
import { expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';

test.each([2, 3] as const)('of boxes at infinity the first is the nearest to all, in %i dimensions', (dimensions) => {
  const random = createRandom(25);
  const space = new BroadPhase({ dimensions });
  const count = 200;
  const boxes: number[] = [];
  for (let id = 0; id < count; id++) {
    const size = Array.from({ length: dimensions - 1 }, () => Math.floor(1000 * random()));
    boxes.push(Number.POSITIVE_INFINITY, ...size.map((x) => -x)); // all have the origin of the other axes in them
    boxes.push(Number.POSITIVE_INFINITY, ...size.map(() => Math.floor(1000 * random())));
  }
  const { ids, distances } = space.setAll(boxes).update().nearestsOfAll(1);
  expect([...ids]).toEqual(Array.from({ length: count }, (_, id) => (id === 0 ? 1 : 0)));
  expect(new Set(distances)).toEqual(new Set([0]));
});
