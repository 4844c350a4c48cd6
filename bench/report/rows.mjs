// What can be read out of rows of results.

/** Packages of npm are neither ours nor what one writes oneself. */
const own = ['broadphase', 'by hand', 'tutorial-brute-force', 'tutorial-grid', 'no library'];

export const isPackage = ({ peer }) => !own.includes(peer);

export const ofKind = ({ rows }, kind) => rows.filter((row) => row.kind === kind && !row.error);

export const timed = ({ contenders }) => contenders.filter(({ total }) => total);

export const named = (row, name) => timed(row).find((each) => each.name === name);

/** The least median of those that are let through and find the right pairs. */
export const fastest = (row, which) =>
  timed(row)
    .filter((each) => which(each) && !each.wrong)
    .sort((a, b) => a.total.median - b.total.median)[0];

/** What `auto` may take longer than the best technique: a share of it, and in milliseconds the call itself. */
const allowed = { share: 0.1, ms: 0.02 };

/** The best technique that could have been asked for instead of `auto`, and how long `auto` took against it. */
export function autoAgainstBest(row) {
  const auto = named(row, 'auto');
  const best = fastest(row, ({ peer, name }) => peer === 'broadphase' && name !== 'auto');
  if (!auto || !best) return undefined;
  const [ours, theirs] = [auto.update.median, best.update.median];
  return { best: best.name, ratio: ours / theirs, within: ours <= theirs * (1 + allowed.share) + allowed.ms };
}
