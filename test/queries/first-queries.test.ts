// The first few queries after an update look at all boxes, and later ones search an index: both answer alike.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';
import { Asker, ascending } from '../support/asker.ts';
import type { Entry } from '../support/model.ts';
import { setBox } from '../support/set-box.ts';

const seed = Number(process.env.SEED ?? 1);

describe.each([2, 3] as const)(`in %d dimensions, SEED=${seed}`, (dimensions) => {
  test.each([1, 9, 64, 300, 2000])('among %i boxes that all move', { tags: 'long' }, (count) => {
    const random = createRandom(seed * 1000 + count);
    const pick = <T>(...from: T[]): T => from[Math.floor(random() * from.length)]!;
    const world = 12 * count ** (1 / dimensions);
    for (const kind of ['whole', 'float32', 'doubles', 'far', 'tiny']) {
      const number = (x: number) =>
        ({ whole: Math.floor(x), float32: Math.fround(x), doubles: x, far: 1e9 + x, tiny: x * 1e-9 })[kind]!;
      const box = () => {
        const low = Array.from({ length: dimensions }, () => random() * world);
        return [...low.map(number), ...low.map((x) => number(x + pick(0, 3, 10 * random())))];
      };
      const space = new BroadPhase({ dimensions });
      const asker = new Asker(space, random, world);
      const entries = new Map<number, Entry>();
      for (let id = 0; id < count; id++) {
        const layer = 1 << pick(0, 1, 2, 31);
        entries.set(7 * id, { box: box(), layer: layer >>> 0, mask: 0xffffffff, isStatic: false });
      }
      for (let round = 0; round < 12; round++) {
        for (const [id, entry] of entries) {
          entry.box = box();
          setBox(space, id, entry.box);
          if (round === 0) space.setFilter(id, entry.layer, entry.mask);
        }
        space.update().queryPoints([]); // after an update with few queries, few are expected
        for (const [id, { box }] of entries) setBox(space, id, box);
        space.update();
        const ask = pick('nearest', 'ray', 'sweep', 'everything', 'everything') as 'everything';
        for (let call = pick(1, 1, 1, 2, 5); call > 0; call--) asker[ask](entries);
      }
      space.dispose();
    }
  });
});

// Of all kinds of places, ways and distances, which `Asker` rarely chooses so that a scan finds some of many boxes.
describe.each([2, 3] as const)(`as by the index, in %d dimensions, SEED=${seed}`, (dimensions) => {
  test.each([300, 3000])('among %i boxes', (count) => {
    const random = createRandom(seed * 100 + count + dimensions);
    const world = 60 * count ** (1 / dimensions);
    const point = (by = world) => Array.from({ length: dimensions }, () => random() * by);
    const between = (by: number) => point(2 * by).map((x) => x - by);
    const space = new BroadPhase<2 | 3>({ dimensions });
    const call = space as unknown as Record<string, (...given: unknown[]) => unknown>;
    const kinds: Record<string, () => unknown[]> = {
      queryBox: () => around(point(), random() * 0.3 * world),
      queryPoint: () => point(),
      [dimensions === 2 ? 'queryCircle' : 'querySphere']: () => [...point(), random() * 0.3 * world],
      rayCast: () => [...point(), ...between(1)],
      rayCastAll: () => [...point(), ...between(1), { maxDistance: random() * 0.5 * world }],
      sweep: () => [...around(point(), random() * 9), ...between(0.4 * world)],
      nearest: () => [...point(), 1 + Math.floor(random() ** 4 * 40), { mask: 3 }],
    };
    const around = (at: number[], by: number) => [...at, ...at.map((x) => x + by)];
    const move = (boxes: number) => {
      for (let id = 0; id < boxes; id++) {
        const at = point();
        setBox(space, id, random() < 0.5 ? around(at, random() * 30).map(Math.fround) : around(at, random() * 30));
        space.setFilter(id, 1 + (id % 3), 7);
      }
      space.update();
    };
    for (let round = 0; round < 400; round++) {
      move(round % 20 === 0 ? count : count / 10);
      space.queryPoints([]); // after an update with few queries, few are expected
      move(count / 10);
      const name = Object.keys(kinds)[round % 7]!;
      const given = kinds[name]!();
      const first = call[name]!(...given);
      for (let k = 0; k < 6; k++) call.queryPoint!(...point());
      const later = call[name]!(...given);
      const same = name.startsWith('query') ? (ids: unknown) => ascending(ids as number[]) : (hits: unknown) => hits;
      expect(same(later), `${name}(${given.join(', ')})`).toEqual(same(first));
    }
  });
});

// A visitor reads answers in parts of 64.
test.each([1, 63, 64, 65, 128, 200])('a visitor gets each of %i answers once', (answers) => {
  const space = new BroadPhase();
  for (let id = 0; id < 1000; id++) {
    const x = id < answers ? id / 1000 : -10 - id;
    space.set(id, x, 0, x, 1);
  }
  space.update();
  const visited: number[] = [];
  space.queryBox(0, 0, 1, 1, { visit: (id) => visited.push(id) > 0 });
  expect(ascending(visited)).toEqual(Array.from({ length: answers }, (_, id) => id));
});

test('boxes that are off are in no answer, whichever way they are looked for', () => {
  const space = new BroadPhase();
  for (let id = 0; id < 600; id++) space.set(id, id, 0.1, id, 0.1).setEnabled(id, id % 2 === 0);
  for (let round = 0; round < 6; round++) {
    space.set(0, 0, 0.1 * round, 0, 1).update();
    expect(space.nearest(301, 0, 2, { maxDistance: 50 })).toEqual([300, 302]);
    expect(ascending(space.queryBox(10, 0, 15, 1))).toEqual([10, 12, 14]);
    expect(space.rayCast(100.5, 0.1, 1, 0)?.id).toBe(102);
  }
});
