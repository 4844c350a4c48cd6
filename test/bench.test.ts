// The benchmark's own parts that a wrong figure could hide in: the fingerprint of a set of pairs, the statistics, what is
// played where little changes, and the page that is made of it.
import { readFileSync } from 'node:fs';
import { BroadPhase } from 'broadphase';
import { describe, expect, test, vi } from 'vitest';
import { loadCases } from '../bench/cases.mjs';
import { clocked } from '../bench/clock.mjs';
import { judge, phases, type Row, rows } from '../bench/coherence.mjs';
import { coherenceGoals } from '../bench/coherence-table.mjs';
import { duellists, verdict } from '../bench/duel.mjs';
import { fingerprint } from '../bench/harness/fingerprint.mjs';
import { figures } from '../bench/markdown.mjs';
import { type Play, preparePlay } from '../bench/plays.mjs';
import { against, change, guessTime, leastOfEach, spread, summary } from '../bench/statistics.mjs';
import { autoAgainstBest } from '../bench/techniques.mjs';

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

test('the headline is the median of the rounds, the rest is over all frames', () => {
  expect(
    summary([
      [1, 3],
      [10, 30],
      [2, 2],
    ]),
  ).toEqual({ median: 2, mean: 8, p95: 30, worst: 30, range: [2, 20], frames: 6 });
  expect(summary([[1], [3]]).median).toBe(2);
});

test('what more boxes will take: by how it grew before, at least as they do and at most as their square', () => {
  const points = (...ms: (number | undefined)[]) => ms.map((each, k) => ({ count: 1000 * 10 ** k, ms: each }));
  expect(guessTime(points(1, 50), 1e5)).toBeCloseTo(2500);
  expect(guessTime(points(1, 500), 1e5)).toBeCloseTo(50_000);
  expect(guessTime(points(1, 2), 1e5)).toBeCloseTo(20);
  expect(guessTime(points(3), 10_000)).toBeCloseTo(30);
  expect(guessTime(points(1, undefined), 1e5)).toBeUndefined();
  expect(guessTime([], 1e5)).toBeUndefined();
  expect(
    guessTime(
      [
        { count: 100, ms: 1 },
        { count: 1000, ms: 50 },
      ],
      10_000,
    ),
  ).toBeCloseTo(500);
});

test('a change is beyond the noise when no round of one lies among those of the other, and it is worth a mark', () => {
  const figures = (low: number, median: number, high: number) => ({ median, range: [low, high] as [number, number] });
  expect(change(figures(9, 10, 11), figures(18, 20, 22))).toEqual({ ratio: 2, beyondNoise: true });
  expect(change(figures(9, 10, 11), figures(4, 5, 6))).toEqual({ ratio: 0.5, beyondNoise: true });
  expect(change(figures(9, 10, 19), figures(18, 20, 22)).beyondNoise).toBe(false);
  expect(change(figures(10, 10, 10), figures(10.2, 10.2, 10.2)).beyondNoise).toBe(false);
});

test('auto is held against the best of our fixed techniques, with 10 % and 0.02 ms to spare', () => {
  const results = (auto: number) =>
    Object.entries({ a: 2, b: 1, auto, peer: 0.1 }).map(([name, median]) => ({
      name,
      peer: name === 'peer' ? name : 'broadphase',
      figures: { median },
    }));
  expect(autoAgainstBest({ results: results(1.5) })).toEqual({ best: 'b', slower: 0.5, within: false });
  expect(autoAgainstBest({ results: results(1.11) })).toMatchObject({ best: 'b', within: true });
  expect(autoAgainstBest({ results: results(0.9) })).toMatchObject({ best: 'b', within: true });
  expect(autoAgainstBest({ results: [{ name: 'auto', peer: 'broadphase' }] })).toBeUndefined();
});

test('who came near auto, or was ahead, meets it again: the fastest four', () => {
  const of = (times: Record<string, number>, peer = 'broadphase') =>
    Object.entries(times).map(([name, atWork]) => ({ name, peer, atWork, figures: { median: 9 } }));
  const met = (times: Record<string, number>) =>
    duellists([...of(times), ...of({ peer: 0.1 }, 'peer')]).map(({ name }) => name);
  expect(met({ a: 3, auto: 1, b: 1.3, c: 0.2 })).toEqual(['auto', 'c', 'b']);
  expect(met({ a: 1, e: 1.1, auto: 1, b: 1.3, c: 0.2, d: 0.9 })).toEqual(['auto', 'c', 'd', 'a', 'e']);
  expect(met({ a: 2.1, auto: 1 })).toEqual([]);
  expect(met({ a: 1 })).toEqual([]);
});

