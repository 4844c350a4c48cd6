// `{ cellsize: 4 }`, `{ dimension: 3 }` and `{ layer: 3 }` did nothing; `findPairs` spoke of `setAll`; BigInt gave the
// engine's own texts; `out` of rays "Cannot set properties of undefined"; printing a space gave its kernel.
import { inspect } from 'node:util';
import { BroadPhase, findPairs, findPairsBetween } from 'broadphase';
import { describe, expect, test } from 'vitest';

type Loose = Record<string, (...given: unknown[]) => unknown>;
const space = () => new BroadPhase().set(7, 10, 0, 20, 10).update();
const ask = (mine: BroadPhase<2 | 3> = space()) => mine as unknown as Loose;

describe('an option that there is not', () => {
  test.each<[() => unknown, string]>([
    [
      () => new BroadPhase({ cellsize: 4 } as object),
      'new BroadPhase: there is no option "cellsize", did you mean "cellSize"?',
    ],
    [() => new BroadPhase({ dimension: 3 } as object), '"dimension", did you mean "dimensions"?'],
    [() => new BroadPhase({ Technique: 'auto' } as object), 'did you mean "technique"?'],
    [() => new BroadPhase({ event: true } as object), 'did you mean "events"?'],
    [() => findPairs([], { dimension: 3 } as object), 'findPairs: there is no option "dimension"'],
    [
      () => findPairsBetween([], [], { dims: 3 } as object),
      'findPairsBetween: there is no option "dims", did you mean "dimensions"?',
    ],
    [() => ask().queryBox(0, 0, 1, 1, { layer: 3 }), 'queryBox: there is no option "layer", there are mask, ignore'],
    [() => ask().queryPoint(0, 0, { ignored: 3 }), 'did you mean "ignore"?'],
    [() => ask().queryCircle(0, 0, 1, { visitor: () => 1 }), 'did you mean "visit"?'],
    [
      () => ask().rayCast(0, 0, 1, 1, { maxdistance: 3 }),
      'rayCast: there is no option "maxdistance", did you mean "maxDistance"?',
    ],
    [() => ask().rayCast(0, 0, 1, 1, { visit: () => 1 }), 'rayCast: there is no option "visit"'],
    [() => ask().rayCastAll(0, 0, 1, 1, { max: 3 }), 'rayCastAll: there is no option "max"'],
    [() => ask().sweep(0, 0, 1, 1, 1, 1, { maxDistance: 3 }), 'sweep: there is no option "maxDistance"'],
    [
      () => ask().sweep(0, 0, 1, 1, 1, 1, { visit: () => true, accept: () => true }),
      'sweep: got both visit and accept, expected one of them',
    ],
    [() => ask().nearest(0, 0, 1, { radius: 3 }), 'nearest: there is no option "radius"'],
  ])('%s', (call, message) => {
    expect(call).toThrow(TypeError);
    expect(call).toThrow(message);
  });

  test('left undefined, it is as if it were not there', () => {
    expect(() => new BroadPhase({ cellsize: undefined } as object)).not.toThrow();
  });
});

describe('errors of findPairs name findPairs', () => {
  test.each<[() => unknown, string]>([
    [() => findPairs([0, 0, 1]), 'findPairs: length: got 3'],
    [() => findPairs([0, 0, 1, Number.NaN]), 'findPairs: maxY of box 0 is NaN'],
    [() => findPairs([0, 0, 1, 1n as never]), 'findPairs: maxY of box 0 is 1n'],
    [() => findPairs(Float32Array.of(5, 0, 1, 1)), 'findPairs: box 0 has minX 5 above maxX 1'],
    [() => findPairs(5 as never), 'findPairs: got 5'],
    [() => findPairsBetween([0, 0, 1, 1], [3, 0, 1, 1]), 'findPairsBetween: blue: box 0 has minX 3'],
    [() => findPairsBetween([0, 0, 1, Number.NaN], [3, 0, 1, 1]), 'findPairsBetween: red: maxY of box 0 is NaN'],
    [
      () => findPairsBetween([0, 0, 1, 1], [0, 0, 1, 1, 0, '0' as never, 1, 1]),
      'findPairsBetween: blue: minY of box 1 is "0"',
    ],
    [
      () => findPairsBetween(Float32Array.of(0, 0, 1, 1), Float64Array.of(0, 0, 1, 1, 0, Number.NaN, 1, 1)),
      'findPairsBetween: blue: minY of box 1 is NaN',
    ],
  ])('%s', (call, message) => expect(call).toThrow(message));
});

