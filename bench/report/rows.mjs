// Reads rows of results.

/** npm packages: contenders that are neither ours nor written by hand. */
const own = ['broadphase', 'by hand', 'tutorial-brute-force', 'tutorial-grid', 'no library'];

export const isPackage = ({ peer }) => !own.includes(peer);

export const ofKind = ({ rows }, kind) => rows.filter((row) => row.kind === kind && !row.error);

export const timed = ({ contenders }) => contenders.filter(({ total }) => total);

export const named = (row, name) => timed(row).find((each) => each.name === name);

/** The smallest median of the contenders that pass the filter and find the right pairs. */
export const fastest = (row, which) =>
  timed(row)
    .filter((each) => which(each) && !each.wrong)
    .sort((a, b) => a.total.median - b.total.median)[0];

/** Why no package has a figure. */
export const none = ({ contenders }) => (contenders.some(isPackage) ? 'none within the limit' : 'not tried');

/** How much longer `auto` may take than the best technique: a share of it, and milliseconds for the call itself. */
const allowed = { share: 0.1, ms: 0.02 };

/**
 * The best technique that could have been used instead of `auto`, and the ratio of `auto` to it in the same frames. `auto`
 * is the first contender, so the shares of all others are of its time.
 */
export function autoAgainstBest(row) {
  const auto = named(row, 'auto');
  const [best] = timed(row)
    .filter(({ peer, name, wrong, share }) => peer === 'broadphase' && name !== 'auto' && !wrong && share)
    .sort((a, b) => a.share - b.share);
  if (!auto || !best) return undefined;
  const [ours, theirs] = [auto.update.median, auto.update.median * best.share];
  return { best: best.name, ratio: 1 / best.share, within: ours <= theirs * (1 + allowed.share) + allowed.ms };
}
