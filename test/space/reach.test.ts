// Boxes that reach beyond themselves: in pairs as if they were larger, in queries as they are. SEED=… runs the same
// sequences again.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { openTrace } from '../../src/trace/reader.ts';
import { record } from '../../src/trace/record.ts';
import { applyFrame, replay } from '../../src/trace/replay.ts';
import { describeEach } from '../support/each-technique.ts';
import { expectKeys } from '../support/expect-pairs.ts';
import { grown, Modelled, meet, pairsOf } from '../support/model.ts';
import { inBox } from '../support/query-reference.ts';
import { keyOf, pairOf } from '../support/reference.ts';
import { runs, seed } from '../support/runs.ts';
import { setBox } from '../support/set-box.ts';
import { wrappedPairs } from '../support/wrapped-reference.ts';

type Loose = Record<string, (...given: unknown[]) => unknown>;

const whole = () => 0;
const ascending = (ids: Iterable<number>) => [...ids].sort((a, b) => a - b);
const keysIn = (pairs: Uint32Array) =>
  ascending(Array.from({ length: pairs.length / 2 }, (_, k) => keyOf(pairs[2 * k]!, pairs[2 * k + 1]!)));

/** Also less than float32 can add, and without an end. */
const distances = [0, 1, 0.5, 0.1, 1e-12, 3, 1e308];

/** One more random call, of which many say how far boxes reach. */
function step(model: Modelled): void {
  const chance = model.random();
  if (chance < 0.35) model.setReach(model.id(), distances[model.integer(distances.length)]!);
  else if (chance < 0.4) model.setEnabled(model.id(), model.random() < 0.5);
  else model.step();
}

