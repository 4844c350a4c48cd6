// Two files of results against each other: what changed by more than the noise.
import { markdownTable, short, times, whole } from './words.mjs';

/** Smaller changes are never reported, however quiet the machine. */
const leastChange = 0.05;

const keyOf = ({ kind, name, dimensions, count, numbers, by }) =>
  [kind, name, `${dimensions}D`, count, numbers, by].join(' ');

/** The time of `after` divided by that of `before`, and whether their ranges of noise do not overlap. */
export function change(before, after) {
  const ratio = after.median / before.median;
  const apart = after.range[0] > before.range[1] || before.range[0] > after.range[1];
  return { ratio, beyondNoise: apart && Math.abs(ratio - 1) > leastChange };
}

export function compare(before, after) {
  const earlier = new Map(before.rows.map((row) => [keyOf(row), row]));
  const changed = [];
  let same = 0;
  for (const row of after.rows) {
    const old = earlier.get(keyOf(row));
    if (!old) continue;
    for (const contender of row.contenders) {
      const was = old.contenders.find(({ name }) => name === contender.name);
      if (!was?.total || !contender.total) continue;
      const { ratio, beyondNoise } = change(was.total, contender.total);
      if (beyondNoise)
        changed.push({ row, name: contender.name, ratio, was: was.total.median, is: contender.total.median });
      else same++;
    }
  }
  const head = `${before.commit} (${before.date.slice(0, 10)}) against ${after.commit} (${after.date.slice(0, 10)}): ${same} figures are the same to within the noise, ${changed.length} are not.`;
  const others = before.machine.cpu === after.machine.cpu ? '' : ' They are of two machines: the change may be theirs.';
  if (changed.length === 0) return head + others;
  const cells = changed
    .sort((a, b) => b.ratio - a.ratio)
    .map(({ row, name, ratio, was, is }) => [
      `${row.kind}: ${row.name} ${row.dimensions}D${row.by ? `, ${row.by}` : ''}${row.numbers === 'double' ? ', doubles' : ''}`,
      whole(row.count),
      name,
      short(was),
      short(is),
      times(ratio),
    ]);
  return `${head}${others}\n\n${markdownTable(['row', 'boxes', 'contender', 'before, ms', 'after, ms', 'ratio'], cells)}`;
}
