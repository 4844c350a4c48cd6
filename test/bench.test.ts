// The benchmark's own parts that a wrong figure could hide in: the fingerprint of a set of pairs, and the statistics.
import { expect, test } from 'vitest';
import { fingerprint } from '../bench/fingerprint.mjs';
import { change, summary } from '../bench/statistics.mjs';
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
