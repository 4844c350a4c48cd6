// The results of one race as text, each contender against the best technique of this library.

export const short = (value) => (value < 10 ? value.toPrecision(3) : value.toFixed(1));

export const whole = (value) => value.toLocaleString('en');

/** What is wrong with a contender's pairs, in words: the share of the exact pairs that it found, and what it added. */
export function faultOf({ wrong }, what = 'the pairs') {
  if (!wrong) return '';
  const { exact, missed, extra } = wrong;
  const share = exact === 0 ? 100 : Math.floor((1e4 * (exact - missed)) / exact) / 100;
  return `WRONG: ${share} % of ${what}${extra ? ` and ${whole(extra)} that are none` : ''}`;
}

export function bestOf(results) {
  const ours = results.filter(({ peer, figures }) => peer === 'broadphase' && figures);
  return ours.sort((a, b) => a.figures.median - b.figures.median)[0];
}

function bytes(count) {
  if (count === undefined) return '';
  return count >= 1e6
    ? `${short(count / 1e6)} MB`
    : count >= 1e3
      ? `${short(count / 1e3)} kB`
      : `${Math.round(count)} B`;
}

export function table(race) {
  const { results } = race;
  const best = bestOf(results);
  const rows = results.map((result) => {
    const { name, figures, problem, skipped, own, garbage, peak } = result;
    if (!figures) return [name, problem ?? `skipped: ${skipped}`];
    const times = [figures.median, figures.mean, figures.p95, figures.worst].map(short);
    const ratio = best ? `${short(figures.median / best.figures.median)}x` : '';
    const remarks = [
      own === undefined ? '' : `its broad phase alone: ${short(own)}`,
      faultOf(result, race.question && 'the answers'),
    ];
    return [name, ...times, ratio, bytes(garbage), bytes(peak), remarks.filter(Boolean).join('; ')];
  });
  const header = ['ms per frame', 'median', 'mean', 'p95', 'worst', 'ratio', 'garbage', 'memory', ''];
  const full = [header, ...rows.filter((row) => row.length > 2)];
  const widths = header.map((_, column) => Math.max(...full.map((row) => row[column].length)));
  widths[0] = Math.max(...[header, ...rows].map((row) => row[0].length));
  const lines = [header, ...rows].map((row) =>
    row
      .map((cell, k) => (k === 0 || k === row.length - 1 ? cell.padEnd(widths[k]) : cell.padStart(widths[k])))
      .join('  ')
      .trimEnd(),
  );
  if (race.duel) lines.push(`auto again, in turns: ${race.duel.against.map(metBy).join(', ')}`);
  return [titleOf(race), ...lines].join('\n');
}

const metBy = ({ name, ratio }) => `${short(ratio)}x ${name}`;

function titleOf({ scene, question, still, count, pairs }) {
  if (!question) return `${scene}: ${whole(count)} boxes, ${whole(pairs)} pairs`;
  const when = still ? '' : ' after an update of all boxes';
  return `${scene}: ${whole(count)} boxes, 1,000 questions a frame${when}, ${whole(pairs)} answers`;
}
