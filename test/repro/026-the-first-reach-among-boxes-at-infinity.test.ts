// The first reach has all boxes copied, and infinite bounds rounded to other numbers. If boxes were off or could meet
// nobody, those that had not changed were searched with the numbers they had before, and pairs at infinity were lost.
import { expect, test } from 'vitest';
import { BroadPhase } from '../../src/all.ts';
import { keysOf } from '../support/reference.ts';

const far = Infinity;
const boxes = [
  [far, -5, far, 5],
  [far, 0, far, 10],
  [-20, far, -8, far],
  [-10, far, 0, far],
  [0, -far, 10, -far],
  [5, -far, 15, 3],
  ...Array.from({ length: 14 }, (_, k) => [30 * k, 30 * k, 30 * k + 20, 30 * k + 20]),
];

const runs = BroadPhase.techniques.flatMap((technique) => [0, 1].map((slot) => [technique, slot] as const));
test.each(runs)('pairs at infinity are found, with %s, a reach for box %i', (technique, slot) => {
  const space = new BroadPhase({ technique }).setAll(Float32Array.from(boxes.flat()));
  const off = boxes.length - 1;
  space.setEnabled(off, false).update();
  const before = keysOf(space.pairs);
  expect(before.length).toBe(4);
  space.setReach(slot, 1e-9).update();
  expect(keysOf(space.pairs)).toEqual(before);
  space.setReach(slot, 0).update();
  expect(keysOf(space.pairs)).toEqual(before);
});
