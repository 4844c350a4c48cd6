// Faults that a tester found in the calls of the library.
import { runInNewContext } from 'node:vm';
import { BroadPhase } from 'broadphase';
import { describe, expect, test, vi } from 'vitest';

type Any = Record<string, (...all: unknown[]) => unknown>;

const space = new BroadPhase().set(7, 0, 0, 10, 10).set(9, 20, 0, 30, 10).update();
const any = space as never as Any;

test.each([
  ['dx of box 7: got NaN, expected a number', [7, 0, 0, 1, 1, Number.NaN, 0]],
  ['maxY of box 7: got "1", expected a number', [7, 0, 0, 1, '1', 0, 0]],
  ['minX of box 7: got 2, expected no more than maxX', [7, 2, 0, 1, 1, 0, 0]],
])('setSwept names the box: %s', (message, given) => {
  expect(() => any.setSwept!(...given)).toThrow(`setSwept: ${message}`);
});

test.each([
  ['setAll', [[0, 0, 1, 1], undefined]],
  ['boxes', [3]],
  ['setFilter', [7, 1, 1]],
  ['setReach', [7, 2]],
  ['setStatic', [7, true]],
  ['setEnabled', [7, true]],
  ['setGroup', [7, 1]],
])('%s refuses surplus arguments', (name, given) => {
  const call = (...all: unknown[]) => (new BroadPhase().set(7, 0, 0, 1, 1) as never as Any)[name]!(...all);
  call(...given);
  const got = given.length + 1;
  expect(() => call(...given, undefined)).toThrow(
    new TypeError(`${name}: got ${got} arguments, expected at most ${got - 1} in 2D`),
  );
});

test('so does the constructor', () => {
  const Space = BroadPhase as new (...all: unknown[]) => BroadPhase;
  expect(() => new Space({}, {})).toThrow('new BroadPhase: got 2 arguments, expected at most 1 in 2D');
});

describe('options', () => {
  test.each([[new Map()], [new Set()], [space], [[]], [null], [5]])('are not %o', (options) => {
    expect(() => new BroadPhase(options as never)).toThrow('new BroadPhase: got ');
    expect(() => space.queryPoint(1, 1, options as never)).toThrow('expected an object of options');
  });

  test('may be of a class, or have no prototype', () => {
    class Options {
      mask = 1;
    }
    expect(space.queryPoint(1, 1, new Options())).toEqual([7]);
    expect(space.queryPoint(1, 1, Object.assign(Object.create(null), { mask: 1 }))).toEqual([7]);
  });

  test('have no out that is null', () => {
    const options = { out: null } as never;
    expect(() => space.queryBox(0, 0, 1, 1, options)).toThrow('queryBox: out: got null, expected an ordinary array');
    expect(() => space.rayCastAll(0, 0, 1, 1, options)).toThrow(
      'rayCastAll: out: got null, expected an ordinary array',
    );
    expect(() => space.nearest(0, 0, 1, options)).toThrow('nearest: out: got null, expected an ordinary array');
  });
});

describe('what callbacks return', () => {
  test.each([
    [1, '1'],
    ['no', '"no"'],
    [Promise.resolve(), '[object Promise]'],
  ])('accept: %o', (value, shown) => {
    const accept = () => value as never;
    const message = `accept returned: got ${shown}, expected true or false`;
    expect(() => space.rayCast(-1, 5, 1, 0, { accept })).toThrow(new TypeError(`rayCast: ${message}`));
    expect(() => space.sweep(-2, 5, -1, 6, 9, 0, { accept })).toThrow(new TypeError(`sweep: ${message}`));
  });

  test('accept may return nothing, which is false', () => {
    expect(space.rayCast(-1, 5, 1, 0, { accept: (id) => (id === 9 ? true : undefined) as boolean })?.id).toBe(9);
  });

  test('visit: a Promise is refused, anything else goes on', async () => {
    const visit = async () => false;
    const message = 'visit returned: got [object Promise], expected true or false';
    expect(() => space.queryBox(0, 0, 9, 9, { visit })).toThrow(`queryBox: ${message}`);
    expect(() => space.nearest(0, 0, 2, { visit })).toThrow(`nearest: ${message}`);
    // Of another realm; and where zone.js or a polyfill has replaced Promise, which async functions ignore.
    const foreign = runInNewContext('async () => false') as () => unknown;
    expect(() => space.queryBox(0, 0, 9, 9, { visit: foreign })).toThrow(`queryBox: ${message}`);
    vi.stubGlobal('Promise', class {});
    expect(() => space.queryPoint(5, 5, { visit })).toThrow(`queryPoint: ${message}`);
    vi.unstubAllGlobals();
    const seen: number[] = [];
    space.rayCastAll(-1, 5, 1, 0, { visit: (id) => seen.push(id) });
    expect(seen).toEqual([7, 9]);
  });
});

test('pairsWith of another import says so', () => {
  expect(() => space.pairsWith({} as never)).toThrow('expected another BroadPhase, of the same import');
});
