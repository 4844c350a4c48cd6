// Spaces and queries in which boxes that only touch do not overlap. SEED=… runs the same sequences again.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { exactPairs } from '../../src/trace/exact.ts';
import { openTrace } from '../../src/trace/reader.ts';
import { record } from '../../src/trace/record.ts';
import { replay } from '../../src/trace/replay.ts';
import { describeEach } from '../support/each-technique.ts';
import { expectKeys } from '../support/expect-pairs.ts';
import { type Entry, Modelled, meet, overlaps, pairsOf } from '../support/model.ts';
import { keyOf, pairOf } from '../support/reference.ts';
import { runs, seed } from '../support/runs.ts';
import { setBox } from '../support/set-box.ts';
import { wrappedPairs } from '../support/wrapped-reference.ts';

type Loose = Record<string, (...given: unknown[]) => unknown>;

const whole = () => 0;
const ascending = (ids: Iterable<number>) => [...ids].sort((a, b) => a - b);
const keysIn = (pairs: Uint32Array) =>
  ascending(Array.from({ length: pairs.length / 2 }, (_, k) => keyOf(pairs[2 * k]!, pairs[2 * k + 1]!)));

const apartPairs = (entries: ReadonlyMap<number, Entry>, dimensions: number) =>
  pairsOf(entries, dimensions).filter((key) => {
    const [a, b] = pairOf(key);
    return overlaps(entries.get(a)!.box, entries.get(b)!.box);
  });

/** One more random call; some boxes are nowhere, and some are points at whole places, where many sides are. */
function step(model: Modelled): void {
  const { dimensions } = model.space;
  const chance = model.random();
  if (chance < 0.1) {
    const point = Array.from({ length: dimensions }, () => model.integer(60));
    model.set(model.id(), [...point, ...point]);
  } else if (chance < 0.13) {
    const box = model.box();
    const axis = model.integer(dimensions);
    box[axis] = box[axis + dimensions] = model.random() < 0.5 ? Infinity : -Infinity;
    model.set(model.id(), box);
  } else model.step();
}

describeEach(`%s in %d dimensions (SEED=${seed})`, (technique, dimensions) => {
  test.each([
    ['doubles', undefined],
    ['float32', whole],
  ])('pairs, events and lookups after any calls, with %s', (_, place) => {
    for (let run = 0; run < runs(2); run++) {
      const model = new Modelled({ technique, dimensions, events: true, touching: false }, seed + run, place);
      let before = new Set<number>();
      for (let call = 1; call <= 600; call++) {
        step(model);
        if (call % 20) continue;
        const keys = apartPairs(model.entries, dimensions);
        expectKeys(model.space.update(), keys);
        model.space.validate();
        const now = new Set(keys);
        const isGone = (key: number) =>
          model.deleted.has(Math.floor(key / 2 ** 24)) || model.deleted.has(key % 2 ** 24);
        expect(keysIn(model.space.began)).toEqual(ascending([...now].filter((k) => !before.has(k) || isGone(k))));
        expect(keysIn(model.space.ended)).toEqual(ascending([...before].filter((k) => !now.has(k) || isGone(k))));
        before = now;
        model.deleted.clear();
        const [a, b] = [model.id(), model.id()];
        if (a !== b) expect(model.space.isColliding(a, b)).toBe(now.has(keyOf(a, b)));
      }
    }
  });

  test('two boxes that are nowhere along an axis only touch there, as doubles too', () => {
    for (const x of [3, 0.1]) {
      const space = new BroadPhase({ technique, dimensions, touching: false });
      const low = [x, ...Array(dimensions - 1).fill(Infinity)];
      const high = [x + 10, ...Array(dimensions - 1).fill(Infinity)];
      for (let id = 0; id < 40; id++) setBox(space, id, [...low, ...high]);
      expect(space.update().pairCount).toBe(0);
    }
  });

  test('a floor of tiles: none touches its neighbours, until one is a little larger', () => {
    const space = new BroadPhase({ technique, dimensions, touching: false });
    const side = dimensions === 2 ? 20 : 8;
    const tile = (id: number) => {
      const at = Array.from({ length: dimensions }, (_, a) => Math.floor(id / side ** a) % side);
      return [...at, ...at.map((x) => x + 1)];
    };
    for (let id = 0; id < side ** dimensions; id++) setBox(space, id, tile(id));
    for (let k = 0; k < 8; k++) expect(space.update().pairCount).toBe(0);
    const middle = (side ** dimensions - 1) >> 1;
    setBox(space, 0, [
      ...tile(0).slice(0, dimensions),
      ...tile(0)
        .slice(dimensions)
        .map((x) => x + 2 ** -40),
    ]);
    expect(space.update().pairCount).toBe(2 ** dimensions - 1);
    setBox(
      space,
      middle,
      tile(middle).map((x) => x + 0.5),
    );
    expect(space.update().pairCount).toBeGreaterThan(2 ** dimensions - 1);
  });

  test('in a world that wraps around', { tags: 'long' }, () => {
    const wrap = Array.from({ length: dimensions }, () => 40);
    for (const place of [whole, undefined]) {
      const model = new Modelled({ technique, dimensions, wrap, touching: false }, seed, place);
      for (let call = 1; call <= 200; call++) {
        step(model);
        if (call % 20) continue;
        const boxes = new Map([...model.entries].map(([id, { box }]) => [id, box]));
        const keys = wrappedPairs(boxes, wrap, false).filter((key) => {
          const [a, b] = pairOf(key);
          return meet(model.entries.get(a)!, model.entries.get(b)!);
        });
        expectKeys(model.space.update(), keys);
        const given = [...model.entries.values()].flatMap(({ box }) => box);
        const rules = Uint32Array.from(
          [...model.entries.values()].flatMap(({ layer, mask, isStatic }) => [layer, mask, Number(isStatic)]),
        );
        const ids = [...model.entries.keys()];
        expect(exactPairs(given, dimensions, ids, rules, wrap, { touching: false })).toEqual(keys);
      }
    }
  });
});

