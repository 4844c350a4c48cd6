// An array whose getters used the space while a call copied it into the kernel's memory: what the call had copied by
// then was mixed with the boxes or the queries of the other call, or written to memory that had another use by then.
// Such a getter now throws, so that the space is as if the array had not been given. Any other call of a getter, before
// the copy, comes before the call that reads the array.
import { BroadPhase, findPairs, findPairsBetween } from 'broadphase';
import { describe, expect, test } from 'vitest';

const message = 'this BroadPhase was used by a getter of its input';

/** An array that does something when one of its numbers is read for the n-th time. */
function reading(numbers: readonly number[], at: number, nth: number, act: () => void): number[] {
  const array = numbers.slice();
  let reads = 0;
  Object.defineProperty(array, at, {
    enumerable: true,
    configurable: true,
    get() {
      if (++reads === nth) act();
      return numbers[at];
    },
  });
  return array;
}

const two = [0, 0, 10, 10, 5, 5, 15, 15];
const far = Array.from({ length: 3000 }, (_, k) => [20 * k, 0, 20 * k + 10, 10]).flat();
const stateOf = (space: BroadPhase) => JSON.stringify([...space].map(([id, box]) => [id, [...box]]));

const uses: Record<string, (space: BroadPhase) => void> = {
  setAll: (space) => space.setAll(far),
  'setAll and update': (space) => space.setAll(far).update(),
  boxes: (space) => void space.boxes(5000),
  update: (space) => space.update(),
  clear: (space) => space.clear(),
  delete: (space) => void space.delete(0),
  restore: (space) => space.restore(new BroadPhase().setAll(far).snapshot()),
  setFilter: (space) => space.setFilter(0, 1, 1),
  queryBoxes: (space) => void space.queryBoxes(far),
  get: (space) => void space.get(0),
};

describe.each(Object.keys(uses))('a getter that calls %s', (name) => {
  const use = uses[name]!;
  const make = () => new BroadPhase({ events: true }).setAll([...far.slice(0, 40), 5, 5, 25, 25]).update();

  /** With the use at each reading: either both calls have had their effect, one after the other, or neither. */
  function attack(call: (space: BroadPhase, array: number[]) => unknown, numbers: readonly number[], expected: string) {
    let last = 0;
    let refused = 0;
    for (let nth = 1; nth < 9; nth++) {
      const space = make();
      const before = stateOf(space);
      let used = false;
      const array = reading(numbers, 3, nth, () => {
        used = true;
        use(space);
      });
      let answer: unknown;
      let error: unknown;
      try {
        answer = call(space, array);
      } catch (caught) {
        error = caught;
      }
      if (!used) break;
      last = nth;
      if (error === undefined) {
        expect(answer ?? stateOf(space)).toBe(expected);
      } else {
        expect(String(error)).toBe(`Error: ${message}`);
        expect(stateOf(space)).toBe(before);
        refused++;
      }
      space.update().validate();
      expect(space.set(7, 0, 0, 1, 1).update().has(7)).toBe(true);
    }
    expect(last).toBeGreaterThan(1);
    expect(refused).toBe(1); // the reading that copies
  }

  test('during setAll', () => {
    const expected = stateOf(new BroadPhase().setAll(two));
    attack((space, array) => void space.setAll(array), two, expected);
    attack((space, array) => void space.setAll(array, 2), [...two, 1, 1, 2, 2], expected);
  });

  test('that catches the error goes unnoticed', () => {
    const space = make();
    space.setAll(
      reading(two, 3, 2, () => {
        expect(() => use(space)).toThrow(message);
      }),
    );
    expect([...space.update().pairs]).toEqual([0, 1]);
    expect(space.size).toBe(2);
    space.validate();
  });
});

test('a set by a getter comes before the setAll that reads it', () => {
  for (let nth = 1; nth < 4; nth++) {
    for (const id of [0, 1, 5, 30, 4000]) {
      const space = new BroadPhase().setAll(far.slice(0, 40)).update();
      let error: unknown;
      try {
        space.setAll(reading(two, 3, nth, () => void space.set(id, 1, 1, 2, 2)));
      } catch (caught) {
        error = caught;
      }
      const isRefused = error !== undefined;
      if (isRefused) expect(String(error)).toBe(`Error: ${message}`);
      expect(space.size, `${id}`).toBe(isRefused ? 10 : 2);
      expect(space.has(id)).toBe(isRefused ? id < 10 : id < 2);
      expect(space.has(5)).toBe(isRefused);
      space.update().validate();
      if (!isRefused) expect([...space.pairs]).toEqual([0, 1]);
    }
  }
});

