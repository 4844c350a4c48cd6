// Boxes of one group: never a pair, whatever else is done with them. SEED=… runs the same sequences again.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { openTrace } from '../../src/trace/reader.ts';
import { record } from '../../src/trace/record.ts';
import { applyFrame, replay } from '../../src/trace/replay.ts';
import { describeEach } from '../support/each-technique.ts';
import { expectKeys } from '../support/expect-pairs.ts';
import { Modelled, meet, pairsOf } from '../support/model.ts';
import { keyOf, pairOf } from '../support/reference.ts';
import { runs, seed } from '../support/runs.ts';
import { setBox } from '../support/set-box.ts';
import { wrappedPairs } from '../support/wrapped-reference.ts';

type Loose = Record<string, (...given: unknown[]) => unknown>;

const whole = () => 0;
const ascending = (ids: Iterable<number>) => [...ids].sort((a, b) => a - b);
const keysIn = (pairs: Uint32Array) =>
  ascending(Array.from({ length: pairs.length / 2 }, (_, k) => keyOf(pairs[2 * k]!, pairs[2 * k + 1]!)));

const numbers = [0, 1, 2, 3, 2 ** 32 - 1];

/** One more random call, of which many give boxes a group; or the boxes tremble, so that what is found is kept. */
function step(model: Modelled): void {
  const chance = model.random();
  if (chance < 0.35) model.setGroup(model.id(), numbers[model.integer(numbers.length)]!);
  else if (chance < 0.4) model.setEnabled(model.id(), model.random() < 0.5);
  else model.step();
}

describeEach(`%s in %d dimensions (SEED=${seed})`, (technique, dimensions) => {
  test.each([
    ['doubles', undefined],
    ['float32', whole],
  ])('leaves their pairs out of pairs and events after any calls, with %s', (_, place) => {
    for (let run = 0; run < runs(2); run++) {
      const model = new Modelled({ technique, dimensions, events: true }, seed + run, place);
      let before = new Set<number>();
      for (let call = 1; call <= 600; call++) {
        step(model);
        if (call % 20) continue;
        const keys = pairsOf(model.entries, dimensions);
        expectKeys(model.space.update(), keys);
        model.space.validate();
        const now = new Set(keys);
        const isGone = (key: number) =>
          model.deleted.has(Math.floor(key / 2 ** 24)) || model.deleted.has(key % 2 ** 24);
        expect(keysIn(model.space.began)).toEqual(ascending([...now].filter((k) => !before.has(k) || isGone(k))));
        expect(keysIn(model.space.ended)).toEqual(ascending([...before].filter((k) => !now.has(k) || isGone(k))));
        before = now;
        model.deleted.clear();
        for (const [id, { group }] of model.entries) expect(model.space.groupOf(id)).toBe(group ?? 0);
      }
    }
  });

  test('while boxes tremble, come, go and change their group, and some are off', { tags: 'long' }, () => {
    // Enough boxes that structure is kept between updates.
    const model = new Modelled({ technique, dimensions }, seed, undefined, dimensions === 2 ? 150 : 45, 1000);
    for (let id = 0; id < 700; id++) {
      model.set(id);
      model.setGroup(id, id % 3 === 0 ? 0 : 1 + Math.floor(id / 20));
    }
    for (let update = 0; update < 60; update++) {
      for (const [id, { box }] of model.entries) {
        const shift = id % 2 ? 0.01 * model.random() : 0;
        model.set(
          id,
          box.map((x) => x + shift),
        );
      }
      if (update % 4 === 3) {
        model.setGroup(model.id(), model.integer(40));
        model.delete(model.id());
        model.set(model.id());
        model.setEnabled(model.id(), update % 8 === 3);
        model.filter(model.id(), 1 + model.integer(3), 1 + model.integer(7));
      }
      expectKeys(model.space.update(), pairsOf(model.entries, dimensions));
    }
  });

  test('in a world that wraps around', () => {
    const wrap = Array.from({ length: dimensions }, () => 40);
    const model = new Modelled({ technique, dimensions, wrap }, seed, whole);
    for (let call = 1; call <= 300; call++) {
      step(model);
      if (call % 30) continue;
      const boxes = new Map([...model.entries].map(([id, { box }]) => [id, box]));
      const keys = wrappedPairs(boxes, wrap).filter((key) => {
        const [a, b] = pairOf(key);
        return meet(model.entries.get(a)!, model.entries.get(b)!);
      });
      expectKeys(model.space.update(), keys);
    }
  });
});

