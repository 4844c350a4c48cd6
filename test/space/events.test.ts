// Events and lookups: what began and ended between two updates, and who is in a pair with whom, against plain sets.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { createScene } from '../../src/scenes/index.ts';
import { createRandom } from '../../src/scenes/random.ts';
import { describeEach } from '../support/each-technique.ts';
import { expectSameWords, firstDifference } from '../support/expect-pairs.ts';
import { Modelled } from '../support/model.ts';
import { readTrace, traceNames } from '../support/recordings.ts';
import { keysOf, pairOf } from '../support/reference.ts';
import { setBox } from '../support/set-box.ts';

/** Compares the events of the last update with what the sets before and after say. */
function expectEvents(
  space: BroadPhase<2 | 3>,
  before: Float64Array,
  deleted: ReadonlySet<number> = new Set(),
): Float64Array {
  const now = keysOf(space.pairs);
  const stood = (key: number) => !pairOf(key).some((id) => deleted.has(id));
  const stayed = new Set(before.filter(stood));
  const found = new Set(now);
  const began = now.filter((key) => !stayed.has(key));
  const ended = before.filter((key) => !(stayed.has(key) && found.has(key)));
  for (const [events, expected] of [
    [space.began, began],
    [space.ended, ended],
  ] as const) {
    expect(events.every((id, k) => k % 2 === 1 || id < events[k + 1])).toBe(true);
    const difference = firstDifference(keysOf(events), expected);
    if (difference) expect.fail(`${events === space.began ? 'began' : 'ended'}: ${difference}`);
  }
  return now;
}

describeEach('%s in %d dimensions', (technique, dimensions) => {
  test.each(['uniform', 'dense'] as const)('follows the scene %s', (kind) => {
    const scene = createScene(`${kind}${dimensions}d`, 500);
    const space = new BroadPhase({ technique, dimensions, events: true });
    let before: Float64Array = new Float64Array();
    for (let frame = 0; frame < 5; frame++) {
      scene.step();
      space.boxes(500).set(scene.boxes);
      before = expectEvents(space.update(), before);
      expect(space.began.length).toBeGreaterThan(0);
    }
    expectEvents(space.boxes(0) && space.update(), before);
    expect(space.ended.length).toBe(2 * before.length);
    expectEvents(space.update(), new Float64Array());
  });
});

// A crowd whose pairs are elsewhere in the list after each update: `auto` sorts the lists from then on, others do not.
describe.each([
  ['auto', 2],
  ['auto', 3],
  ['strip-sweep', 2],
  ['spatial-grid', 3],
] as const)('%s in a dense crowd in %d dimensions', { tags: 'long' }, (technique, dimensions) => {
  test('follows it, also once it is restored', () => {
    const random = createRandom(dimensions);
    const side = dimensions === 2 ? 60 : 30;
    const places = Array.from({ length: 400 * dimensions }, () => random() * side);
    const options = { technique, dimensions, events: true };
    let space = new BroadPhase<2 | 3>(options);
    let twin: BroadPhase<2 | 3> | undefined;
    let before: Float64Array = new Float64Array();
    for (let frame = 0; frame < 60; frame++) {
      for (let k = 0; k < places.length; k++) places[k] = Math.min(side, Math.max(0, places[k]! + 3 * random() - 1.5));
      if (frame === 20) space.delete(7);
      if (frame === 30) twin = new BroadPhase<2 | 3>(options).restore(space.snapshot());
      if (frame === 45) space = new BroadPhase<2 | 3>(options).restore(space.snapshot());
      const boxes = (id: number) => places.slice(id * dimensions, (id + 1) * dimensions);
      for (const each of twin ? [space, twin] : [space]) {
        for (let id = 0; id < 400; id++) {
          if (id !== 7 || frame < 20) setBox(each, id, [...boxes(id), ...boxes(id).map((at) => at + 8)]);
        }
        each.update();
      }
      before = expectEvents(space, before, new Set(frame === 20 ? [7] : []));
      for (const list of twin ? (['pairs', 'began', 'ended'] as const) : [])
        expect(twin![list], `${list} of frame ${frame}`).toEqual(space[list]);
    }
    expect(before.length).toBeGreaterThan(2000);
  });
});

// Among the model's calls are those that switch to any technique.
describe.each([2, 3] as const)('in %d dimensions', (dimensions) => {
  test('tells what began and ended after any sequence of calls', () => {
    for (let seed = 1; seed <= 12; seed++) {
      const model = new Modelled({ dimensions, events: true }, seed);
      const twin = new Modelled({ dimensions, events: true }, seed);
      let before: Float64Array = new Float64Array();
      for (let call = 1; call <= 800; call++) {
        model.step();
        twin.step();
        if (call % 7) continue;
        before = expectEvents(model.space.update(), before, model.deleted);
        model.deleted.clear();
        twin.space.update();
        expectSameWords(twin.space.began, model.space.began, 'began');
        expectSameWords(twin.space.ended, model.space.ended, 'ended');
      }
    }
  });

  test('looks up the pairs of the last update', () => {
    for (const events of [false, true]) {
      const model = new Modelled({ dimensions, events }, 3);
      const { space } = model;
      const out: number[] = [];
      for (let call = 1; call <= 1500; call++) {
        model.step();
        if (call % 50) continue;
        space.update();
        const pairs = Array.from(space.pairs);
        // What is changed now is not seen before the next update.
        for (let k = 0; k < 5; k++) model.step();
        const known = new Map<number, number[]>();
        for (let k = 0; k < pairs.length; k++) {
          known.set(pairs[k], [...(known.get(pairs[k]) ?? []), pairs[k ^ 1]]);
        }
        for (const id of [...Array.from({ length: 90 }, (_, k) => k), ...known.keys()]) {
          const expected = known.get(id) ?? [];
          expect(space.collisionsOf(id)).toEqual(expected);
          expect(space.collisionsOf(id, out)).toBe(out);
          expect(out).toEqual(expected);
          const wrong = [0, 1, 2, 40, 79, ...expected].filter(
            (other) =>
              space.isColliding(id, other) !== expected.includes(other) ||
              space.isColliding(other, id) !== expected.includes(other),
          );
          expect(wrong).toEqual([]);
        }
      }
    }
  });
});

