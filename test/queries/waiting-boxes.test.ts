// Boxes that were set go on waiting while queries are answered: these see the last update. A query may grow the kernel's
// memory, and then the boxes are elsewhere.
import { describe, expect, test } from 'vitest';
import { BroadPhase } from '../../src/index.ts';

const count = 2000;
const side = 50;

/** Boxes at every place of a grid, far from one another; the last id is 3,000 higher if ids have gaps. */
function opened(gaps: boolean): BroadPhase {
  const space = new BroadPhase();
  for (let k = 0; k < count; k++) space.set(idOf(k, gaps), ...placeOf(k));
  return space.update();
}
const idOf = (k: number, gaps: boolean) => (gaps && k === count - 1 ? count + 3000 : k);
const placeOf = (k: number): [number, number, number, number] => {
  const x = (k % side) * 10;
  const y = Math.floor(k / side) * 10;
  return [x, y, x + 1, y + 1];
};

const queries: Record<string, (space: BroadPhase) => unknown> = {
  queryBox: (space) => space.queryBox(-1e9, -1e9, 1e9, 1e9),
  'queryBox with a visitor': (space) => space.queryBox(-1e9, -1e9, 1e9, 1e9, { visit: (id) => id < 100 }),
  queryPlanes: (space) => space.queryPlanes([1, 0, 1e9]),
  rayCastAll: (space) => space.rayCastAll(-5, 0.5, 1, 0),
  nearest: (space) => space.nearest(50, 50, count),
  'rayCast with accept': (space) => space.rayCast(-5, 0.5, 1, 0, { accept: () => false }),
  collisionsOf: (space) => space.collisionsOf(0),
  isColliding: (space) => Array.from({ length: 20 }, (_, k) => space.isColliding(k, k + 1)),
};

describe.each([false, true])('ids with gaps: %s', (gaps) => {
  test.each(Object.keys(queries))('%s in the midst of calls of set', (name) => {
    const space = opened(gaps);
    for (let round = 0; round < 3; round++) {
      for (let k = 0; k < 40; k++) {
        // A new place on top of box 0, which no query may see before the update.
        space.set(k, 0, 0, 1 + k, 1);
        if (k % 3 === 2) space['#inner'].exports.memory.grow(1); // as the query may do
        queries[name]!(space);
        expect(space.queryPoint(0.5, 0.5)).toHaveLength(round === 0 ? 1 : 40);
      }
      for (let k = 0; k < 40; k++) expect(space.get(k)).toEqual(Float64Array.of(0, 0, 1 + k, 1));
      expect(space.update().pairCount).toBe((40 * 39) / 2);
    }
    space.dispose();
  });
});
