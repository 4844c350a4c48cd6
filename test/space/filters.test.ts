// Filters and static boxes: exactly the pairs that are wanted, whatever is done to the boxes and by whatever technique,
// and no search for those that nobody wants.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';
import { describeEach } from '../support/each-technique.ts';
import { expectKeys } from '../support/expect-pairs.ts';
import { type Entry, Modelled, meet, pairsOf } from '../support/model.ts';
import { readTrace, traceNames } from '../support/recordings.ts';
import { pairOf, referencePairs } from '../support/reference.ts';

const all = 0xffffffff;

/** That many boxes in one place. */
const stacked = (dimensions: 2 | 3, count: number) =>
  Float32Array.from({ length: 2 * dimensions * count }, (_, k) => (k % (2 * dimensions) < dimensions ? 0 : 1));

test('rules are set and read back while boxes wait to be flushed', () => {
  const space = new BroadPhase();
  const at = (id: number) => space.set(id, 0, 0, 1, 1);
  const rules = (id: number) => [space.filterOf(id), space.isStatic(id), space.isEnabled(id), space.groupOf(id)];
  const none = [{ layer: all, mask: all }, false, true, 0];
  for (const id of [0, 1, 2]) at(id);
  space.update();
  for (let frame = 0; frame < 3; frame++) {
    at(0).setFilter(0, 1, 2).setStatic(0).setEnabled(0, false).setGroup(0, 7).setReach(0, 0.5);
    expect(rules(0)).toEqual([{ layer: 1, mask: 2 }, true, false, 7]);
    expect(space.reachOf(0)).toBe(0.5);
    at(1).setFilter(1, all, all).setStatic(1, false).setEnabled(1, true).setGroup(1, 0).setReach(1, 0);
    expect(rules(1)).toEqual(none);
    expect(space.update().pairCount).toBe([1, 3, 1][frame]); // of boxes 1 and 2; of 1, 2 and 3; while 2 is off
    space.delete(0);
    expect(at(0).setGroup(0, 0).groupOf(0)).toBe(0); // a new box without rules
    expect(rules(0)).toEqual(none);
    at(3)
      .setEnabled(2, frame > 0)
      .setGroup(3, 5)
      .setGroup(1, 5); // box 3 is new and waits
    expect([space.groupOf(3), space.groupOf(1), space.isEnabled(2)]).toEqual([5, 5, frame > 0]);
    at(1).setGroup(1, 0).setGroup(1, 0);
    at(2)
      .setEnabled(2, true)
      .setEnabled(2, frame !== 1);
    expect(space.isEnabled(2)).toBe(frame !== 1);
  }
  expect(() => space.setFilter(9, 1, 1)).toThrow('setFilter: there is no box 9');
  expect(space.filterOf(9)).toBeUndefined();
});

describeEach('%s in %d dimensions', (technique, dimensions) => {
  test('finds the wanted pairs after any sequence of calls', () => {
    for (let seed = 1; seed <= 2; seed++) {
      const model = new Modelled({ technique, dimensions }, seed);
      for (let call = 1; call <= 800; call++) {
        model.step();
        if (call % 20) continue;
        expectKeys(model.space.update(), pairsOf(model.entries, dimensions));
        model.space.validate();
      }
    }
  });

  test('finds the right pairs with more kinds of filters than it has classes', () => {
    const model = new Modelled({ technique, dimensions }, 7);
    for (let id = 0; id < 400; id++) {
      model.set(id);
      model.filter(id, 1 << (id % 5), (id * 2654435761) >>> 0);
      model.setStatic(id, id % 3 === 0);
    }
    expectKeys(model.space.update(), pairsOf(model.entries, dimensions));
    expect(model.space.pairCount).toBeGreaterThan(100);
    for (let id = 0; id < 400; id++) model.filter(id, 1, 2);
    expect(model.space.update().pairCount).toBe(0);
    expect(model.space.stats.tests).toBe(0);
  });

  test('does not search among boxes that ignore one another', () => {
    const space = new BroadPhase({ technique, dimensions });
    space.setAll(stacked(dimensions, 1000));
    for (let id = 0; id < 1000; id++) space.setFilter(id, 1, 2);
    expect(space.update().stats).toMatchObject({ tests: 0, candidates: 0, pairs: 0 });
    for (let id = 0; id < 1000; id++) space.setFilter(id, all, all).setStatic(id);
    expect(space.update().stats).toMatchObject({ tests: 0, candidates: 0, pairs: 0 });
    for (let id = 0; id < 1000; id++) space.setFilter(id, 1 << (id % 8), 1 << 8);
    expect(space.update().stats).toMatchObject({ tests: 0, candidates: 0, pairs: 0 });
    // One that they all meet: no other pair is even a candidate.
    space.setFilter(999, 1 << 8, all).setStatic(999, false);
    expect(space.update().stats).toMatchObject({ candidates: 999, pairs: 999 });
    // Those among them that can meet nobody are left out of the search.
    for (let id = 10; id < 999; id++) space.setFilter(id, 1, 2);
    expect(space.update().pairCount).toBe(10);
    expect(space.stats.tests).toBeLessThanOrEqual((11 * 10) / 2);
  });

  test('two colours that only meet each other are never candidates among themselves', () => {
    const space = new BroadPhase({ technique, dimensions });
    space.setAll(stacked(dimensions, 60));
    for (let id = 0; id < 60; id++) space.setFilter(id, id % 2 ? 1 : 2, id % 2 ? 2 : 1);
    expect(space.update().stats).toMatchObject({ candidates: 900, pairs: 900 });
  });
});