describeEach(`%s in %d dimensions (SEED=${seed})`, (technique, dimensions) => {
  test.each([
    ['doubles', undefined, true],
    ['float32', whole, true],
    ['float32 that only touch', whole, false],
  ])('pairs and events after any calls, with %s', (_, place, touching) => {
    for (let run = 0; run < runs(2); run++) {
      const model = new Modelled({ technique, dimensions, events: true, touching }, seed + run, place);
      let before = new Set<number>();
      for (let call = 1; call <= 600; call++) {
        step(model);
        if (call % 20) continue;
        const keys = pairsOf(model.entries, dimensions).filter((key) => {
          const [a, b] = pairOf(key).map((id) => grown(model.entries.get(id)!));
          return touching || a!.every((x, k) => (k < dimensions ? x < b![k + dimensions]! : b![k - dimensions]! < x));
        });
        expectKeys(model.space.update(), keys);
        model.space.validate();
        const box = model.box();
        const found = (model.space as unknown as Loose).queryBox!(...box, { touching: true }) as number[];
        expect(ascending(found)).toEqual(inBox(model.entries, box, {}));
        const now = new Set(keys);
        const isGone = (key: number) =>
          model.deleted.has(Math.floor(key / 2 ** 24)) || model.deleted.has(key % 2 ** 24);
        expect(keysIn(model.space.began)).toEqual(ascending([...now].filter((k) => !before.has(k) || isGone(k))));
        expect(keysIn(model.space.ended)).toEqual(ascending([...before].filter((k) => !now.has(k) || isGone(k))));
        before = now;
        model.deleted.clear();
        for (const [id, { reach }] of model.entries) expect(model.space.reachOf(id)).toBe(reach ?? 0);
      }
    }
  });

  test('while boxes tremble, come, go and change their reach, and some are off', { tags: 'long' }, () => {
    // Enough boxes that structure is kept between updates.
    const model = new Modelled({ technique, dimensions }, seed, undefined, dimensions === 2 ? 150 : 45, 1000);
    for (let id = 0; id < 700; id++) model.set(id);
    for (let update = 0; update < 60; update++) {
      if (update >= 20 && update % 10 === 0)
        for (let k = 0; k < 50; k++) model.setReach(model.id(), model.integer(3) / 4);
      for (const [id, { box }] of model.entries) {
        const shift = id % 2 ? 0.01 * model.random() : 0;
        model.set(
          id,
          box.map((x) => x + shift),
        );
      }
      if (update % 4 === 3) {
        model.setReach(model.id(), model.random());
        model.delete(model.id());
        model.set(model.id());
        model.setEnabled(model.id(), update % 8 === 3);
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
      const boxes = new Map([...model.entries].map(([id, entry]) => [id, grown(entry)]));
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
  const aside = unit.map((x, k) => (k % dimensions === 0 ? x + 3 : x)); // 2 from it

  test('the reach belongs to the id: it stays when the box moves, and goes with delete and clear', () => {
    const space = new BroadPhase({ dimensions, events: true });
    setBox(space, 0, unit);
    setBox(space, 1, aside);
    expect(space.setReach(0, 1).update().pairCount).toBe(0);
    expect([...space.setReach(1, 1).update().began]).toEqual([0, 1]);
    expect(space.get(1)).toEqual(Float64Array.from(aside));
    setBox(space, 1, aside);
    space.setAll([...unit, ...aside]);
    space.boxes(2).set([...unit, ...aside]);
    expect(space.update().pairCount).toBe(1);
    expect((space as unknown as Loose).queryBox!(...unit)).toEqual([0]);
    expect([...space.setReach(1, 0.5).update().ended]).toEqual([0, 1]);
    space.setReach(1, 1).delete(1);
    expect(space.reachOf(1)).toBeUndefined();
    setBox(space, 1, aside);
    expect([space.reachOf(1), space.update().pairCount]).toEqual([0, 0]);
    space.setReach(1, 1).clear();
    setBox(space, 0, unit);
    setBox(space, 1, aside);
    expect([space.reachOf(0), space.reachOf(1), space.update().pairCount]).toEqual([0, 0, 0]);
  });

  test('nothing changes while nothing does', () => {
    const space = new BroadPhase({ dimensions });
    for (let id = 0; id < 300; id++)
      setBox(
        space,
        id,
        unit.map((x, k) => (k % dimensions === 0 ? x + 2 * id : x)),
      );
    for (let id = 0; id < 300; id++) space.setReach(id, 0.5);
    for (let k = 0; k < 5; k++) expect(space.update().pairCount).toBe(299);
    expect(space.stats).toMatchObject({ tests: 0 });
    expect(space.setReach(7, 0.4).update().pairCount).toBe(297);
  });

  test('snapshots hold it, in version 2', () => {
    const model = new Modelled({ dimensions, events: true }, seed, whole);
    model.space.snapshot(); // from the first one on, the order of pairs depends on the boxes alone
    for (let call = 1; call <= 300; call++) {
      step(model);
      if (call % 10) continue;
      if (call % 20 === 0) model.setGroup(model.id(), model.integer(3));
      const saved = model.space.update().snapshot();
      const own = [...model.entries.values()].some(({ group, reach }) => group || reach);
      const inPlace = (saved[5]! & 32) !== 0;
      expect(saved[4]).toBe(own || inPlace ? 2 : 1);
      const copy = new BroadPhase({ dimensions, events: true });
      setBox(copy, 0, unit);
      copy.setReach(0, 9).restore(saved);
      for (const [id, { reach, group }] of model.entries) {
        expect([copy.reachOf(id), copy.groupOf(id)]).toEqual([reach ?? 0, group ?? 0]);
      }
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
      // In turns, so that every distance is recorded.
      const [id] = model.entries.keys();
      if (id !== undefined) model.setReach(id, distances[(call / 10) % distances.length]!);
      told.push(keysIn(model.space.update().pairs));
    }
    const trace = openTrace(recording.bytes());
    const copy = new BroadPhase({ dimensions });
    const reaches = new Set<number>();
    for (const frame of trace) {
      for (const reach of frame.reaches ?? []) reaches.add(reach);
      applyFrame(copy, frame);
      expect(keysIn(copy.update().pairs)).toEqual(told[frame.index]);
    }
    expect(reaches).toEqual(new Set(distances));
    for (const { difference } of replay(trace, {}, true)) expect(difference).toBeNull();
  });
});

describe('what is no id or no distance is refused and changes nothing', () => {
  const space = new BroadPhase().setAll([0, 0, 1, 1, 2, 0, 3, 1]);
  const loose = space as unknown as Loose;

  test.each([-1, 1.5, 2 ** 24, 3, '0', undefined])('the id %s', (id) => {
    expect(() => loose.setReach!(id, 1)).toThrow(/setReach: (the id is|there is no box)/);
    if (id !== 3) expect(() => loose.reachOf!(id)).toThrow('reachOf: the id is');
    expect(space.reachOf(3)).toBeUndefined();
    expect(space.update().pairCount).toBe(0);
  });

  test.each([-1, Number.NaN, Infinity, -Infinity, '1', null, undefined])('%s for a distance', (value) => {
    expect(() => loose.setReach!(0, value)).toThrow('setReach: distance: got');
    expect(space.reachOf(0)).toBe(0);
    expect(space.update().pairCount).toBe(0);
  });
});
