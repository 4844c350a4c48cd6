// What the library must reach, each with its figure out of a file of results, and whether it is met.
import { bestPeer } from './markdown.mjs';
import { bestOf, short, whole } from './table.mjs';
import { autoAgainstBest } from './techniques.mjs';

/** `judged`: the races by which `auto` is held against the other techniques, if there are better ones than these. */
export function goals({ races, library }, cases, judged = races) {
  const find = (scene, count) => races.find((race) => race.scene === scene && race.count === count);
  const autoOf = (race) => race?.results.find(({ name, figures }) => name === 'auto' && figures);

  /** At most so many milliseconds for `auto` in one race. */
  const atMost = (goal, scene, count, limit) => {
    const ms = autoOf(find(scene, count))?.figures.median;
    return { goal, figure: ms === undefined ? '' : `${short(ms)} ms`, met: ms === undefined ? undefined : ms <= limit };
  };

  /** `value(race)` is at least, or at most, the limit in all races chosen; shown is how many, and the worst. */
  const inAll = (goal, chosen, value, [order, limit], unit) => {
    const sign = order === 'at least' ? 1 : -1;
    const found = chosen
      .map((race) => ({ race, value: value(race) }))
      .filter((entry) => entry.value !== undefined)
      .sort((a, b) => sign * (a.value - b.value));
    if (found.length === 0) return { goal, figure: '' };
    const good = found.filter((entry) => sign * (entry.value - limit) >= 0).length;
    const [worst] = found;
    const figure = `${good} of ${found.length}; the worst: ${unit(worst.value)} (${worst.race.scene}, ${whole(worst.race.count)})`;
    return { goal, figure, met: good === found.length };
  };
  const times = (value) => `${short(value)}x`;

  const large = races.filter(({ scene, question, count }) => !question && count === 100_000 && /[23]d$/.test(scene));
  const asked = races.filter(({ question }) => question);
  const againstPeers = (race) => {
    const [peer, auto] = [bestPeer(race.results), autoOf(race)];
    return peer && auto ? peer.figures.median / auto.figures.median : undefined;
  };
  const ahead = (race) => {
    const [peer, ours] = [bestPeer(race.results), bestOf(race.results)];
    return peer && ours ? peer.figures.median / ours.figures.median : undefined;
  };
  const againstNative = (race) => {
    const [native, auto] = [cases.get(race.scene)?.bestNativeMs, autoOf(race)];
    return native && auto ? native / auto.figures.median : undefined;
  };
  /** What is allowed is in techniques.mjs; the worst of those beyond it is shown. */
  const againstFixed = (goal) => {
    const found = judged.map((race) => ({ race, ...autoAgainstBest(race) })).filter(({ best }) => best);
    if (found.length === 0) return { goal, figure: '' };
    const missed = found.filter(({ within }) => !within).sort((a, b) => b.slower - a.slower);
    const count = `${found.length - missed.length} of ${found.length}`;
    if (missed.length === 0) return { goal, figure: count, met: true };
    const [{ race, slower, best }] = missed;
    const worst = `${times(1 + slower)} the time of ${best} (${race.scene}, ${whole(race.count)})`;
    return { goal, figure: `${count}; the worst: ${worst}`, met: false };
  };
  const garbage = (race) => {
    const ours = race.results.filter((result) => result.peer === 'broadphase' && result.garbage !== undefined);
    return ours.length > 0 ? Math.max(...ours.map((result) => result.garbage)) : undefined;
  };
  const kilobytes = library && library.gzippedBytes / 1000;

  return [
    inAll('100,000 boxes: 40 times as fast as every npm package', large, againstPeers, ['at least', 40], times),
    { goal: '100,000 boxes: 4 times as fast as every native library, side by side', figure: '' },
    atMost('1,000 moving boxes, 2D: 0.02 ms', 'uniform2d', 1000, 0.02),
    atMost('100 moving boxes, 2D: 2 microseconds', 'uniform2d', 100, 0.002),
    atMost('1,000,000 moving boxes, 2D: 16.6 ms', 'uniform2d', 1_000_000, 16.6),
    atMost('100,000 resting and 1,000 moving: 0.1 ms', 'tile-map', 101_000, 0.1),
    inAll(
      'recorded scenes: ahead of every native library, by its earlier figure',
      races,
      againstNative,
      ['at least', 1],
      times,
    ),
    againstFixed('`auto` never more than 10 % and 20 microseconds slower than the best technique'),
    inAll('every question: ahead of every npm package', asked, ahead, ['at least', 1], times),
    inAll(
      'no JavaScript heap per frame',
      races.filter(({ question }) => !question),
      garbage,
      ['at most', 0],
      (value) => `${Math.round(value)} bytes`,
    ),
    {
      goal: '25 kB gzipped, kernel inlined',
      figure: library ? `${kilobytes.toFixed(1)} kB` : '',
      met: library && kilobytes <= 25,
    },
    {
      goal: 'from import to first pairs: under 5 ms',
      figure: library ? `${short(library.importToPairsMs)} ms` : '',
      met: library && library.importToPairsMs < 5,
    },
  ];
}
