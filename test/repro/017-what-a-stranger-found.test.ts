// Faults that somebody found who used the library for the first time.
import { BroadPhase } from 'broadphase';
import { boxesInCells } from 'broadphase/draw';
import { describe, expect, test } from 'vitest';

const wrapped = () => new BroadPhase({ wrap: [64, 80] }).set(0, 15, 35, 17, 37).set(1, 50, 70, 51, 71).update();

describe('in a world that wraps around, many queries at once do not depend on the query before', () => {
  test.each<[string, (space: BroadPhase) => unknown]>([
    ['a ray', (space) => space.rayCast(25, 47, 17, -8)],
    ['a refused ray', (space) => expect(() => space.rayCast(25, 47, 17, -8, { maxDistance: -1 })).toThrow()],
    ['a reach that was read', (space) => space.setReach(0, 5).update().reachOf(0)],
    ['a group that was read', (space) => space.setGroup(0, 5).update().groupOf(0)],
  ])('%s', (_, first) => {
    const space = wrapped();
    first(space);
    expect([...space.nearestsOfAll(1).ids]).toEqual([1, 0]);
    first(space);
    expect([...space.nearests([1, 27], 2).ids]).toEqual(space.nearest(1, 27, 2));
  });
});

test('the ids of the last answer can be those to ignore, in the same array', () => {
  const space = new BroadPhase();
  for (let id = 0; id < 8; id++) space.set(id, 0, 0, 1, 1);
  space.update();
  const ids = [1, 2];
  expect(space.queryBox(0, 0, 1, 1, { ignore: ids, out: ids })).toEqual([0, 3, 4, 5, 6, 7]);
  expect(() => space.nearest(0, 0, 2, { out: ids, distances: ids })).toThrow(
    'nearest: distances: got [0, 3, 4, 5, 6, 7], expected an ordinary array other than out',
  );
});

test('deleting a box that is not there changes nothing for queries', () => {
  const space = new BroadPhase();
  for (let id = 0; id < 20_000; id++) space.set(id, 2 * id, 0, 2 * id + 1, 1);
  space.update();
  expect(space.delete(99_999)).toBe(false);
  expect(space.queryPoint(0, 0)).toEqual([0]);
});

test('the pairs of a space can be the ids that its queries ignore, even if memory grows', () => {
  const space = new BroadPhase();
  for (let id = 0; id < 300; id++) space.set(id, 0, 0, 1, 1);
  const { pairs } = space.update();
  const rays = new Float64Array(4 * pairs.length).fill(1);
  expect(space.rayCasts(rays, { ignoreEach: pairs }).offsets.length).toBe(300 * 299 + 1);
});

test('a call without out returns no objects that the caller was given before', () => {
  const space = new BroadPhase();
  for (let id = 0; id < 3; id++) space.set(id, 10 * id, 0, 10 * id + 1, 1);
  space.update();
  const out = space.rayCastAll(-5, 0.5, 1, 0);
  const last = out[2]!;
  space.rayCastAll(-5, 0.5, 1, 0, { maxDistance: 6, out });
  expect(space.rayCastAll(40, 0.5, -1, 0)).not.toContain(last);
  expect(last).toEqual({ id: 2, distance: 25, normal: [-1, 0] });
});

test('the cells of a space are found whatever the constructor of its class expects', () => {
  class Level extends BroadPhase {
    constructor(level: { walls: number[][] }) {
      super();
      for (const [k, [a, b, c, d]] of level.walls.entries()) this.set(k, a!, b!, c!, d!);
    }
  }
  const level = new Level({
    walls: [
      [0, 0, 1, 1],
      [5, 5, 6, 6],
    ],
  }).update();
  expect([...boxesInCells(level)].reduce((sum, held) => sum + held, 0)).toBeLessThanOrEqual(2);
});

describe('what is wrong is said', () => {
  const space = new BroadPhase().set(7, 0, 0, 1, 1).update();
  const [circular, revoked] = [[] as unknown[], Proxy.revocable({}, {})];
  circular.push(circular);
  revoked.revoke();
  const detached = space.snapshot();
  structuredClone(detached.buffer, { transfer: [detached.buffer] });
  test.each<[string, () => unknown]>([
    ['wrap: got [, ], expected 2 numbers above 0', () => new BroadPhase({ wrap: new Array(2) as never })],
    ['setStatic: isStatic: got undefined', () => space.setStatic(7, undefined as never)],
    ['expected another BroadPhase, of the same import', () => space.pairsWith({} as never)],
    ['the id is [[[object Array]]]', () => space.has(circular as never)],
    ['the id is a hostile object', () => space.has(revoked.proxy as never)],
    [
      'queryCircles: query 0: radius: got "5", expected a number, at least 0',
      () => space.queryCircles([0, 0, '5' as never]),
    ],
    [
      'setSwept: got 8 arguments for box 1, expected 7',
      () => (space.setSwept as never as Many)(1, 0, 0, 1, 1, 5, 5, 9),
    ],
    ['restore: got detached memory', () => space.restore(detached)],
    ['get: out: got [object Int32Array]', () => space.get(7, new Int32Array(4) as never)],
  ])('%s', (message, call) => {
    expect(call).toThrow(message);
  });
  type Many = (...numbers: number[]) => unknown;
});