describe.each(BroadPhase.techniques)('%s', (technique) => {
  test.each([0, 0.1])('a box at infinity does not overlap an infinite box (%d)', (fraction) => {
    const space = new BroadPhase({ technique, touching: false });
    for (let id = 2; id < 20; id++) space.set(id, 10 * id, 0, 10 * id + 9 + fraction, 1);
    space.set(0, Infinity, 0, Infinity, 9).set(1, 300, 3, Infinity, 5);
    expect(space.update().pairCount).toBe(0);
    space.set(0, -Infinity, 0, -Infinity, 9).set(1, -Infinity, 3, -300, 5);
    expect(space.update().pairCount).toBe(0);
  });
});

describe.each([2, 3] as const)('queries in %d dimensions', (dimensions) => {
  test.each([
    ['doubles', undefined, true],
    ['float32', whole, true],
    ['float32, by the space', whole, false],
    ['doubles, by the space', undefined, false],
  ])('about places, with %s', (_, place, closed) => {
    const model = new Modelled({ dimensions, touching: closed }, seed, place, 20);
    const space = model.space as unknown as Loose;
    const asked = closed ? { touching: false } : {};
    const both = { touching: true };
    const squared = (point: readonly number[], box: readonly number[]) =>
      point.reduce((sum, x, a) => sum + Math.max(box[a]! - x, x - box[a + dimensions]!, 0) ** 2, 0);
    const within = (box: readonly number[], inner: readonly number[]) =>
      inner.every((x, k) => (k < dimensions ? box[k]! < x : x < box[k]!));
    for (let call = 1; call <= 500; call++) {
      step(model);
      if (call % 5) continue;
      model.space.update();
      const ids = (wanted: (box: readonly number[]) => boolean) =>
        ascending([...model.entries].filter(([, { box }]) => wanted(box)).map(([id]) => id));
      const box = model.box();
      const found = ids((its) => overlaps(box, its));
      expect(ascending(space.queryBox!(...box, asked) as number[])).toEqual(found);
      const inside = ids((its) => within(box, its));
      expect(ascending(space.queryBox!(...box, { ...asked, within: true }) as number[])).toEqual(inside);
      const touched = ids((its) =>
        its.every((x, k) => (k < dimensions ? x <= box[k + dimensions]! : box[k - dimensions]! <= x)),
      );
      expect(ascending(space.queryBox!(...box, both) as number[])).toEqual(touched);
      const visited: number[] = [];
      space.queryBox!(...box, { ...asked, visit: (id: number) => visited.push(id) });
      expect(ascending(visited)).toEqual(found);
      const point = Array.from({ length: dimensions }, () => model.integer(20));
      const at = ids((its) => overlaps([...point, ...point], its));
      expect(ascending(space.queryPoint!(...point, asked) as number[])).toEqual(at);
      const radius = model.integer(6);
      const round = radius === 0 ? at : ids((its) => squared(point, its) < radius * radius);
      const ask = dimensions === 2 ? 'queryCircle' : 'querySphere';
      expect(ascending(space[ask]!(...point, radius, asked) as number[])).toEqual(round);
      const plane = [1, ...point.slice(1).map(() => 0), -point[0]!];
      const front = new Map<number, boolean>();
      space.queryPlanes!(plane, { ...asked, visit: (id: number, is: boolean) => front.set(id, is) });
      expect(ascending(front.keys())).toEqual(ids((its) => its[dimensions]! > point[0]!));
      expect(ascending([...front].filter(([, is]) => is).map(([id]) => id))).toEqual(ids((its) => its[0]! > point[0]!));
      const many = (name: string, numbers: readonly number[], more = {}) => {
        const answer = space[name]!(numbers, { ...asked, ...more }) as { ids: Uint32Array };
        return ascending(answer.ids);
      };
      expect(many('queryBoxes', box)).toEqual(found);
      expect(many('queryBoxes', box, { within: true })).toEqual(inside);
      expect(many('queryPoints', point)).toEqual(at);
      expect(many('queryCircles', [...point, radius])).toEqual(round);
    }
  });
});