test('disposed by a getter, the space stays so', () => {
  const gone = 'this BroadPhase was disposed and can no longer be used';
  for (let nth = 1; nth < 3; nth++) {
    const space = new BroadPhase().setAll(far).update();
    expect(() => space.setAll(reading(two, 3, nth, () => space.dispose()))).toThrow(gone);
    expect(() => space.update()).toThrow(gone);
    const other = new BroadPhase().setAll(far).update();
    expect(() => other.queryBoxes(reading(two, 3, nth, () => other.dispose()))).toThrow(gone);
    expect(() => other.update()).toThrow(gone);
  }
});

test('queries in a getter of the numbers of many', () => {
  const space = new BroadPhase().setAll(two).update();
  const expected = space.queryBoxes(two);
  for (const act of [() => space.queryBoxes(far), () => space.setAll(far).update(), () => space.nearest(0, 0, 2)]) {
    const early = new BroadPhase().setAll(two).update();
    expect(early.queryBoxes(reading(two, 3, 1, () => void early.queryBoxes(far)))).toEqual(expected);
    expect(() => space.queryBoxes(reading(two, 3, 2, act))).toThrow(message);
    expect(() => space.queryBoxes(two, { ignoreEach: reading([1, 0], 1, 2, act) })).toThrow(message);
    expect(space.queryBoxes(two)).toEqual(expected);
    expect(() => space.queryPlanes(reading([1, 0, 0], 1, 2, act))).toThrow(message);
    expect(space.queryPlanes([1, 0, 0])).toEqual([0, 1]);
  }
});

test('an array that becomes shorter when it is read is refused', () => {
  const space = new BroadPhase().setAll(far).update();
  const shrinking = (at: number, nth: number) => {
    const array = reading(two, at, nth, () => {
      array.length = 4;
    });
    return array;
  };
  expect(() => space.setAll(shrinking(7, 1))).toThrow('setAll: length: got 4, expected 8');
  expect(() => space.setAll(shrinking(3, 2))).toThrow('setAll: minX of box 1 is NaN');
  expect(() => space.queryBoxes(shrinking(7, 1))).toThrow('queryBoxes: length: got 4, expected 8');
  expect(space.size).toBe(3000);
  space.update().validate();
});

test('findPairs within findPairs', () => {
  for (let nth = 1; nth < 4; nth++) {
    const inner: number[][] = [];
    const array = reading(two, 3, nth, () => inner.push([...findPairs(two)], [...findPairsBetween(two, two)]));
    expect([...findPairs(array)]).toEqual([0, 1]);
    expect([...findPairsBetween(array, two)].length).toBe(8);
    expect(inner.every((pairs) => pairs.length > 0)).toBe(true);
  }
});

test('a getter that changes the options of findPairs has no effect on the next call', () => {
  const solid = Array.from({ length: 12 }, (_, k) => Math.floor((k % 6) / 3));
  for (const [given, later] of [
    [{ dimensions: 2 }, { dimensions: 3 }],
    [{ dimensions: 2 }, { touching: false }],
    [{ touching: false }, { dimensions: 2 }],
  ] as const) {
    const options: Record<string, unknown> = { ...given };
    const change = () => {
      for (const name of Object.keys(options)) delete options[name];
      Object.assign(options, later);
    };
    expect([...findPairs(reading(two, 3, 1, change), options)]).toEqual([0, 1]);
    expect([...findPairs(solid, { dimensions: 3 })]).toEqual([0, 1]);
    expect([...findPairsBetween(two, reading(two, 3, 1, change), { ...given })].length).toBe(8);
    expect([...findPairs(solid, { dimensions: 3 })]).toEqual([0, 1]);
    expect([...findPairs([0, 0, 1, 1, 1, 1, 2, 2])]).toEqual([0, 1]);
  }
});