test('time in which the process slept is not time at work', () => {
  const asleep = new Int32Array(new SharedArrayBuffer(4));
  const { wall, atWork } = clocked(() => Atomics.wait(asleep, 0, 0, 80));
  expect(wall).toBeGreaterThan(75);
  expect(atWork).toBeLessThan(40);
});

test('when they meet again, the ratio in a round counts, so a slow minute of the machine does not', () => {
  const auto = [1, 10, 1, 1];
  const found = verdict(['auto', 'a', 'b'], [auto, [2, 20, 2, 2], auto.map((time) => time / 1.5)]);
  expect(found).toEqual({
    ms: 1,
    rounds: 4,
    against: [
      { name: 'a', ms: 2, ratio: 0.5 },
      { name: 'b', ms: 2 / 3, ratio: 1.5 },
    ],
  });
  const results = ['a', 'auto'].map((name) => ({ name, peer: 'broadphase', figures: { median: 1 } }));
  expect(autoAgainstBest({ duel: found, results })).toEqual({ best: 'b', slower: 0.5, within: false });
  const even = verdict(['auto', 'a'], [auto, auto]);
  expect(autoAgainstBest({ duel: even, results })).toEqual({ best: 'a', slower: 0, within: true });
});

test('of a frame that was played several times the least counts, and a worst frame is held against the same of the other', () => {
  const times = leastOfEach([
    [1, 9, 3],
    [2, 4, 3],
  ]);
  expect(times).toEqual([1, 4, 3]);
  expect(spread(times)).toEqual({ mean: 8 / 3, p95: 4, worst: 4 });
  expect(against(times, [2, 2, 4], 100)).toEqual({ ratio: 1, worstRatio: 2, worstFrame: 1 });
  expect(against([0.001, 0.01], [0.00001, 0.01], 100)).toMatchObject({ worstRatio: 0.5 }); // far less than a frame
  expect(against([0.3, 2], [0.06, 2], 100_000)).toMatchObject({ worstRatio: 1 }); // nothing was found anew
});

describe('what is played where little changes', () => {
  const all = rows(loadCases());

  const some = all.filter(
    ({ name, recording }, k) => all.findIndex((row) => row.name === name) === k && (!recording || name === 'tumbler'),
  );
  const frames = 110;

  /** How the rows are played here: with as few boxes as show what they do. */
  const prepare = (row: Row) => preparePlay(row.count ? { ...row, count: 606 } : row, 5, frames);
  const open = (openPlay: () => Play, technique: 'strip-sweep' | 'auto') => {
    const play = openPlay();
    const space = new BroadPhase({ dimensions: play.dimensions, technique });
    play.start(space);
    return { play, space };
  };
  const next = ({ play, space }: { play: Play; space: BroadPhase }, frame: number) => {
    play.move(space, frame);
    play.ask(space, frame);
    space.update();
  };
  const boxesOf = ({ play, space }: { play: Play; space: BroadPhase }) =>
    Array.from({ length: play.count }, (_, id) => [...space.get(id)!]).flat();

  test.each(some.map((row) => [row.name, row] as const))('%s: each time the same, and the right pairs', (_, row) => {
    const openPlay = prepare(row);
    const one = open(openPlay, 'strip-sweep');
    const other = open(openPlay, 'auto');
    const first = boxesOf(one);
    let [moved, most] = [false, 0];
    for (let frame = 0; frame < frames; frame++) {
      next(one, frame);
      next(other, frame);
      const boxes = boxesOf(one);
      expect(boxesOf(other)).toEqual(boxes);
      expect(fingerprint(other.space.pairs)).toBe(fingerprint(one.space.pairs));
      moved ||= boxes.some((value, k) => value !== first[k]);
      most = Math.max(most, one.space.pairCount);
    }
    expect(moved).toBe(row.kind !== 'still');
    expect(most).toBeGreaterThan(0);
  });

  /** All of them in 2D. */
  const setOnes = some.filter(({ by }) => by === 'set');
  test.each(setOnes.map((row) => [row.name, row] as const))('%s: set are those that moved, and no others', (_, row) => {
    const one = open(prepare(row), 'auto');
    const written = open(prepare({ ...row, by: undefined }), 'auto');
    const set = vi.spyOn(one.space, 'set');
    let before = boxesOf(written);
    for (let frame = 0; frame < frames; frame++) {
      set.mockClear();
      next(one, frame);
      next(written, frame);
      const boxes = boxesOf(written);
      expect(boxesOf(one)).toEqual(boxes);
      const movers = new Set(boxes.flatMap((value, k) => (value === before[k] ? [] : Math.floor(k / 4))));
      expect(set.mock.calls.map(([id]) => id)).toEqual([...movers]);
      before = boxes;
    }
  });

  test('no name stands twice for as many boxes', () => {
    expect(new Set(all.map(({ name, count }) => `${name} ${count}`)).size).toBe(all.length);
  });
});

