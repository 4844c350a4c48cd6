// The figures of a race from the notes on each contender, and whether all saw the same boxes and found the same pairs.
import { leastOfEach, mean, median, spread } from './statistics.mjs';

const parts = ['give', 'update', 'walk'];

/** The figures of a row from the notes. Pairs are those of the frames that the first contender was timed in. */
export function judge(row, entrants) {
  const [first] = entrants;
  if (first.error || first.slow)
    return { ...facts(row), error: first.error ?? 'too slow', contenders: entrants.map(problem) };
  const reference = first.notes[0];
  const { pairs } = reference;
  return {
    ...facts(row),
    count: first.count,
    pairs: { mean: mean(pairs), least: Math.min(...pairs), most: Math.max(...pairs) },
    contenders: entrants.map((entrant) =>
      entrant.error || entrant.slow ? problem(entrant) : figuresOf(entrant, first.notes, row.plan),
    ),
  };
}

/** What is saved of a row besides its figures. */
const facts = ({ plan, recording: _, part: __, budget: ___, ...row }) => ({
  ...row,
  frames: plan.timed,
  warmUp: plan.warmUp,
});

const problem = ({ name, peer, error, slow }) => ({ name, peer, ...(error ? { error } : { slow }) });

function figuresOf({ name, peer, notes, stride }, firsts, plan) {
  const differing = difference(notes, firsts[0]);
  if (differing?.saw) return { name, peer, error: `saw other boxes in frame ${differing.frame}` };
  const times = Object.fromEntries(parts.map((part) => [part, leastOfEach(notes.map((each) => each[part]))]));
  const total = times.update.map((update, k) => times.give[k] + update + times.walk[k]);
  const timed = total.length;
  const figures = { name, peer, timed, total: spread(total), update: spread(times.update), give: spread(times.give) };
  figures.share = shareOf(times.update, notes[0], firsts);
  if (stride === 1 && plan.warmUp > 0) {
    figures.start = spread(leastOfEach(notes.map(({ start }) => start)));
  }
  const [{ kept, bytes }] = notes;
  if (bytes > 0) Object.assign(figures, { kept: kept / timed, bytes });
  if (differing) figures.wrong = differing;
  return figures;
}

/**
 * The median of its updates divided by those of the first contender in the same frames. Both are timed shortly after one
 * another, so a machine that is slow for some seconds slows both.
 */
function shareOf(updates, { frames }, firsts) {
  const all = leastOfEach(firsts.map(({ update }) => update));
  const at = new Map(firsts[0].frames.map((frame, k) => [frame, k]));
  return median(updates.map((update, k) => update / all[at.get(frames[k])]));
}

/** The first frame in which a contender saw other boxes, or found other pairs, than the reference in the same frame. */
export function difference(notes, reference) {
  const at = new Map(reference.frames.map((frame, k) => [frame, k]));
  for (const { frames, seen, found, pairs } of notes) {
    for (const [k, frame] of frames.entries()) {
      const same = at.get(frame);
      if (same === undefined || seen[k] !== reference.seen[same]) return { frame, saw: true };
      if (found[k] !== reference.found[same]) return { frame, pairs: pairs[k], exact: reference.pairs[same] };
    }
  }
  return undefined;
}
