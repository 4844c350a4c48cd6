// The benchmark's own parts that a wrong figure could hide in: the fingerprint of a set of pairs, the clock, the statistics,
// what is compared, and the documents that are made of it.
import { readFileSync } from 'node:fs';
import { describe, expect, test } from 'vitest';
import { clocked } from '../../bench/harness/clock.mjs';
import { fingerprint, fingerprintOfBoxes } from '../../bench/harness/fingerprint.mjs';
import { judge } from '../../bench/harness/judge.mjs';
import { leastOfEach, median, quantile, spread } from '../../bench/harness/statistics.mjs';
import { change, compare } from '../../bench/report/compare.mjs';
import { figuresPage, headlineOf, putFigures, worthOf } from '../../bench/report/documents.mjs';
import { goals } from '../../bench/report/goals.mjs';
import { autoAgainstBest } from '../../bench/report/rows.mjs';
import { adviceOf } from '../../bench/report/worth.mjs';

const record = JSON.parse(readFileSync(new URL('./bench-results.json', import.meta.url), 'utf8'));

test('a fingerprint depends on the pairs, not on their order', () => {
  const pairs = [0, 1, 5, 9, 2, 2 ** 24 - 1, 7, 3];
  expect(fingerprint([3, 7, 1, 0, 2 ** 24 - 1, 2, 9, 5])).toBe(fingerprint(pairs));
  for (const other of [
    [0, 1, 5, 9, 2, 2 ** 24 - 1, 7, 4],
    [0, 1, 5, 9, 2, 2 ** 24 - 1],
    [...pairs, 0, 1],
    [0, 9, 5, 1, 2, 2 ** 24 - 1, 7, 3],
  ]) {
    expect(fingerprint(other)).not.toBe(fingerprint(pairs));
  }
  expect(fingerprint([0, 1, 0, 1])).not.toBe(fingerprint([5, 9, 5, 9]));
});

test('a fingerprint of boxes depends on each number and its place', () => {
  const boxes = [0, 1, 2, 3, 4, 5, 6, 7];
  expect(fingerprintOfBoxes(new Float32Array(boxes))).toBe(fingerprintOfBoxes(new Float64Array(boxes)));
  expect(fingerprintOfBoxes([1, 0, 2, 3, 4, 5, 6, 7])).not.toBe(fingerprintOfBoxes(boxes));
  expect(fingerprintOfBoxes([0, 1, 2, 3, 4, 5, 6, 7.001])).not.toBe(fingerprintOfBoxes(boxes));
});

test('time in which the process slept is not time at work', () => {
  const asleep = new Int32Array(new SharedArrayBuffer(4));
  expect(clocked(() => Atomics.wait(asleep, 0, 0, 80))).toBeLessThan(40);
});

describe('statistics', () => {
  test('the headline is the median frame, the rest is over all frames', () => {
    expect(spread([1, 3, 10, 30, 2])).toEqual({ median: 3, mean: 9.2, p95: 30, worst: 30, range: [1, 30] });
    expect(median([4, 1, 3, 2])).toBe(2.5);
    expect(quantile([1, 2, 3, 4], 0.5)).toBe(3);
  });

  test('of a frame that was played several times the least counts', () => {
    expect(
      leastOfEach([
        [1, 9, 3],
        [2, 4, 3],
      ]),
    ).toEqual([1, 4, 3]);
  });

  test('a change is beyond the noise when the frames of one lie apart from those of the other, and it is worth a mark', () => {
    const figures = (low: number, middle: number, high: number) => ({ median: middle, range: [low, high] });
    expect(change(figures(9, 10, 11), figures(18, 20, 22))).toEqual({ ratio: 2, beyondNoise: true });
    expect(change(figures(9, 10, 11), figures(4, 5, 6))).toEqual({ ratio: 0.5, beyondNoise: true });
    expect(change(figures(9, 10, 19), figures(18, 20, 22)).beyondNoise).toBe(false);
    expect(change(figures(10, 10, 10), figures(10.2, 10.2, 10.2)).beyondNoise).toBe(false);
  });
});

