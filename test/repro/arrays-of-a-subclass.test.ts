// Arrays of a class of one's own, whose constructor takes something other than the length: how many boxes there are, or
// the numbers. `setAll(boxes, count)` with fewer boxes than the array has room for took all of them for [0, 0, 0, 0], or
// for what an earlier call had left there, since `subarray` calls that constructor.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';

const numbers = [0, 0, 10, 10, 5, 5, 15, 15, 50, 50, 60, 60];

class Boxes32 extends Float32Array {
  constructor(count: number) {
    super(4 * count);
  }
}
class Boxes64 extends Float64Array {
  constructor(count: number) {
    super(4 * count);
  }
}
class Coordinates extends Float32Array {
  constructor(...all: number[]) {
    super(all);
  }
}
class List extends Array<number> {
  constructor(width: number, height: number) {
    super(width * height);
  }
}
const filled = <Kind extends { [index: number]: number }>(array: Kind): Kind => Object.assign(array, numbers);

describe.each([
  ['Float32Array', () => filled(new Boxes32(3))],
  ['Float64Array', () => filled(new Boxes64(3))],
  ['Float32Array, of its numbers', () => new Coordinates(...numbers)],
  ['Array', () => filled(new List(4, 3))],
])('a class that extends %s', (_, make) => {
  test.each([3, 2, 1, 0])('gives %d boxes', (count) => {
    const space = new BroadPhase().setAll(Array.from({ length: 40 }, (_, k) => (k % 4 > 1 ? 900 + k : k))).update();
    const boxes = make();
    expect(space.setAll(boxes, count).size).toBe(count);
    expect([...space].flatMap(([, box]) => [...box])).toEqual(numbers.slice(0, 4 * count));
    expect([...space.update().pairs]).toEqual(count > 1 ? [0, 1] : []);
    space.validate();
    expect([...boxes]).toEqual(numbers);
  });

  test('is asked about', () => {
    const space = new BroadPhase().setAll(make()).update();
    expect([...space.queryBoxes(make()).offsets]).toEqual([0, 2, 4, 5]);
    expect(space.queryPlanes(make())).toEqual(space.queryPlanes(numbers));
  });
});

test('such an array is both the ids to ignore and the answer', () => {
  const space = new BroadPhase().setAll(numbers).update();
  const ids = new List(1, 2);
  ids[0] = 0;
  ids[1] = 2;
  expect(space.queryBox(0, 0, 99, 99, { ignore: ids, out: ids })).toBe(ids);
  expect([...ids]).toEqual([1]);
});
