// What was seen: Jest 30 took no two spaces for equal, and a second to find out. It compares what iterating gives, then all
// properties whose keys are symbols, enumerable or not, and a space kept its instance of the kernel in such a property.
import { BroadPhase } from 'broadphase';
import { expect, test } from 'vitest';

test('a space shows comparisons no more than its boxes and its dimensions', () => {
  const space = new BroadPhase().set(7, 0, 0, 1, 1).update();
  expect(space.stats.pairs).toBe(0);
  expect(Object.getOwnPropertySymbols(space)).toEqual([]);
  expect(Object.keys(space)).toEqual(['dimensions']);
});