describe('a race is judged', () => {
  const plan = { warmUp: 2, timed: 2 };
  const notes = (update: number[], found = ['a', 'b'], seen = ['x', 'y']) => ({
    frames: [2, 3],
    give: [1, 1],
    update,
    walk: [0, 0],
    pairs: [7, 9],
    found,
    seen,
    start: [5, 5],
    kept: 1,
    bytes: 80,
  });
  const entrant = (name: string, ...playings: ReturnType<typeof notes>[]) => ({
    name,
    peer: name,
    stride: 1,
    count: 4,
    notes: playings,
  });

  test('by the least of each frame; pairs are those of the timed frames', () => {
    const { pairs, contenders } = judge({ plan }, [
      entrant('a', notes([2, 6]), notes([4, 4])),
      entrant('b', notes([8, 8])),
    ]);
    expect(pairs).toEqual({ mean: 8, least: 7, most: 9 });
    expect(contenders[0]).toMatchObject({ timed: 2, update: { median: 3 }, total: { median: 4, worst: 5 }, kept: 0.5 });
    expect(contenders[1]).toMatchObject({ total: { median: 9 }, share: 3 });
    expect(contenders[0].share).toBe(1);
  });

  test('against the first contender in the same frames, so that a machine slow for a while slows both', () => {
    const first = { ...notes([1, 1, 9, 9, 9]), frames: [2, 3, 4, 5, 6] };
    const other = { ...notes([9, 9]), frames: [4, 6], found: first.found, seen: first.seen };
    for (const each of [first, other]) Object.assign(each, { found: Array(5).fill('a'), seen: Array(5).fill('x') });
    const { contenders } = judge({ plan }, [entrant('a', first), { ...entrant('b', other), stride: 2 }]);
    expect(contenders[1]).toMatchObject({ timed: 2, share: 1 });
  });

  test('who saw other boxes has no figures, who found other pairs is wrong, who failed says why', () => {
    const { contenders } = judge({ plan }, [
      entrant('a', notes([2, 6])),
      entrant('b', notes([1, 1], ['a', 'b'], ['x', 'z'])),
      entrant('c', notes([1, 1], ['c', 'b'])),
      { name: 'd', peer: 'd', error: 'it fell' },
      { name: 'e', peer: 'e', slow: 900 },
    ]);
    expect(contenders.slice(1)).toEqual([
      { name: 'b', peer: 'b', error: 'saw other boxes in frame 3' },
      expect.objectContaining({ name: 'c', wrong: { frame: 2, pairs: 7, exact: 7 } }),
      { name: 'd', peer: 'd', error: 'it fell' },
      { name: 'e', peer: 'e', slow: 900 },
    ]);
  });
});

test('auto is held against the best of our fixed techniques, with 10 % and 0.02 ms to spare', () => {
  const row = (auto: number) => ({
    contenders: Object.entries({ a: 2, b: 1, auto, peer: 0.1 }).map(([name, ms]) => ({
      name,
      peer: name === 'peer' ? name : 'broadphase',
      total: { median: ms },
      update: { median: ms },
      share: ms / auto,
    })),
  });
  expect(autoAgainstBest(row(1.5))).toEqual({ best: 'b', ratio: expect.closeTo(1.5, 9), within: false });
  expect(autoAgainstBest(row(1.11))).toMatchObject({ best: 'b', within: true });
  expect(autoAgainstBest(row(0.9))).toMatchObject({ best: 'b', within: true });
  expect(autoAgainstBest({ contenders: [{ name: 'auto', peer: 'broadphase' }] })).toBeUndefined();
});

