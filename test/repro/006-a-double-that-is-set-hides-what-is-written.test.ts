// A view that `boxes()` gave is written after a double was `set`: the pairs are those of the numbers given last.
import { BroadPhase } from 'broadphase';
import { expect, test } from 'vitest';

test.each([20.1, 20.5])('what is written by the view counts beside a box at %d that was set', (x) => {
  const space = new BroadPhase();
  const boxes = space.boxes(3);
  space.set(2, x, 0, x + 1, 1);
  expect([...boxes.subarray(8)]).toEqual([x, 0, x + 1, 1].map(Math.fround));
  boxes.set([20, 0, 21, 1, 40, 0, 41, 1]);
  expect([...space.update().pairs]).toEqual([0, 2]);
  expect(space.validate().get(2, [])).toEqual([x, 0, x + 1, 1]);
});

test('what is written by the view counts instead of the double that was set before', () => {
  const space = new BroadPhase();
  const boxes = space.boxes(2);
  space.set(1, 0.1, 0.1, 0.2, 0.2);
  boxes.set([5, 5, 6, 6], 4);
  expect(space.get(1, [])).toEqual([5, 5, 6, 6]);
  boxes.set([5.5, 5.5, 7, 7], 0);
  expect([...space.update().pairs]).toEqual([0, 1]);
  space.set(0, 0.3, 0.3, 0.7, 0.7);
  expect(space.update().pairCount).toBe(0);
  expect(space.validate().get(0, [])).toEqual([0.3, 0.3, 0.7, 0.7]);
});

test('a bad number written over a double is named, and a good one repairs it', () => {
  const space = new BroadPhase();
  const boxes = space.boxes(2);
  space.set(1, 0.1, 0.1, 0.2, 0.2).update();
  const view = space.boxes(2);
  space.set(1, 0.1, 0.1, 0.2, 0.2);
  view[4] = Number.NaN;
  expect(() => space.update()).toThrow(/^update: minX of box 1 is NaN/);
  space.set(1, 0.1, 0.1, 0.3, 0.3);
  expect(space.update().pairCount).toBe(0);
  expect(space.get(1, [])).toEqual([0.1, 0.1, 0.3, 0.3]);
  expect(boxes.length).toBe(8);
});

test('writing to a view that growing memory detached between boxes() and update() is noticed', () => {
  const space = new BroadPhase();
  const view = space.boxes(2);
  for (let id = 2; view.length > 0; id++) space.set(id, id, 0, id, 0);
  view[0] = 7; // is lost
  expect(() => space.update()).toThrow('was detached when memory grew');
  space.boxes(2)[2] = 7;
  expect(space.update().get(0, [])).toEqual([0, 0, 7, 0]);
});

test('what is written by the view counts though a new box has made the others move', () => {
  for (const x of [40, 40.1]) {
    const space = new BroadPhase();
    const view = space.boxes(2);
    for (let id = 2; id < 100; id++) space.set(id, id, 50, id, 50);
    space.set(1, x, 0, x + 1, 1);
    expect([...view.subarray(4)]).toEqual([x, 0, x + 1, 1].map(Math.fround));
    view.set([40, 0, 40.5, 1], 0);
    expect(space.get(0, [])).toEqual([40, 0, 40.5, 1]);
    expect([...space.update().validate().pairs]).toEqual([0, 1]);
    view[0] = 7;
    view[2] = 7;
    expect(space.update().pairCount).toBe(0);
    expect(space.get(0, [])).toEqual([7, 0, 7, 1]);
  }
});
