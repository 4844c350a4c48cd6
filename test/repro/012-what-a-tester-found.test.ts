// What a tester found with combinations of calls.
import { BroadPhase } from 'broadphase';
import { expect, test } from 'vitest';

test.each([2, 3] as const)(
  'a world that wraps around in which all boxes are off: a query divided by 0, %iD',
  (dimensions) => {
    const wrap = [100, 100, 100].slice(0, dimensions);
    const box = [0, 0, 0, 1, 1, 1].slice(0, 2 * dimensions) as [number, number, number, number];
    const make = () => new BroadPhase<2 | 3>({ dimensions, wrap });
    const asked = make()
      .set(7, ...box)
      .setEnabled(7, false)
      .update();
    const late = make()
      .set(7, ...box)
      .update();
    expect(late.queryBox(...box)).toEqual([7]);
    late.setEnabled(7, false).update();
    for (const space of [asked, late]) {
      expect(space.queryBox(...box)).toEqual([]);
      expect(space.queryPlanes([])).toEqual([]);
      expect([...space.queryBoxes(box).offsets]).toEqual([0, 0]);
      expect([...space.nearestsOfAll(1).offsets]).toEqual([0, 0]);
      expect(
        make()
          .set(1, ...box)
          .update()
          .pairsWith(space),
      ).toHaveLength(0);
      expect(
        space
          .setEnabled(7, true)
          .update()
          .queryBox(...box),
      ).toEqual([7]);
    }
  },
);

const detached = () => {
  const array = new Float32Array(8);
  structuredClone(array, { transfer: [array.buffer] });
  return array;
};

test.each<[string, (space: BroadPhase) => unknown]>([
  ['setAll', (space) => space.setAll(detached())],
  ['queryBoxes', (space) => space.queryBoxes(detached())],
  ['queryPlanes', (space) => space.queryPlanes(detached())],
])('%s: a detached array is named, not taken for an empty one', (name, call) => {
  const space = new BroadPhase().set(7, 0, 0, 1, 1).update();
  expect(() => call(space)).toThrow(new RegExp(`^${name}: got a detached array`));
  expect([...space.keys()]).toEqual([7]);
});

test('the memory of a space, given to itself, may be detached by the call', () => {
  const space = new BroadPhase();
  const boxes = space.boxes(20_000);
  for (let k = 0; k < boxes.length; k += 4) boxes.set([k, 0, k + 1, 1], k);
  space.update();
  try {
    space.setAll(space.boxes(20_000));
  } catch (error) {
    expect(String(error)).toContain('setAll: got a detached array');
  }
  expect(space.get(19_999)).toEqual(Float64Array.of(79_996, 0, 79_997, 1));
});

test('`within: null` is refused, as `touching: null` is', () => {
  const space = new BroadPhase().update();
  const options = { within: null } as unknown as { within: boolean };
  expect(() => space.queryBox(0, 0, 1, 1, options)).toThrow('queryBox: within: got null, expected true or false');
  expect(() => space.queryBoxes([0, 0, 1, 1], options)).toThrow('queryBoxes: within: got null');
});

test('options in the place of 3D are refused in 2D', () => {
  const space = new BroadPhase().update() as unknown as Record<string, (...given: unknown[]) => unknown>;
  const none = [undefined, undefined];
  expect(() => space.queryBox!(0, 0, 1, 1, ...none, { mask: 1 })).toThrow(TypeError);
  expect(() => space.rayCast!(0, 0, 1, 0, ...none, {})).toThrow(TypeError);
  expect(() => space.rayCastAll!(0, 0, 1, 0, ...none, {})).toThrow(TypeError);
  expect(() => space.sweep!(0, 0, 1, 1, 1, 0, undefined, undefined, undefined, {})).toThrow(TypeError);
});

test('a snapshot after an update has all that was written, though memory has grown since', () => {
  const space = new BroadPhase();
  const view = space.boxes(2);
  view[2] = 9;
  space.update();
  for (let count = 1000; view.length > 0; count *= 2) space.queryBoxes(new Float64Array(4 * count));
  expect([...new BroadPhase().restore(space.snapshot()).get(0)!]).toEqual([0, 0, 9, 0]);
});

test('a snapshot notices, as an update does, that what was written in place may be lost', () => {
  const space = new BroadPhase();
  space.boxes(2);
  space.update();
  const view = space.boxes(2);
  for (let count = 1000; view.length > 0; count *= 2) space.queryBoxes(new Float64Array(4 * count));
  view[0] = 9; // is lost
  expect(() => space.snapshot()).toThrow('snapshot: the array of boxes() was detached when memory grew');
  expect(() => space.update()).toThrow('update: the array of boxes() was detached when memory grew');
  space.boxes(2)[2] = 9;
  expect([...space.update().get(0)!]).toEqual([0, 0, 9, 0]);
  expect(space.snapshot().length).toBeGreaterThan(0);
});
