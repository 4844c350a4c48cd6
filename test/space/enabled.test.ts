// Boxes that are switched off: in no pair, no event and no answer, and as they were once they are on again.
// SEED=… runs the same sequences again.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { openTrace } from '../../src/trace/reader.ts';
import { record } from '../../src/trace/record.ts';
import { applyFrame, replay } from '../../src/trace/replay.ts';
import { describeEach } from '../support/each-technique.ts';
import { expectKeys } from '../support/expect-pairs.ts';
import { Modelled, meet, pairsOf } from '../support/model.ts';
import { inBox, near } from '../support/query-reference.ts';
import { keyOf, pairOf } from '../support/reference.ts';
import { runs, seed } from '../support/runs.ts';
import { setBox } from '../support/set-box.ts';
import { wrappedPairs } from '../support/wrapped-reference.ts';

type Loose = Record<string, (...given: unknown[]) => unknown>;

const whole = () => 0;
const ascending = (ids: Iterable<number>) => [...ids].sort((a, b) => a - b);
const keysIn = (pairs: Uint32Array) =>
  ascending(Array.from({ length: pairs.length / 2 }, (_, k) => keyOf(pairs[2 * k]!, pairs[2 * k + 1]!)));

/** One more random call, of which many switch boxes. */
function step(model: Modelled): void {
  if (model.random() < 0.4) model.setEnabled(model.id(), model.random() < 0.5);
  else model.step();
}

/** Asks for some boxes, and for the nearest. */
function ask(model: Modelled): void {
  const space = model.space as unknown as Loose;
  const box = model.box();
  expect(ascending(space.queryBox!(...box) as number[])).toEqual(inBox(model.entries, box, {}));
  const point = box.slice(0, box.length / 2).map((x) => (Number.isFinite(x) ? x : 0));
  expect(space.nearest!(...point, 9)).toEqual(near(model.entries, point, 9, {}).map(({ id }) => id));
}