test.each(traceNames)('the recorded %s in four teams, some of it static', (name) => {
  const recording = readTrace(name);
  const { dimensions, count } = recording;
  const boxes = recording.frame(1);
  const random = createRandom(5);
  const entries = Array.from({ length: count }, (): Entry => {
    const team = Math.floor(random() * 4);
    return { box: [], layer: 1 << team, mask: [15, 12, 3, 7][team], isStatic: random() < 0.3 };
  });
  const expected = referencePairs(boxes, dimensions).filter((key) => {
    const [a, b] = pairOf(key);
    return meet(entries[a], entries[b]);
  });
  for (const technique of BroadPhase.techniques) {
    if (technique === 'brute-force' && count > 5000) continue;
    const space = new BroadPhase({ technique, dimensions });
    space.boxes(count).set(boxes);
    entries.forEach(({ layer, mask, isStatic }, id) => {
      space.setFilter(id, layer, mask).setStatic(id, isStatic);
    });
    expectKeys(space.update(), expected);
  }
});

describe('a filter belongs to the id', () => {
  const pairs = (space: BroadPhase<2 | 3>) => Array.from(space.update().pairs);

  test('and stays whatever way the box moves', () => {
    const space = new BroadPhase()
      .setAll(stacked(2, 4))
      .setFilter(0, 1, 2)
      .setFilter(1, 1, 2)
      .setStatic(2)
      .setStatic(3);
    const wanted = [0, 2, 0, 3, 1, 2, 1, 3];
    const sorted = () => {
      const found = pairs(space);
      return Array.from({ length: found.length / 2 }, (_, k) => found.slice(2 * k, 2 * k + 2))
        .sort()
        .flat();
    };
    expect(sorted()).toEqual(wanted);
    space.set(0, 0, 0, 0.1, 1);
    expect(sorted()).toEqual(wanted);
    space.setAll([...stacked(2, 4)]);
    expect(sorted()).toEqual(wanted);
    space.boxes(4).set(stacked(2, 4));
    expect(sorted()).toEqual(wanted);
    space.boxes(3);
    expect(sorted()).toEqual([0, 2, 1, 2]);
  });

  test('and goes with it', () => {
    const space = new BroadPhase().setAll(stacked(2, 2)).setFilter(0, 1, 2).setFilter(1, 1, 2);
    expect(pairs(space)).toEqual([]);
    space.delete(0);
    space.set(0, 0, 0, 1, 1);
    expect(pairs(space)).toEqual([0, 1]);
    space.setStatic(0).setStatic(1);
    expect(pairs(space)).toEqual([]);
    space.clear();
    space.setAll(stacked(2, 2));
    expect(pairs(space)).toEqual([0, 1]);
  });

  test('and can be taken back', () => {
    const space = new BroadPhase().setAll(stacked(2, 2)).setFilter(0, 0, 0).setStatic(0).setStatic(1);
    expect(pairs(space)).toEqual([]);
    space.setFilter(0, all, all);
    expect(pairs(space)).toEqual([]);
    space.setStatic(1, false);
    expect(pairs(space)).toEqual([0, 1]);
  });
});

describe('bad filters are refused and change nothing', () => {
  const space = new BroadPhase().setAll(stacked(2, 3));
  const loose = space as unknown as Record<'setFilter' | 'setStatic', (...given: unknown[]) => unknown>;

  test.each([-1, 1.5, 2 ** 32, Number.NaN, Infinity, '1', null, undefined, true])('the layer or mask %s', (bits) => {
    const kind = typeof bits === 'number' ? RangeError : TypeError;
    expect(() => loose.setFilter(0, bits, 1)).toThrow(kind);
    expect(() => loose.setFilter(0, bits, 1)).toThrow(
      `setFilter: layer: got ${typeof bits === 'string' ? '"1"' : bits}`,
    );
    expect(() => loose.setFilter(0, 1, bits)).toThrow('setFilter: mask: got');
    expect(space.update().pairCount).toBe(3);
  });

  test.each([-1, 1.5, 2 ** 24, 3, '0', undefined])('the id %s', (id) => {
    expect(() => loose.setFilter(id, 0, 0)).toThrow(/setFilter: (the id is|there is no box)/);
    expect(() => loose.setStatic(id)).toThrow(/setStatic: (the id is|there is no box)/);
    expect(space.update().pairCount).toBe(3);
  });

  test.each([1, 'yes', null])('%s for static', (value) => {
    expect(() => loose.setStatic(0, value)).toThrow('setStatic: isStatic: got');
  });
});
