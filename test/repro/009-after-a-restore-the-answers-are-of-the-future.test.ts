// After `restore` pairs and answers were those of the frames that had been taken back, until the next update: games that
// ask first ran out of step. And the very first query saw boxes as they were, later ones as of the last update.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';

const answers = (space: BroadPhase) => ({
  pairs: Array.from(space.pairs),
  count: space.pairCount,
  colliding: [space.isColliding(0, 1), space.isColliding(1, 2), space.isColliding(0, 2)],
  partners: [0, 1, 2, 3].map((id) => space.collisionsOf(id).sort()),
  began: Array.from(space.began),
  ended: Array.from(space.ended),
  box: space.queryBox(0, 0, 100, 100).sort(),
  ray: space.rayCast(-5, 5, 1, 0),
  sweep: space.sweep(-10, 0, -9, 9, 500, 0),
  nearest: space.nearest(60, 60, 9),
});
const make = () => new BroadPhase({ events: true });
const start = (space: BroadPhase) => {
  space.set(0, 0, 0, 10, 10).set(1, 5, 5, 15, 15).set(2, 50, 50, 60, 60).update();
  space.set(2, 8, 8, 18, 18).set(0, 0.1, 0, 10.1, 10).update();
};
const guess = (space: BroadPhase) => {
  space.set(1, 55, 55, 65, 65).update();
  space.delete(0);
  space.set(3, 5, 5, 70, 70).update();
};

describe.each([true, false])('whether it was asked before: %s', (asks) => {
  test('a space that rolled back a prediction answers like one that never predicted', () => {
    const [never, rolled] = [make(), make()];
    for (const space of [never, rolled]) start(space);
    const saved = rolled.snapshot();
    never.snapshot();
    guess(rolled);
    if (asks) answers(rolled);
    rolled.restore(saved);
    expect(answers(rolled)).toEqual(answers(never));
    expect(answers(make().restore(saved))).toEqual(answers(never));
    for (const space of [never, rolled]) space.set(2, 100, 100, 101, 101).update();
    expect(answers(rolled)).toEqual(answers(never));
    expect(Array.from(rolled.ended).length).toBe(4);
  });
});

test.each<[string, (space: BroadPhase) => void]>([
  ['set', (space) => space.set(1, 500, 500, 501, 501)],
  ['a new box', (space) => space.set(9, 5, 5, 6, 6)],
  ['a box with a gap before it', (space) => space.set(70_000, 5, 5, 6, 6)],
  ['a double', (space) => space.set(1, 0.1, 0.1, 0.2, 0.2)],
  ['delete', (space) => space.delete(0)],
  ['clear', (space) => space.clear()],
  ['setAll', (space) => space.setAll([7, 7, 8, 8])],
  ['boxes', (space) => space.boxes(2).fill(3)],
  ['setFilter', (space) => space.setFilter(0, 8, 8)],
])('the first query after %s sees what later ones see: the last update', (_, change) => {
  const [early, late] = [make(), make()];
  for (const space of [early, late]) start(space);
  const expected = answers(early);
  for (const space of [early, late]) change(space);
  expect(answers(late)).toEqual(expected);
  expect(answers(early)).toEqual(expected);
  expect(late.queryBox(0, 0, 99, 99, { mask: 8 })).toEqual(early.queryBox(0, 0, 99, 99, { mask: 8 }));
  for (const space of [early, late]) space.update();
  expect(answers(late)).toEqual(answers(early));
});

test('a large space that was never queried throws instead of answering from other boxes', () => {
  const space = new BroadPhase().setAll(Float32Array.from({ length: 4 * 20_000 }, (_, k) => -1 - (k >> 2))).update();
  space.set(0, 5, 5, 6, 6);
  expect(() => space.queryPoint(0, 0)).toThrow('queryPoint: boxes have changed since the last update');
  expect(() => space.nearest(0, 0, 1, { visit: () => {} })).toThrow('nearest: boxes have changed');
  expect(space.update().queryPoint(5.5, 5.5)).toEqual([0]);
  space.set(0, 7, 7, 8, 8);
  expect(space.queryPoint(5.5, 5.5)).toEqual([0]);
});

test('a restore that is refused leaves the pairs of the last update', () => {
  const space = new BroadPhase({ events: true }).set(0, 0, 0, 1, 1).set(1, 1, 1, 2, 2).update();
  const forged = space.snapshot();
  expect(() => space.restore(forged.subarray(0, 30))).toThrow('restore: ');
  expect(Array.from(space.pairs)).toEqual([0, 1]);
  expect(Array.from(space.began)).toEqual([0, 1]);
});
