// Whether `auto` is as fast as the best technique: a race of a dozen contenders cannot tell by ten percent, for each runs
// in another minute of a machine that changes, and of a dozen medians the least is one that had luck. So those that came
// near `auto`, or were ahead, meet it again, a few frames each and in turns, in the same frames, on the clock of the
// processor; what counts is the median over the rounds of the ratio of the two times of a round.
import { median } from './statistics.mjs';

/** Who took longer than `auto` by more than this is not asked again; of the others no more than so many. */
const [near, most] = [1.6, 4];
const rounds = 31;
/** After so many rounds and milliseconds it is enough. */
const [least, patience] = [9, 3000];
/** A turn, in milliseconds. */
const turn = 10;
const mostFrames = 5000;

/**
 * `auto` and those it meets again, the fastest first; none where all others were far behind.
 * @param results of a race. `atWork`: milliseconds a frame that the process had the processor, in its best round
 */
export function duellists(results) {
  const timed = results.filter(({ peer, figures, wrong }) => peer === 'broadphase' && figures && !wrong);
  const auto = timed.find(({ name }) => name === 'auto');
  if (!auto) return [];
  const others = timed
    .filter((each) => each !== auto && each.atWork <= near * auto.atWork)
    .sort((a, b) => a.atWork - b.atWork)
    .slice(0, most);
  return others.length > 0 ? [auto, ...others] : [];
}

/**
 * Lets them meet. `ask(result, action, value)` gives the answer of the process of a contender.
 * @returns for each its milliseconds a frame, and for the others how many times their time `auto` took; undefined where
 *   nobody came near
 */
export async function duel(results, ask) {
  const entrants = duellists(results);
  if (entrants.length === 0) return undefined;
  const frames = Math.max(1, Math.min(mostFrames, Math.round(turn / entrants[0].atWork)));
  // All go on from the frame that the fastest has reached.
  const reached = [];
  for (const entrant of entrants) reached.push((await ask(entrant, 'catchUp', 0)).played ?? 0);
  for (const entrant of entrants) {
    if ((await ask(entrant, 'catchUp', Math.max(...reached))).error) return undefined;
  }
  const times = entrants.map(() => []);
  const end = performance.now() + patience;
  for (let round = 0; round < rounds && (round < least || performance.now() < end); round++) {
    const order = round % 2 === 0 ? [...entrants.keys()] : [...entrants.keys()].reverse();
    for (const k of order) {
      const { ms } = await ask(entrants[k], 'turn', frames);
      if (ms === undefined) return undefined;
      times[k].push(ms);
    }
  }
  return verdict(
    entrants.map(({ name }) => name),
    times,
  );
}

/** The times of `auto` come first; those of a round stand at the same place. */
export function verdict(names, [auto, ...others]) {
  const against = others.map((theirs, k) => ({
    name: names[k + 1],
    ms: median(theirs),
    ratio: median(theirs.map((time, round) => auto[round] / time)),
  }));
  return { ms: median(auto), rounds: auto.length, against };
}