// In float32, a double that is infinite is a bound at the largest number, and another at infinity: they look apart.
test.each(['auto', 'incremental'] as const)(
  'boxes of doubles that rest at infinity are no pairs, with %s',
  (technique) => {
    for (const far of [Infinity, -Infinity]) {
      const space = new BroadPhase({ touching: false, technique });
      for (let id = 0; id < 200; id++) space.set(id, 0.1, 3 * id, 1.1, 3 * id + 1);
      for (let id = 200; id < 210; id++) space.set(id, far, id, far, id + 5);
      space.set(210, Math.min(far, 7.1), 0, Math.max(far, 7.1), 300);
      for (let frame = 0; frame < 40; frame++) {
        space.set(0, 0.1, 0, 1.1, 1 + (frame % 2) / 8);
        expect(space.update().pairCount).toBe(far < 0 ? 100 : 0);
      }
      expect(space.stats.tests).toBeLessThan(200); // candidates are retained
    }
  },
);

describe('recordings', () => {
  test.each([2, 3] as const)('hold it in %d dimensions, and replays are checked against it', (dimensions) => {
    const model = new Modelled({ dimensions, touching: false }, seed, whole);
    const recording = record(model.space);
    for (let call = 1; call <= 300; call++) {
      step(model);
      if (call % 10 === 0) model.space.update();
    }
    const trace = openTrace(recording.bytes());
    expect(trace.touching).toBe(false);
    let pairs = 0;
    for (const frame of replay(trace, {}, true)) {
      expect(frame.difference).toBeNull();
      pairs = frame.pairs;
    }
    expect(pairs).toBe(model.space.pairCount);
  });

  test('of other spaces have the header they had', () => {
    expect(record(new BroadPhase()).bytes()[11]).toBe(0);
    expect(record(new BroadPhase({ wrap: [10, 10], touching: false })).bytes()[11]).toBe(3);
  });
});

describe('what is no boolean is refused', () => {
  test.each([0, 'no', null])('%s', (touching) => {
    expect(() => new BroadPhase({ touching } as never)).toThrow('touching: got');
    const space = new BroadPhase().setAll([0, 0, 1, 1]).update() as unknown as Loose;
    expect(() => space.queryBox!(0, 0, 1, 1, { touching })).toThrow('queryBox: touching: got');
    expect(() => space.queryBoxes!([0, 0, 1, 1], { touching })).toThrow('queryBoxes: touching: got');
    expect(() => space.nearest!(0, 0, 1, { touching: false })).toThrow('there is no option "touching"');
  });
});
