// What a callback did in the middle of a query could change its answers without a word. A getter among the planes of
// queryPlanes that asked another space gave the query the options of that one. And where memory ran out in a visitor
// that caught the error, the index was made again in another order: boxes were visited twice, and others never.
import { BroadPhase } from 'broadphase';
import { expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';

test('a getter of planes that asks another query is refused, whatever space it asks', () => {
  const make = () => new BroadPhase().set(1, 0, 0, 1, 1).set(2, 5, 5, 6, 6).setFilter(1, 1, 1).update();
  const [space, other] = [make(), make()];
  const queries: (() => unknown)[] = [
    () => other.queryBox(0, 0, 1, 1, { mask: 0x80 }),
    () => other.nearest(0, 0, 1),
    () => other.rayCast(0, 0, 1, 0, { accept: () => false }),
    () => expect(() => other.nearest(0, 0, 0, { mask: 0 })).toThrow('nearest: k'),
    () => expect(() => space.queryPoint(0, 0, { touching: false })).toThrow('used by a getter of its input'),
  ];
  const options = () => [{}, { mask: 1 }, { out: [9] }, { ignore: [1, 7] }, { visit: () => false }];
  for (const query of queries) {
    for (const [k, given] of options().entries()) {
      let reads = 0;
      const planes = [1, 0, 0];
      const get = () => {
        if (++reads === 2) query();
        return 0;
      };
      Object.defineProperty(planes, 1, { get });
      const out = (given as { out?: number[] }).out;
      expect(() => space.queryPlanes(planes, given)).toThrow('queryPlanes: a getter of planes made a query');
      expect(out ?? [9]).toEqual([9]);
      expect(space.queryPlanes([1, 0, 0], options()[k])).toEqual(
        new BroadPhase().restore(space.snapshot()).queryPlanes([1, 0, 0], options()[k]),
      );
    }
  }
});

test('a query does not go on after its visitor has run out of memory', () => {
  const random = createRandom(5);
  const count = 17_000; // so many that all neighbours of all of them do not fit into any memory
  const places = Array.from({ length: 2 * count }, () => random() * 1000);
  const space = new BroadPhase();
  for (let frame = 0; frame < 4; frame++) {
    for (let k = 0; k < places.length; k++) places[k]! += random() * 20 - 10;
    const boxes = Array.from({ length: 4 * count }, (_, k) => places[2 * (k >> 2) + (k & 1)]! + (k & 2));
    space.setAll(boxes).update().queryBox(0, 0, 1, 1);
  }
  const everywhere = [-1e5, -1e5, 1e5, 1e5] as const;
  const seen: number[] = [];
  const visit = (id: number) => {
    seen.push(id);
    if (seen.length === 1000) expect(() => space.nearestsOfAll(Number.POSITIVE_INFINITY)).toThrow('out of memory');
  };
  expect(() => space.queryBox(...everywhere, { visit })).toThrow(
    'queryBox: update or restore was called by visit, or memory ran out',
  );
  expect(new Set(seen).size).toBe(seen.length);
  expect(() => space.queryPlanes([], { visit: () => void space.nearestsOfAll(Number.POSITIVE_INFINITY) })).toThrow(
    'nearestsOfAll: out of memory',
  );
  seen.length = 0;
  space.queryBox(...everywhere, { visit: (id) => void seen.push(id) });
  expect(new Set(seen).size).toBe(count);
});