describe.each([2, 3] as const)('in %d dimensions', (dimensions) => {
  const unit = Array.from({ length: 2 * dimensions }, (_, k) => (k < dimensions ? 0 : 1));

  test('the group belongs to the id: it stays when the box moves, and goes with delete and clear', () => {
    const space = new BroadPhase({ dimensions, events: true });
    setBox(space, 0, unit);
    setBox(space, 1, unit);
    space.setGroup(0, 5).setGroup(1, 5);
    expect(space.update().pairCount).toBe(0);
    setBox(space, 1, unit);
    space.setAll([...unit, ...unit]);
    space.boxes(2).set([...unit, ...unit]);
    expect(space.update().pairCount).toBe(0);
    expect((space as unknown as Loose).queryBox!(...unit)).toHaveLength(2);
    expect([...space.setGroup(1, 6).update().began]).toEqual([0, 1]);
    expect([...space.setGroup(1, 5).update().ended]).toEqual([0, 1]);
    space.delete(1);
    expect(space.groupOf(1)).toBeUndefined();
    setBox(space, 1, unit);
    expect(space.groupOf(1)).toBe(0);
    expect(space.update().pairCount).toBe(1);
    space.setGroup(1, 5).clear();
    setBox(space, 0, unit);
    setBox(space, 1, unit);
    expect([space.groupOf(0), space.groupOf(1), space.update().pairCount]).toEqual([0, 0, 1]);
  });

  test('costs no tests within a group while candidates are retained', () => {
    const space = new BroadPhase({ dimensions });
    for (let id = 0; id < 2000; id++) {
      const at = 4 * Math.floor(id / 20); // twenty in one place
      setBox(
        space,
        id,
        Array.from(unit, (x, k) => x + (k % dimensions === 0 ? at : 0)),
      );
      space.setGroup(id, 1 + Math.floor(id / 20));
    }
    const tremble = (by: number) => {
      const box = [...space.get(0)!];
      setBox(
        space,
        0,
        box.map((x) => x + by),
      );
      return space.update().stats;
    };
    for (let k = 0; k < 40; k++) tremble(k % 2 ? 1e-3 : -1e-3);
    expect(tremble(1e-3)).toMatchObject({
      reason: 'candidates are retained: boxes are at rest or move little',
      tests: 0,
    });
  });

  test('snapshots hold it, in version 2; without groups and boxes written in place they have version 1', () => {
    const model = new Modelled({ dimensions, events: true }, seed, whole);
    expect(model.space.update().snapshot()[4]).toBe(1);
    for (let call = 1; call <= 300; call++) {
      step(model);
      if (call % 10) continue;
      const saved = model.space.update().snapshot();
      const grouped = [...model.entries.values()].some(({ group }) => group);
      const inPlace = (saved[5]! & 32) !== 0;
      expect(saved[4]).toBe(grouped || inPlace ? 2 : 1);
      const copy = new BroadPhase({ dimensions, events: true });
      setBox(copy, 0, unit);
      copy.setGroup(0, 9).restore(saved);
      for (const [id, { group }] of model.entries) expect(copy.groupOf(id)).toBe(group ?? 0);
      expect([...copy.snapshot()]).toEqual([...saved]);
      expect([...copy.pairs]).toEqual([...model.space.pairs]);
    }
  });

  test('recordings hold it', () => {
    const model = new Modelled({ dimensions }, seed, whole);
    const recording = record(model.space);
    const told: number[][] = [];
    for (let call = 1; call <= 500; call++) {
      step(model);
      if (call % 10) continue;
      // In turns, so that every group is recorded.
      const [id] = model.entries.keys();
      if (id !== undefined) model.setGroup(id, numbers[(call / 10) % numbers.length]!);
      told.push(keysIn(model.space.update().pairs));
    }
    const trace = openTrace(recording.bytes());
    const copy = new BroadPhase({ dimensions });
    const groups = new Set<number>();
    for (const frame of trace) {
      for (const group of frame.groups ?? []) groups.add(group);
      applyFrame(copy, frame);
      expect(keysIn(copy.update().pairs)).toEqual(told[frame.index]);
    }
    expect(groups).toEqual(new Set(numbers));
    for (const { difference } of replay(trace, {}, true)) expect(difference).toBeNull();
  });
});

describe('what is no id or no group is refused and changes nothing', () => {
  const space = new BroadPhase().setAll([0, 0, 1, 1, 0, 0, 1, 1]);
  const loose = space as unknown as Loose;

  test.each([-1, 1.5, 2 ** 24, 3, '0', undefined])('the id %s', (id) => {
    expect(() => loose.setGroup!(id, 1)).toThrow(/setGroup: (the id is|there is no box)/);
    if (id !== 3) expect(() => loose.groupOf!(id)).toThrow('groupOf: the id is');
    expect(space.groupOf(3)).toBeUndefined();
    expect(space.update().pairCount).toBe(1);
  });

  test.each([-1, 1.5, 2 ** 32, Number.NaN, '1', null, undefined])('%s for a group', (value) => {
    expect(() => loose.setGroup!(0, value)).toThrow('setGroup: group: got');
    expect(space.groupOf(0)).toBe(0);
    expect(space.update().pairCount).toBe(1);
  });
});