test('a row of little change: the cold start apart from what comes after, each against all anew', () => {
  const frames = phases.settled + phases.steady;
  const of = (filling: number, steady: number) => [
    Array.from({ length: frames }, (_, k) => (k < phases.settled ? filling : steady)),
  ];
  const facts = { count: 9, pairs: 3, kept: 1, playings: 1, bytes: { 'strip-sweep': 50, auto: 60, incremental: 70 } };
  const { figures, itself } = judge({ ...facts, times: [of(2, 4), of(3, 1), of(2, 8), of(4, 5)] });
  const even = (time: number) => ({ mean: time, p95: time, worst: time });
  const all = (ratio: number) => ({ ratio, worstRatio: ratio, worstFrame: 0 });
  expect(figures).toEqual({
    'strip-sweep': { ...even(4), filling: even(2), bytes: 50 },
    auto: { ...even(1), ...all(0.25), filling: { ...even(3), ...all(1.5) }, bytes: 60 },
    incremental: { ...even(8), ...all(2), filling: { ...even(2), ...all(1) }, bytes: 70 },
  });

  expect(itself).toEqual({ filling: all(2), steady: all(1.25) });

  const row = { name: 'static2d', kind: 'static', nativeMs: 2, ...facts, figures, itself };
  const goals = coherenceGoals([row, { ...row, name: 'another', nativeMs: 0.5 }]);
  const met = Object.fromEntries(goals.map(({ goal, met }) => [goal, met]));
  expect(met['5 % move: a quarter of all anew']).toBe(true);
  const native = goals.find(({ goal }) => goal.startsWith('5 % move: the time'));
  expect(native).toMatchObject({ figure: '1 of 2; the worst: 2.00x (another, 9)', met: false });
  expect(met['100,000 still and 1,000 moving: 0.1 ms']).toBeUndefined();
  // 1.5 times all anew in its worst frame would be too much, but all anew has 2 against itself.
  expect(goals.find(({ goal }) => goal.startsWith('cold starts'))).toMatchObject({ met: true });
  const quiet = { ...row, itself: { ...itself, filling: all(1.2) } };
  const spiky = coherenceGoals([quiet]).find(({ goal }) => goal.startsWith('cold starts'));
  expect(spiky).toMatchObject({ figure: '0 of 1; the worst: 1.25x', met: false });
});

test('the page of figures has the goals and tables of what there is, our own techniques alone side by side', () => {
  const fixture = (name: string) =>
    JSON.parse(readFileSync(new URL(`./fixtures/${name}.json`, import.meta.url), 'utf8'));
  const full = fixture('bench-results');
  const coherence = fixture('bench-coherence');
  const page = figures({ full, coherence }, loadCases());
  const titles = page.split('\n').filter((line) => line.startsWith('#'));
  expect(titles).toEqual(['# Figures', '## Goals', '## Against packages', '## When little changes', '## Techniques']);
  expect(page).toContain('| 100,000 still and 1,000 moving: 0.1 ms | 0 of 1; the worst: 0.320 ms | no |');
  expect(page).toContain('| one huge mover | 100,000 | 5,000 | 2.20 | 0.300 / 0.360 / 0.420 | 0.14x |');
  expect(page.split('## Techniques')[1]).not.toContain('tutorial');

  const auto = { name: 'auto', peer: 'broadphase', figures: { median: 9, mean: 9, p95: 9 } };
  const duel = { ms: 1, rounds: 15, against: [{ name: 'strip-sweep', ms: 1, ratio: 1 }] };
  const races = [{ ...full.races[0], duel, results: [auto] }];
  const goal = 'than the best technique | ';
  expect(figures({ full, coherence, techniques: { ...full, races } }, loadCases())).toContain(`${goal}1 of 1 | yes |`);
  expect(figures({ coherence }, loadCases())).not.toContain(goal);
});
