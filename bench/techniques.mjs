// All techniques side by side, out of a file of results: one table for each dimension, a row for each scene and number
// of boxes, and how far `auto` is from the best technique that could have been fixed.
import { short, whole } from './table.mjs';

/** What `auto` may take longer than the best: a share of it, and in milliseconds the call itself. */
const allowed = { share: 0.1, ms: 0.02 };

/**
 * The best fixed technique of a race and how much longer `auto` took; undefined where either has no figure. Those that
 * came near have met again, which is to be trusted; where none did, `auto` was far ahead.
 */
export function autoAgainstBest({ duel, results }) {
  if (duel) {
    const [{ name: best, ratio }] = [...duel.against].sort((a, b) => b.ratio - a.ratio);
    return judged(best, duel.ms, duel.ms / ratio);
  }
  const timed = results.filter(({ peer, figures }) => peer === 'broadphase' && figures);
  const auto = timed.find(({ name }) => name === 'auto');
  const [best] = timed.filter(({ name }) => name !== 'auto').sort((a, b) => a.figures.median - b.figures.median);
  return auto && best && judged(best.name, auto.figures.median, best.figures.median);
}

function judged(best, auto, other) {
  return { best, slower: auto / other - 1, within: auto <= other * (1 + allowed.share) + allowed.ms };
}

export function techniqueTables({ races }) {
  return [2, 3]
    .map((dimensions) => races.filter((race) => race.dimensions === dimensions))
    .filter((some) => some.length > 0)
    .map(tableOf)
    .join('\n\n');
}

function tableOf(races) {
  const ours = races.flatMap(({ results }) => results.filter(({ peer }) => peer === 'broadphase'));
  const names = [...new Set(ours.map(({ name }) => name))];
  const row = (cells) => `| ${cells.join(' | ')} |`;
  const lines = [
    `${races[0].dimensions}D: milliseconds per frame, mean / p95; the best in bold.`,
    '',
    row(['scene', 'boxes', 'pairs', ...names, '`auto` against the best']),
    row(['---', '---:', '---:', ...names.map(() => '---:'), '---']),
  ];
  for (const race of races) {
    const judged = autoAgainstBest(race);
    const cells = names.map((name) => {
      const result = race.results.find((each) => each.name === name);
      if (!result) return '';
      if (!result.figures) return result.problem ?? result.skipped;
      const text = `${short(result.figures.mean)} / ${short(result.figures.p95)}${result.wrong ? ' WRONG' : ''}`;
      return name === judged?.best ? `**${text}**` : text;
    });
    const verdict = judged
      ? `${judged.slower > 0 ? '+' : ''}${(100 * judged.slower).toFixed(0)} %${judged.within ? '' : ' (missed)'}`
      : '';
    lines.push(row([race.scene, whole(race.count), whole(race.pairs), ...cells, verdict]));
  }
  const all = races.map(autoAgainstBest).filter(Boolean);
  const missed = all.filter(({ within }) => !within).length;
  lines.push('', `\`auto\`: within 10 % and 0.02 ms of the best in ${all.length - missed} of ${all.length}.`);
  return lines.join('\n');
}
