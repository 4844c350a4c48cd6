// The pairs of two spaces that are kept: those of a test of every pair of boxes, whatever came before. SEED=… runs a failure
// again, RUNS=… runs more.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { copyOf } from '../support/asker.ts';
import { type Entry, grown, Modelled, overlaps, touches } from '../support/model.ts';
import type { Entries } from '../support/query-reference.ts';
import { runs, seed } from '../support/runs.ts';
import { wrappedOverlap } from '../support/wrapped-reference.ts';

const keyOf = (a: number, b: number) => `${a} ${b}`;

/** Pairs as texts, sorted. */
function keys(pairs: Uint32Array): string[] {
  const found: string[] = [];
  for (let k = 0; k < pairs.length; k += 2) found.push(keyOf(pairs[k]!, pairs[k + 1]!));
  return found.sort();
}

const meets = (a: Entry, b: Entry) => !a.isOff && !b.isOff && (a.layer & b.mask) !== 0 && (b.layer & a.mask) !== 0;

function expected(here: Entries, there: Entries, wrap?: readonly number[], touching = true): string[] {
  const found: string[] = [];
  for (const [a, entry] of here) {
    for (const [b, other] of there) {
      const [one, its] = [grown(entry), grown(other)];
      const overlap = wrap
        ? wrappedOverlap(one, its, wrap, touching)
        : touching
          ? touches(one, { ...other, box: its })
          : overlaps(one, its);
      if (overlap && meets(entry, other)) found.push(keyOf(a, b));
    }
  }
  return found.sort();
}

/** The boxes of a space, none of which has a filter. */
const seenOf = (space: BroadPhase): Entries =>
  new Map(
    [...space].map(([id, box]) => [
      id,
      { box: [...box], layer: 1, mask: 1, isStatic: false, reach: space.reachOf(id) ?? 0 },
    ]),
  );

/** A space with its model, and what its last update saw. */
class Side extends Modelled {
  seen: Entries = new Map();
  reaching = false;

  change(count: number): void {
    for (let n = 0; n < count; n++) {
      if (this.reaching && this.random() < 0.1) this.setReach(this.id(), [0, 1, 3, 0.1][this.integer(4)]!);
      else if (this.random() < 0.1) this.setEnabled(this.id(), this.random() < 0.5);
      else if (this.random() < 0.7) this.set(this.id());
      else this.step();
    }
  }
  update(): void {
    this.space.update();
    this.seen = copyOf(this.entries);
  }
}

const cases = ([2, 3] as const).flatMap((dimensions) =>
  [undefined, [60, 45, 50].slice(0, dimensions)].flatMap((wrap) =>
    [true, false].map((touching) => [dimensions, wrap, touching] as const),
  ),
);

