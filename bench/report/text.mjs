// A row as text, during a run.
import { motionCells, motionTitles } from './motions.mjs';
import { short, textLine, times, whole } from './words.mjs';

/** Kinds of rows that are printed as lines of a table, under its titles. */
const lined = ['motions', 'movers'];

export const headOf = (kind) => (lined.includes(kind) ? textLine(motionTitles, motionTitles) : '');

export function textOf(row) {
  if (lined.includes(row.kind) && !row.error) return textLine(motionTitles, motionCells(row));
  return [
    titleOf(row),
    ...(row.error ? [`  ${row.error}`] : []),
    ...row.contenders.map((each) => lineOf(each, row)),
  ].join('\n');
}

export function titleOf({ name, dimensions, count, numbers, pairs, frames }) {
  const found = pairs ? `, pairs ${whole(pairs.mean)} (${whole(pairs.least)}–${whole(pairs.most)})` : '';
  const over = frames ? `, ${frames} frames` : '';
  return `${name} ${dimensions}D: ${whole(count)} boxes${numbers === 'double' ? ' in doubles' : ''}${found}${over}`;
}

const columns = ['', 'median', 'mean', 'p95', 'worst', 'of ours'];

function lineOf(contender, { contenders, frames }) {
  const { name, error, slow, total, first } = contender;
  const cell = (text) => text.padStart(columns[1].length + 3);
  if (error) return `  ${name.padEnd(24)}${error}`;
  if (slow) return `  ${name.padEnd(24)}over ${short(slow)} ms a frame: not timed`;
  if (first !== undefined) {
    const { later, call, ten, all, kB } = contender;
    const more = [
      later && `call ${call}: ${short(later)}`,
      ten && `first ten: ${short(ten)}`,
      all && `first 120: ${short(all)}`,
    ];
    const notes = [...more, kB && `${short(kB)} kB`, contender.wrong && wrongOf(contender)].filter(Boolean).join('  ');
    return `  ${name.padEnd(24)}${cell(short(first))}  ${notes}`;
  }
  const ours = contenders.find((each) => each.peer === 'broadphase' && each.total);
  const ratio = ours ? times(total.median / ours.total.median) : '';
  return `  ${name.padEnd(24)}${[total.median, total.mean, total.p95, total.worst].map(short).map(cell).join('')}${cell(ratio)}  ${noteOf(contender, frames)}`;
}

/** Remarks beside the figures of a contender: fewer frames, other pairs. */
function noteOf(contender, frames) {
  const fewer = contender.timed < frames ? `${contender.timed} of ${frames} frames` : '';
  return [fewer, contender.wrong ? wrongOf(contender) : ''].filter(Boolean).join('; ');
}

const wrongOf = ({ wrong: { frame, pairs, exact } }) =>
  `WRONG: ${whole(pairs)} pairs instead of ${whole(exact)} in frame ${frame}`;