test.each(traceNames)('follows the recorded %s', (name) => {
  const recording = readTrace(name);
  const { dimensions, count } = recording;
  const space = new BroadPhase({ dimensions, events: true });
  let before: Float64Array = new Float64Array();
  for (let k = 0; k < Math.min(recording.frames, 8); k++) {
    space.boxes(count).set(recording.frame(k));
    before = expectEvents(space.update(), before);
  }
  for (let id = 0; id < count; id += 997) {
    const partners = space.collisionsOf(id);
    expect(partners.every((other) => space.isColliding(id, other))).toBe(true);
    expect(partners.toSorted()).toEqual(
      Array.from(before, pairOf)
        .filter((pair) => pair.includes(id))
        .map(([a, b]) => (a === id ? b : a))
        .toSorted(),
    );
  }
});

describe('a box that is deleted', () => {
  const events = (space: BroadPhase<2 | 3>) => [Array.from(space.update().began), Array.from(space.ended)];
  const three = () => new BroadPhase({ events: true }).setAll([0, 0, 2, 2, 1, 1, 3, 3, 1, 1, 3, 3]);

  test('ends its pairs', () => {
    const space = three();
    expect(events(space)).toEqual([Array.from(space.pairs), []]);
    expect(space.pairCount).toBe(3);
    space.delete(0);
    space.delete(2);
    const [began, ended] = events(space);
    expect([began, ended.length]).toEqual([[], 6]);
    expect(events(space)).toEqual([[], []]);
  });

  test('and set again under the same id is another box', () => {
    const space = three().update();
    space.delete(0);
    space.set(0, 0, 0, 2, 2);
    const [began, ended] = events(space);
    expect(keysOf(began)).toEqual(keysOf([0, 1, 0, 2]));
    expect(keysOf(ended)).toEqual(keysOf([0, 1, 0, 2]));
    expect(events(space)).toEqual([[], []]);
  });

  test('by setAll, boxes or clear counts as deleted', () => {
    for (const remove of [
      (space: BroadPhase<2 | 3>) => space.setAll([]),
      (space: BroadPhase<2 | 3>) => space.boxes(0),
    ]) {
      const space = three().update();
      remove(space);
      space.setAll([0, 0, 2, 2, 1, 1, 3, 3]);
      const [began, ended] = events(space);
      expect(began).toEqual([0, 1]);
      expect(ended.length).toBe(6);
    }
    const space = three().update();
    space.clear();
    expect(events(space)[1].length).toBe(6);
  });
});

test('bad boxes refused by update leave the events as they were', () => {
  const space = new BroadPhase({ events: true });
  space.boxes(2).set([0, 0, 2, 2, 1, 1, 3, 3]);
  space.update();
  space.boxes(2)[0] = Number.NaN;
  expect(() => space.update()).toThrow('NaN');
  expect(Array.from(space.began)).toEqual([0, 1]);
  space.boxes(2)[0] = 0;
  expect(Array.from(space.update().began)).toEqual([]);
});

test('bad options, ids and arrays are refused', () => {
  const space = new BroadPhase().set(0, 0, 0, 1, 1).update();
  expect(() => space.began).toThrow('events: true');
  expect(() => space.ended).toThrow('events: true');
  expect(() => new BroadPhase({ events: 1 as unknown as boolean })).toThrow('events: got 1');
  for (const id of [-1, 1.5, 2 ** 24, Number.NaN]) {
    expect(() => space.isColliding(id, 0)).toThrow(/isColliding: [ab]: the id is/);
    expect(() => space.isColliding(0, id)).toThrow(/isColliding: [ab]: the id is/);
    expect(() => space.collisionsOf(id)).toThrow('collisionsOf: the id is');
  }
  expect(() => space.collisionsOf(0, new Uint32Array(2) as unknown as number[])).toThrow('collisionsOf: out');
  expect(space.isColliding(0, 0)).toBe(false);
  expect(space.collisionsOf(7)).toEqual([]);
});

test('lookups before the first update find nothing', () => {
  const space = new BroadPhase().set(0, 0, 0, 1, 1).set(1, 0, 0, 1, 1);
  expect(space.isColliding(0, 1)).toBe(false);
  expect(space.collisionsOf(0)).toEqual([]);
});
