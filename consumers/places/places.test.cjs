// For Jest, in each of its environments.
const { everyForeign, expectedOfForeign } = require('./foreign.cjs');
const library = require('broadphase');

test('the library starts', () => {
  const space = new library.BroadPhase().set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
  expect([...space.pairs]).toEqual([7, 9]);
  expect(() => space.set(1, 2, 2, 1, 3)).toThrow(RangeError);
});

test('spaces are equal that have the same boxes', () => {
  const make = (id) => new library.BroadPhase().set(id, 0, 0, 10, 10);
  expect(make(7)).toEqual(make(7));
  expect({ space: make(7) }).toStrictEqual({ space: make(7).update() });
  expect(make(7)).not.toEqual(make(9));
});

test('what structuredClone gives is of the realm outside', () => {
  const foreign = Object.fromEntries(
    ['Array', 'Float32Array', 'Float64Array', 'Uint8Array'].map((name) => {
      const own = new globalThis[name]();
      return [name, (typeof structuredClone === 'undefined' ? own : structuredClone(own)).constructor];
    }),
  );
  expect(everyForeign(library, foreign)).toBe(expectedOfForeign);
});
