// A recording of a world that wraps around said 0 pairs, its replay was "exact", and `tune` recommended options that
// had forgotten it.
import { mkdtempSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { BroadPhase } from 'broadphase';
import { compare, exactPairs, openTrace, readTrace, record, replay, survey, tune } from 'broadphase/trace';
import { expect, test } from 'vitest';
import { main } from '../../src/cli/main.ts';
import { createRandom } from '../../src/scenes/random.ts';
import { pairKeys } from '../../src/trace/exact.ts';
import { wrappedPairs } from '../support/wrapped-reference.ts';

function recorded(dimensions: 2 | 3, wrap: number[] | undefined, boxes = 60) {
  const space = new BroadPhase(wrap ? { dimensions, wrap } : { dimensions });
  const recording = record(space);
  const random = createRandom(4);
  const pairs: Float64Array[] = [];
  for (let frame = 0; frame < 4; frame++) {
    const all = Array.from({ length: boxes }, () => {
      const low = Array.from({ length: dimensions }, () => Math.floor(40 * random()) - 10 + (random() < 0.2 ? 0.1 : 0));
      return [...low, ...low.map((x) => x + Math.floor(4 * random()))];
    });
    if (frame === 2) all[0][dimensions] = Infinity;
    space.setAll(all.flat());
    space.setStatic(0).setStatic(1).setFilter(2, 2, 1);
    pairs.push(pairKeys(space.update().pairs));
  }
  return { bytes: recording.bytes(), pairs };
}

test('two boxes that meet over the border are a pair of the recording', async () => {
  const space = new BroadPhase({ wrap: [100, 50] });
  const recording = record(space);
  space.set(0, 98, 10, 103, 20).set(1, 1, 10, 5, 20).update();
  const trace = openTrace(recording.bytes());
  expect(trace.wrap).toEqual([100, 50]);
  const { pairs, wrap } = survey(trace);
  expect(pairs.max).toBe(1);
  expect(wrap).toEqual([100, 50]);
  const [played] = replay(trace, {}, true);
  expect(played).toMatchObject({ pairs: 1, difference: null });
  const [missed] = replay({ dimensions: 2, frames: 1, [Symbol.iterator]: () => trace[Symbol.iterator]() }, {}, true);
  expect(missed.pairs).toBe(0);
  for await (const frame of readTrace(new Blob([recording.bytes()]).stream())) expect(frame.wrap).toEqual([100, 50]);
});

test.each([
  [2, [32, 20]],
  [3, [32, 20, 7.3]],
] as const)('in %d dimensions a replay is checked against an answer that knows of it', (dimensions, wrap) => {
  const { bytes, pairs } = recorded(dimensions, [...wrap]);
  const trace = openTrace(bytes);
  let frame = 0;
  for (const { boxes, ids, rules } of trace) {
    expect(exactPairs(boxes, dimensions, ids, rules, wrap)).toEqual(pairs[frame++]);
  }
  expect(pairs[0].length).toBeGreaterThan(10);
  expect([...replay(trace, { technique: 'strip-sweep' }, true)].map(({ difference }) => difference)).toEqual([
    null,
    null,
    null,
    null,
  ]);
  for (const { disagrees } of compare(trace, { techniques: ['brute-force', 'strip-sweep'], passes: 1 })) {
    expect(disagrees).toBeNull();
  }
  const { code, frames } = tune(trace, { techniques: ['brute-force'], seconds: 0.1 });
  expect(code).toContain(`wrap: [${wrap.join(', ')}]`);
  expect(frames.at(-1)?.pairs).toBe(pairs[3].length);
});

test('it is not forgotten for options that are undefined', () => {
  const space = new BroadPhase({ wrap: [100, 50], touching: false });
  const recording = record(space);
  space.set(0, 98, 10, 103, 20).set(1, 1, 10, 5, 20).set(2, 5, 10, 9, 20).set(3, 9, 10, 12, 20).update();
  const trace = openTrace(recording.bytes());
  const left = { wrap: undefined, touching: undefined };
  expect(replay(trace, left, true).next().value).toMatchObject({ pairs: 1, difference: null });
  expect(replay(trace, { wrap: [1000, 50], touching: true }, true).next().value).toMatchObject({ pairs: 2 });
  const [{ tests }] = compare(trace, { techniques: ['brute-force'], passes: 1 });
  expect(compare(trace, { ...left, techniques: ['brute-force'], passes: 1 })[0].tests).toBe(tests);
});

test('the command converts, cuts and describes it', async () => {
  const folder = mkdtempSync(join(tmpdir(), 'wrap-'));
  const [from, to] = [join(folder, 'a.trace'), join(folder, 'b.trace')];
  writeFileSync(from, recorded(2, [32, 20]).bytes);
  let said = '';
  const out = (text: string) => {
    said += text;
  };
  const terminal = { out, err: out, interactive: false, columns: 80, tableColumns: 80, colour: false };
  expect(await main(['convert', from, to, '--frames', '1..2'], terminal)).toBe(0);
  expect(await main(['info', to], terminal)).toBe(0);
  expect(said).toContain('in a world of 32 × 20 that wraps around');
});

test('the kind of world is recorded, and readers refuse unknown kinds', () => {
  expect(recorded(2, undefined).bytes[11]).toBe(0);
  expect(recorded(2, [32, 20]).bytes[11]).toBe(1); // they expect a 0 there
  expect(openTrace(recorded(2, undefined).bytes).wrap).toBeUndefined();
});

test('only an infinite box covers the world: boxes whose distance overflows are compared exactly', () => {
  const far = [-1e308, 0, -1e308, 1, 1e308, 0, 1e308, 1];
  expect(exactPairs(far, 2, undefined, undefined, [50, 50])).toEqual(new Float64Array());
  expect(exactPairs([-Infinity, 0, 0, 1, 1e308, 0, 1e308, 1], 2, undefined, undefined, [50, 50])).toEqual(
    Float64Array.of(1),
  );
  const places = [-Number.MAX_VALUE, -1e308, -7e307, -3, 0, 1e-320, 2.5, 9e307, 1e308, Number.MAX_VALUE];
  for (const wrap of [
    [50, 50],
    [1e-310, 3],
    [1e300, 7e-5],
  ]) {
    for (const touching of [true, false]) {
      const boxes = places.flatMap((x, k) => places.slice(k).map((end) => [x, 0, end, 1]));
      const expected = wrappedPairs(new Map(boxes.entries()), wrap, touching);
      expect(exactPairs(boxes.flat(), 2, undefined, undefined, wrap, { touching })).toEqual(expected);
    }
  }
});