test('BigInt and symbols are refused by name', () => {
  const mine = ask();
  for (const bad of [1n, Symbol('s')] as unknown[]) {
    const calls: Record<string, unknown[]> = {
      set: [bad, 0, 0, 1, 1],
      setSwept: [bad, 0, 0, 1, 1, 1, 1],
      delete: [bad],
      has: [bad],
      get: [bad],
      setFilter: [7, bad, 1],
      setStatic: [bad],
      isColliding: [7, bad],
      collisionsOf: [bad],
      boxes: [bad],
      queryBox: [0, bad, 1, 1],
      queryPoint: [bad, 0],
      rayCast: [0, bad, 1, 1],
      sweep: [0, 0, bad, 1, 1, 1],
      nearest: [0, 0, bad],
      setAll: [[0, 0, 1, bad]],
      restore: [bad],
    };
    for (const [name, given] of Object.entries(calls)) {
      expect(() => mine[name](...given), name).toThrow(TypeError);
      expect(() => mine[name](...given), name).toThrow(new RegExp(`^${name}: .*(1n|Symbol)`));
    }
    expect(() => mine.set(3, 0, bad, 1, 1)).toThrow(/^set: minY of box 3 is (1n|Symbol)/);
    const options = { mask: bad };
    expect(() => mine.queryBox(0, 0, 1, 1, options)).toThrow(/^queryBox: mask: got (1n|Symbol)/);
    expect(() => mine.queryBox(0, 0, 1, 1, { ignore: bad })).toThrow(/^queryBox: ignore: the id is (1n|Symbol)/);
    const solid = ask(new BroadPhase({ dimensions: 3 }));
    expect(() => solid.set(3, 0, 0, 0, 1, bad, 1)).toThrow(/^set: maxY of box 3 is/);
    expect(() => solid.queryBox(0, 0, 0, 1, bad, 1)).toThrow(/^queryBox: maxY/);
    expect(() => solid.sweep(0, 0, 0, 1, bad, 1, 0, 0, 0)).toThrow(/^sweep: maxY/);
    expect(() => solid.setSwept(1, 0, 0, 0, 1, bad, 1, 0, 0, 0)).toThrow(/^setSwept: maxY/);
  }
});

test('setFilter with an argument left out, and with signed bits', () => {
  const mine = ask();
  expect(() => mine.setFilter(7, 1)).toThrow(
    /^setFilter: mask: got undefined, expected an integer from 0 to 4294967295$/,
  );
  expect(() => mine.setFilter(7, ~2, 1)).toThrow(
    'got -3, expected an integer from 0 to 4294967295 (of signed bits, write bits >>> 0)',
  );
});

test('a wrong out says what it should be, and nothing is written', () => {
  const mine = ask();
  const right = 'expected an object { id: 0, distance: 0, normal: [] }';
  for (const out of [5, 'out', null, [], {}, { normal: 3 }]) {
    expect(() => mine.rayCast(0, 5, 1, 0, { out })).toThrow(right);
    expect(() => mine.sweep(0, 0, 1, 9, 99, 0, { out })).toThrow('sweep: out: got');
    expect(() => mine.sweep(0, 0, 1, 9, 1, 0, { out })).toThrow('expected an object { id: 0, time: 0, normal: [] }');
    expect(() => mine.rayCastAll(0, 5, 1, 0, { out: [out] })).toThrow('rayCastAll: out[0]: got');
  }
  for (const out of [5, 'out', null, {}, new Float32Array(3)]) expect(() => mine.get(7, out)).toThrow('get: out: got');
  expect(mine.get(7, new Float32Array(4))).toEqual(Float32Array.of(10, 0, 20, 10));
});

test('a space prints what it is, and so does its JSON', () => {
  const mine = new BroadPhase({ dimensions: 3 }).set(0, 0, 0, 0, 1, 1, 1).set(1, 0, 0, 0, 1, 1, 1).update();
  expect(inspect(mine)).toBe("BroadPhase { dimensions: 3, technique: 'auto', size: 2, pairs: 1 }");
  expect(inspect({ mine })).toContain("mine: BroadPhase { dimensions: 3, technique: 'auto', size: 2, pairs: 1 }");
  expect(JSON.parse(JSON.stringify({ mine }))).toEqual({
    mine: { dimensions: 3, technique: 'auto', size: 2, pairs: 1 },
  });
  mine.dispose();
  expect(inspect(mine)).toBe('BroadPhase { disposed: true }');
  expect(JSON.stringify(mine)).toBe('{"disposed":true}');
});

test('a pair later in the list names a box that was deleted inside the loop', () => {
  const mine = new BroadPhase().setAll([0, 0, 9, 9, 0, 0, 9, 9, 0, 0, 9, 9]).update();
  const { pairs } = mine;
  const alive: number[] = [];
  mine.delete(0);
  for (let k = 0; k < pairs.length; k += 2) if (mine.has(pairs[k]) && mine.has(pairs[k + 1])) alive.push(k);
  expect(pairs.length).toBe(6);
  expect(alive.length).toBe(1);
});