describeEach(`%s in %d dimensions (SEED=${seed})`, (technique, dimensions) => {
  test.each([
    ['doubles', undefined],
    ['float32', whole],
  ])('leaves them out of pairs, events and answers after any calls, with %s', (_, place) => {
    for (let run = 0; run < runs(2); run++) {
      const model = new Modelled({ technique, dimensions, events: true }, seed + run, place);
      let before = new Set<number>();
      for (let call = 1; call <= 600; call++) {
        step(model);
        if (call % 20) continue;
        const keys = pairsOf(model.entries, dimensions);
        expectKeys(model.space.update(), keys);
        model.space.validate();
        ask(model);
        const now = new Set(keys);
        const isGone = (key: number) =>
          model.deleted.has(Math.floor(key / 2 ** 24)) || model.deleted.has(key % 2 ** 24);
        expect(keysIn(model.space.began)).toEqual(ascending([...now].filter((k) => !before.has(k) || isGone(k))));
        expect(keysIn(model.space.ended)).toEqual(ascending([...before].filter((k) => !now.has(k) || isGone(k))));
        before = now;
        model.deleted.clear();
        for (const [id, { isOff }] of model.entries) expect(model.space.isEnabled(id)).toBe(!isOff);
      }
    }
  });

  test('does not search them, whatever filters there are', () => {
    const space = new BroadPhase({ technique, dimensions });
    for (let id = 0; id < 300; id++) {
      setBox(
        space,
        id,
        Array.from({ length: 2 * dimensions }, (_, k) => (k < dimensions ? 0 : 1)),
      );
      // More kinds of filters than the kernel keeps account of.
      space.setFilter(id, 1, 1 + 2 * id).setEnabled(id, id < 2);
    }
    expect(space.update().pairs).toEqual(Uint32Array.of(0, 1));
    expect(space.stats.candidates).toBe(1);
    space.setEnabled(0, false);
    expect(space.update().stats).toMatchObject({ candidates: 0, pairs: 0 });
    space.setEnabled(1, false);
    expect(space.update().stats).toMatchObject({ tests: 0, candidates: 0, pairs: 0 });
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
  const all = (space: BroadPhase<2 | 3>) => ascending((space as unknown as Loose).queryBox!(...unit) as number[]);

  test('answers are those of the last update, and nothing is found if all boxes are off', () => {
    const space = new BroadPhase({ dimensions });
    for (let id = 0; id < 20; id++) setBox(space, id, unit);
    space.update();
    expect(all(space)).toHaveLength(20);
    space.setEnabled(3, false);
    expect(all(space)).toHaveLength(20);
    space.update();
    expect(all(space)).toEqual(ascending(Array.from({ length: 20 }, (_, id) => id).filter((id) => id !== 3)));
    for (let id = 0; id < 20; id++) space.setEnabled(id, false);
    space.update();
    expect(all(space)).toEqual([]);
    const plane = [1, ...unit.slice(1, dimensions), 5]; // all are wholly in front of it
    const loose = space as unknown as Loose;
    expect(loose.queryPlanes!(plane)).toEqual([]);
    expect(loose.nearest!(...unit.slice(dimensions), 3)).toEqual([]);
    expect(loose.rayCastAll!(...unit)).toEqual([]);
    const fresh = new BroadPhase({ dimensions }).restore(space.snapshot());
    expect(all(fresh)).toEqual([]);
    expect([fresh.size, fresh.has(3), fresh.isEnabled(3)]).toEqual([20, true, false]);
    fresh.setEnabled(3, true).update();
    expect((fresh as unknown as Loose).queryPlanes!(plane)).toEqual([3]);
    expect(all(fresh)).toEqual([3]);
  });

  test('answers are right if as many boxes are off as are gone afterwards', () => {
    // As many places in the index as boxes, but not of these boxes.
    const space = new BroadPhase({ dimensions });
    space.setAll(Array(20).fill(unit).flat());
    for (const id of [2, 8, 12]) space.setEnabled(id, false);
    space.update();
    expect(all(space)).toHaveLength(17);
    space.clear();
    space.setAll(Array(17).fill(unit).flat());
    space.update();
    expect(all(space)).toEqual(Array.from({ length: 17 }, (_, id) => id));
  });

  test('a box that is off can be set in all ways, and keeps the new numbers', () => {
    const space = new BroadPhase({ dimensions, events: true });
    setBox(space, 0, unit);
    setBox(space, 1, unit);
    space.setFilter(1, 2, 3).setStatic(1).setEnabled(1, false).update();
    setBox(space, 1, unit);
    space.setAll([...unit, ...unit]);
    space.boxes(2).set([...unit, ...unit]);
    expect(space.update().pairCount).toBe(0);
    expect(space.filterOf(1)).toEqual({ layer: 2, mask: 3 });
    expect([space.isStatic(1), space.isEnabled(1), space.size]).toEqual([true, false, 2]);
    expect([...space.setEnabled(1, true).update().began]).toEqual([0, 1]);
    expect([...space.setEnabled(1, false).setEnabled(1, true).update().ended]).toEqual([]);
    expect([...space.setEnabled(1, false).update().ended]).toEqual([0, 1]);
    space.delete(1);
    setBox(space, 1, unit);
    expect(space.isEnabled(1)).toBe(true);
    space.setEnabled(1, false).clear();
    setBox(space, 0, unit);
    setBox(space, 1, unit);
    expect(space.update().pairCount).toBe(1);
  });

  test('recordings and snapshots hold it', () => {
    const model = new Modelled({ dimensions, events: true }, seed, whole);
    const recording = record(model.space);
    const told: string[] = [];
    for (let call = 1; call <= 400; call++) {
      step(model);
      if (call % 10) continue;
      model.space.update();
      told.push([...model.space.pairs].join());
      const saved = model.space.snapshot();
      expect([...new BroadPhase({ dimensions, events: true }).restore(saved).snapshot()]).toEqual([...saved]);
    }
    const trace = openTrace(recording.bytes());
    const off = new Set<boolean>();
    const copy = new BroadPhase({ dimensions });
    const sorted = (pairs: Uint32Array) => keysIn(pairs).join();
    for (const frame of trace) {
      for (let k = 2; k < (frame.rules?.length ?? 0); k += 3) off.add((frame.rules![k]! & 2) !== 0);
      applyFrame(copy, frame);
      const numbers = told[frame.index]! === '' ? [] : told[frame.index]!.split(',').map(Number);
      expect(sorted(copy.update().pairs)).toBe(sorted(Uint32Array.from(numbers)));
    }
    expect(off).toEqual(new Set([false, true]));
    for (const { difference } of replay(trace, {}, true)) expect(difference).toBeNull();
  });
});

describe('what is no id or no boolean is refused and changes nothing', () => {
  const space = new BroadPhase().setAll([0, 0, 1, 1, 0, 0, 1, 1]);
  const loose = space as unknown as Loose;

  test.each([-1, 1.5, 2 ** 24, 3, '0', undefined])('the id %s', (id) => {
    expect(() => loose.setEnabled!(id, false)).toThrow(/setEnabled: (the id is|there is no box)/);
    if (id !== 3) expect(() => loose.isEnabled!(id)).toThrow('isEnabled: the id is');
    expect(space.isEnabled(3)).toBe(false);
    expect(space.update().pairCount).toBe(1);
  });

  test.each([1, 'yes', null, undefined])('%s for enabled', (value) => {
    expect(() => loose.setEnabled!(0, value)).toThrow('setEnabled: enabled: got');
    expect(space.update().pairCount).toBe(1);
  });
});
