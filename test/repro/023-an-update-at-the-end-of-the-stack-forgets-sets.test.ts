// An update, or any other call, that ran out of stack dropped the boxes that were set before it.
import { expect, test } from 'vitest';
import { BroadPhase } from '../../src/all.ts';

const calls: Record<string, (space: BroadPhase) => unknown> = {
  update: (space) => space.update(),
  get: (space) => space.get(1),
  setFilter: (space) => space.setFilter(1, 1, 1),
  queryBox: (space) => space.queryBox(0, 0, 9, 9),
  nearest: (space) => space.nearest(0, 0, 1),
  collisionsOf: (space) => space.collisionsOf(1),
  setAlone: (space) => space.set(900_000, 70, 70, 71, 71),
};

test.each(Object.keys(calls))('boxes that were set wait on if %s runs out of stack', { tags: 'long' }, (name) => {
  let failed = 0;
  const lost: number[] = [];
  for (let round = 0; round < 300; round++) {
    const space = new BroadPhase().set(1, 0, 0, 1, 1).set(2, 5, 5, 6, 6);
    if (round & 1) space.update();
    if (round & 2) space.delete(2); // ids have gaps from now on
    if (round & 2) space.set(7, 5, 5, 6, 6).update();
    space.set(1, 5, 5, 6, 6).set(3, 5, 5, 6, 6);
    let errors = 0;
    let done = false;
    // On the way up from the end of the stack, until it works.
    const dive = (): void => {
      try {
        dive();
      } catch {
        if (done) return;
        try {
          calls[name]!(space);
          done = true;
        } catch {
          errors++;
          throw new RangeError('the end of the stack');
        }
      }
    };
    const deeper = (levels: number): void => (levels === 0 ? dive() : deeper(levels - 1));
    deeper(round % 97);
    failed += errors > 0 ? 1 : 0;
    space.setFilter(1, 1, 1).setFilter(3, 1, 1);
    if (round % 4 < 2) space.setFilter(2, 1, 1);
    else space.setFilter(7, 1, 1);
    if (space.update().pairCount !== 3) lost.push(round);
  }
  expect(failed).toBeGreaterThan(100);
  expect(lost).toEqual([]);
});