describe('documents', () => {
  const of = (goal: string, from = record) => goals(from).find((each) => each.goal.startsWith(goal))!;

  test('each goal has its figure, or none where nothing was measured', () => {
    expect(of('1,000 things')).toMatchObject({ figure: '0.0300 ms', met: true });
    expect(of('100,000 boxes: 40 times')).toMatchObject({
      figure: '0 of 2; the worst: 30.00x (uniform2d 2D, 100,000, boxes)',
      met: false,
    });
    expect(of('motions for validation')).toMatchObject({
      figure: '1 of 2; the worst: 0.90x (flock 2D, 10,000, set)',
      met: false,
    });
    expect(of('100,000 boxes: 4 times')).toMatchObject({
      figure: '0 of 1; the worst: 3.60x (uniform2d 2D, 100,000)',
      met: false,
    });
    expect(of('1,000,000 moving')).toEqual({ goal: '1,000,000 moving boxes, 2D: 16.6 ms', figure: '' });
    expect(of('in Node')).toMatchObject({ figure: '8.00 ms', met: false });
    // One that is wrong is no rival, however fast.
    const wrong = structuredClone(record);
    for (const { contenders } of wrong.rows)
      for (const each of contenders) if (each.peer === 'flatbush') each.wrong = { frame: 1 };
    expect(of('100,000 boxes: 40 times', wrong)).toMatchObject({
      figure: '2 of 2; the worst: 45.00x (uniform2d 2D, 100,000, boxes)',
    });
  });

  test('the page of figures has a part for each kind that there are rows of', () => {
    const page = figuresPage(record);
    expect(page.split('\n').filter((line) => line.startsWith('#'))).toEqual([
      '# Figures',
      '## Goals',
      '## A whole frame, from objects',
      '## Motions',
      '## Few movers',
      '## One-shot',
      '## Cold',
      '## Scenes',
      '### Techniques',
      '## Queries',
      '## Native libraries, side by side',
    ]);
    expect(page).toContain('of commit abc1234');
    expect(page).toContain('| 1,000 | all move | 0.0300 | 0.0200 | 2.00 | 0.150 | 0.200 | 0.500 flatbush | 500 |');
    expect(page).toContain('| rapier2d | 20.00x WRONG | 20.00x WRONG |');
    const without = figuresPage({
      ...record,
      rows: record.rows.filter(({ kind }: { kind: string }) => kind !== 'cold'),
    });
    expect(without).not.toContain('## Cold');
  });

  test('README.md has its table between two marks, and so has the guide', () => {
    const read = (file: string) => readFileSync(new URL(`../../${file}`, import.meta.url), 'utf8');
    const readme = read('README.md');
    const put = putFigures(readme, headlineOf(record));
    const worth = '| 1,000 | sort and sweep | 2.00 | 0.150 | 0.200 | 0.500 flatbush | 0.0300 | 0.0200 |';
    expect(put).toContain(worth);
    const guide = putFigures(read('docs/guides/worth-it.md'), worthOf(record));
    expect(guide).toContain(worth);
    expect(guide).toContain('| rapier2d | 20.00x WRONG | 20.00x WRONG |');
    expect(put).toContain('| uniform2d | 100,000 | 50,000 | 1.00 | 30.0 flatbush | 30.00x |');
    expect(putFigures(put, headlineOf(record))).toBe(put);
    expect(put.slice(0, 500)).toBe(readme.slice(0, 500));
    expect(() => putFigures('# no marks', '')).toThrow('no marks');
  });

  test('less than a hundredth of a frame is enough, with the least that is to be written', () => {
    const row = (...medians: number[]) => ({
      contenders: ['brute force', 'sort and sweep', 'grid in a Map', 'set'].map((name, k) => ({
        name,
        total: { median: medians[k] },
      })),
    });
    expect(adviceOf(row(0.1, 0.01, 0.01, 0.01))).toBe('fifteen lines');
    expect(adviceOf(row(0.2, 0.1, 0.01, 0.01))).toBe('sort and sweep');
    expect(adviceOf(row(0.2, 0.2, 0.1, 0.01))).toBe('grid in a Map');
    expect(adviceOf(row(2, 2, 2, 1))).toBe('`broadphase`');
  });

  test('two records are compared by what changed beyond the noise, the worst first', () => {
    expect(compare(record, record)).toMatch(/^abc1234 .* are the same to within the noise, 0 are not\.$/);
    const slower = structuredClone(record);
    for (const { kind, contenders } of slower.rows) {
      if (kind !== 'movers') continue;
      for (const { name, total } of contenders) {
        if (name !== 'auto') continue;
        total.median *= 3;
        total.range = total.range.map((ms: number) => 3 * ms);
      }
    }
    expect(
      compare(record, { ...slower, commit: 'def' })
        .split('\n')
        .at(-1),
    ).toBe('| movers: 10 jitter 2D, movers | 10,000 | auto | 0.00400 | 0.0120 | 3.00x |');
  });
});