describe(`pairs with another space (SEED=${seed})`, () => {
  test.each(cases)('in %iD, wrapped %j, touching %j', { tags: 'long' }, (dimensions, wrap, touching) => {
    for (let round = 0; round < runs(36); round++) {
      const options = { dimensions, touching, ...(wrap && { wrap }) } as never;
      const here = new Side(options, seed + round);
      const there = new Side(options, seed + round + 1000);
      if (round % 5) here.space.technique = there.space.technique = 'incremental'; // it tells what an update has changed
      here.reaching = round % 4 === 1 || round % 4 === 3;
      there.reaching = round % 4 > 1;
      const frames = round % 3 ? 4 : 40; // many short rounds, since some faults show only after a first call
      for (let frame = 0; frame < frames; frame++) {
        for (const side of [here, there]) {
          side.change(frame === 0 ? 60 : side.integer(3) * side.integer(6));
          if (side.random() < 0.8) side.update();
          if (side.random() < 0.3) side.change(3); // not seen before the next update
        }
        if (here.random() < 0.2) continue;
        expect(keys(here.space.pairsWith(there.space))).toEqual(expected(here.seen, there.seen, wrap, touching));
        if (here.random() < 0.3) {
          expect(keys(there.space.pairsWith(here.space))).toEqual(expected(there.seen, here.seen, wrap, touching));
        }
      }
    }
  });

  /** Moves most boxes of a side a little: they stay within their regions, whose lists then have the pairs. */
  function creep(side: Side, doubles: boolean): void {
    for (const [id, { box }] of side.entries) {
      if (side.random() < 0.1) continue;
      const by = box.map(() => (side.random() - 0.5) / 4);
      const d = box.length / 2;
      side.set(id, doubles ? box.map((x, k) => x + by[k % d]!) : box.map((x, k) => Math.fround(x + by[k % d]!)));
    }
  }

  test.each(cases.filter(([, wrap]) => !wrap))(
    'of boxes that creep, come, go, and change their rules, in %iD, wrapped %j, touching %j',
    (dimensions, _, touching) => {
      for (let round = 0; round < runs(16); round++) {
        const options = { dimensions, touching } as never;
        const here = new Side(options, seed + round);
        const there = new Side(options, seed + round + 1000);
        here.reaching = round % 4 > 1;
        there.reaching = round % 2 > 0;
        if (round % 3) here.space.technique = there.space.technique = 'incremental';
        for (let frame = 0; frame < 24; frame++) {
          creep(here, round % 5 > 1);
          if (frame % 8 === 7) creep(there, round % 5 > 2);
          here.change(frame === 0 ? 50 : here.integer(2) * here.integer(4));
          there.change(frame === 0 ? 90 : there.integer(2) * there.integer(3));
          here.update();
          there.update();
          if (frame % 12 === 11) here.replace(40, round % 2 > 0, () => here.box());
          expect(keys(here.space.pairsWith(there.space))).toEqual(expected(here.seen, there.seen, undefined, touching));
        }
      }
    },
  );

  test('with more spaces than have lists, in any order', () => {
    for (let round = 0; round < runs(8); round++) {
      const options = { dimensions: 2 } as never;
      const movers = new Side(options, seed + round);
      movers.change(30);
      const others = Array.from({ length: 24 }, (_, k) => new Side(options, seed + round + 100 * k));
      for (const other of others) {
        other.change(20 + other.integer(60));
        other.update();
      }
      for (let frame = 0; frame < 20; frame++) {
        creep(movers, true);
        movers.update();
        for (let n = 0; n < 12; n++) {
          const k = movers.integer(others.length);
          const other = others[k]!;
          if (other.random() < 0.1) {
            other.space.dispose();
            others[k] = new Side(options, seed + round + 100 * frame);
            continue;
          }
          if (other.random() < 0.3) other.change(2);
          if (other.random() < 0.7) other.update();
          expect(keys(movers.space.pairsWith(other.space))).toEqual(expected(movers.seen, other.seen));
          if (n % 4) continue;
          expect(keys(other.space.pairsWith(movers.space))).toEqual(expected(other.seen, movers.seen));
        }
      }
    }
  });

  test('an array of pairs stays as it is when another space takes over the lists', () => {
    const movers = new BroadPhase().set(3, 0, 0, 1, 1).update();
    const levels = Array.from({ length: 20 }, (_, k) => new BroadPhase().set(k, 0, 0, 9, 9).update());
    const found = levels.map((level) => movers.pairsWith(level));
    expect(found.map((pairs) => [...pairs])).toEqual(levels.map((_, k) => [3, k]));
  });

  test('what rests is looked at once, and the same array comes again', () => {
    const level = new BroadPhase().setAll(Array.from({ length: 400 }, (_, k) => (k >> 2) + (k & 2 ? 2 : 0))).update();
    const movers = new BroadPhase().set(3, 5, 5, 6, 6).update();
    const first = movers.pairsWith(level);
    expect(movers.update().pairsWith(level)).toBe(first);
    expect(keys(first)).toEqual(['3 3', '3 4', '3 5', '3 6']);
  });

  test.each(['here', 'there'])('a box deleted %s before the first call is gone after the next update', (side) => {
    const [here, there] = [0, 1].map(() => {
      const space = new BroadPhase({ technique: 'incremental' });
      for (let id = 0; id < 50; id++) space.set(id, 10 * id, 0, 10 * id + 1, 1);
      return space.update();
    }) as [BroadPhase, BroadPhase];
    (side === 'here' ? here : there).delete(49);
    expect(here.pairsWith(there).length / 2).toBe(50);
    here.update();
    there.update();
    expect(here.pairsWith(there).length / 2).toBe(49);
  });

  // 0.1 + 3 is 3.1, but 3.1 - 3 is above 0.1; further out the sum is rounded by more than the other box shows.
  test.each([
    [{}, 0.1, 3.1],
    [{ wrap: [60, 45] as const }, 0.1, 3.1],
    [{ wrap: [60, 45] as const }, 2 ** 36 - 1 + 3 * 2 ** -17, (2 ** 36 + 2 + 2 ** -15) % 45],
  ])('a box that reaches another by rounding, %j, %d', (options, y, touched) => {
    const here = new BroadPhase(options).set(1, 31, touched, 31, touched).update();
    const there = new BroadPhase(options).set(2, 30, y, 32, y).setReach(2, 3).update();
    expect([...here.pairsWith(there)]).toEqual([1, 2]);
    expect([...there.pairsWith(here)]).toEqual([2, 1]);
  });

  test('a bound that overflows when its box reaches out meets what lies at infinity, as within one space', () => {
    const most = Number.MAX_VALUE;
    for (const side of [1, -1]) {
      const far = side > 0 ? [0, 0, most, 1] : [-most, 0, 0, 1];
      const end = side * Infinity;
      const one = new BroadPhase().set(0, far[0]!, far[1]!, far[2]!, far[3]!).setReach(0, 1e308);
      one.set(1, end, 0, end, 1).update();
      expect([...one.pairs]).toEqual([0, 1]);
      const other = new BroadPhase().set(7, end, 0, end, 1).update();
      expect(keys(one.pairsWith(other))).toEqual(['0 7', '1 7']);
      expect(keys(other.pairsWith(one))).toEqual(['7 0', '7 1']);
      other.set(7, end, 0, end, 0.5).set(8, end, 5, end, 6).update();
      expect(keys(one.pairsWith(other))).toEqual(expected(seenOf(one), seenOf(other)));
    }
  });

  test('a restored snapshot is recorded', () => {
    const level = new BroadPhase().set(1, 0, 0, 9, 9).update();
    const movers = new BroadPhase().set(7, 0, 0, 1, 1).update();
    const saved = movers.snapshot();
    movers.set(7, 20, 20, 21, 21).update();
    expect(movers.pairsWith(level).length).toBe(0);
    expect([...movers.restore(saved).pairsWith(level)]).toEqual([7, 1]);
  });

  test('what is no other space is refused by name', () => {
    const space = new BroadPhase();
    const call = (other: unknown) => () => space.pairsWith(other as never);
    expect(call(space)).toThrow('pairsWith: got the space itself, expected another');
    expect(call(undefined)).toThrow('pairsWith: got undefined, expected another BroadPhase');
    expect(call({})).toThrow(TypeError);
    expect(call(new BroadPhase({ dimensions: 3 }))).toThrow('pairsWith: dimensions of the other: got 3, expected 2');
    expect(call(new BroadPhase({ wrap: [9, 9] }))).toThrow('pairsWith: wrap of the other: got [9, 9], expected none');
    expect(call(new BroadPhase({ touching: false }))).toThrow(
      'touching of the other: got false, expected true as here',
    );
    const gone = new BroadPhase();
    gone.dispose();
    expect(call(gone)).toThrow('pairsWith: the other BroadPhase was disposed');
    expect(() => gone.pairsWith(space)).toThrow('this BroadPhase was disposed');
  });

  test('a large space that was changed before its first query throws, and is intact after', () => {
    const boxes = Array.from({ length: 4 * 20_000 }, (_, k) => (k >> 2) + (k & 2 ? 1 : 0));
    const level = new BroadPhase().setAll(boxes).update();
    const movers = new BroadPhase().set(7, 0, 0, 0.5, 0.5).update();
    level.set(0, 5, 5, 6, 6);
    expect(() => movers.pairsWith(level)).toThrow(
      'pairsWith: the other BroadPhase: boxes have changed since the last update',
    );
    expect([...movers.pairsWith(level.set(0, 0, 0, 1, 1).update())]).toEqual([7, 0]);
  });
});
