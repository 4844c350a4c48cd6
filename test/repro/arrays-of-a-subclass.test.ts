// Arrays of a class of one's own, whose constructor takes something other than the length: how many boxes there are, or
// the numbers. `setAll(boxes, count)` with fewer boxes than the array has room for took all of them for [0, 0, 0, 0], or
// for what an earlier call had left there, since `subarray` calls that constructor.
import { BroadPhase } from 'broadphase';
import { type Delta, Shard, Zones } from 'broadphase/shard';
import { openTrace, TraceWriter } from 'broadphase/trace';
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

test('such an array is the size of a world', () => {
  const wrap = new List(1, 2);
  wrap[0] = wrap[1] = 20;
  expect([...new BroadPhase({ wrap }).set(7, 0, 0, 1, 1).set(9, 18, 18, 20, 20).update().pairs]).toEqual([7, 9]);
  expect(new Zones({ borders: { x: [5] }, wrap }).ownerOf([19, 0, 19, 0])).toBe(1);
  const writer = new TraceWriter(2, wrap);
  const bytes = Uint8Array.of(...writer.header(), ...writer.frame(Float32Array.from(numbers)), ...writer.end());
  expect(openTrace(bytes).wrap).toEqual([20, 20]);
});

test('such arrays are in a delta, and are the rules of a frame', () => {
  class Pairs extends Uint32Array {
    constructor(count: number) {
      super(2 * count);
    }
  }
  const zones = new Zones({ borders: { x: [100] } });
  const events = () => new BroadPhase({ events: true });
  const [delta] = new Shard(zones, 0, events()).set(7, 95, 0, 105, 10).exchange() as [Delta];
  const boxes = new Boxes64(delta.boxes.length / 4);
  boxes.set(delta.boxes);
  const shard = new Shard(zones, 1, events());
  shard.update([{ ...delta, boxes }]);
  expect([...shard.space.get(7)!]).toEqual([95, 0, 105, 10]);

  const rules = new Pairs(3);
  rules.set([1, 2, 1, 3, 4, 0]);
  const writer = new TraceWriter(2);
  const frame = writer.frame(Float32Array.from(numbers.slice(4)), undefined, rules);
  const [read] = openTrace(Uint8Array.of(...writer.header(), ...frame, ...writer.end()));
  expect([...read!.rules!]).toEqual([...rules]);
});
