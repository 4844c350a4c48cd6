// The table of motions: `auto`, in milliseconds, and against `strip-sweep` in the same frames. `update` alone.
import { percent, short, times, whole } from './words.mjs';

export const motionTitles = [
  'motion',
  'boxes',
  'given',
  'pairs: mean, min–max',
  'kept',
  'strip-sweep',
  '`auto`: median',
  'p95',
  'worst',
  'mean',
  'ratio',
  'of means',
  'of p95',
  'start: of means',
  'give',
  'bytes per box',
];

/**
 * The time of `auto` divided by that of `strip-sweep`, by the medians, means and p95s of `update`. NaN for the start of
 * a slow one, which was not measured.
 */
export function ratiosOf({ contenders: [sweep, auto] }) {
  const of = (figure) => auto.update[figure] / sweep.update[figure];
  return {
    median: of('median'),
    mean: of('mean'),
    p95: of('p95'),
    start: (auto.start?.mean ?? NaN) / (sweep.start?.mean ?? NaN),
  };
}

export function motionCells(row) {
  const { name, dimensions, count, by, pairs, contenders } = row;
  const problem = row.error ?? contenders.find(({ error }) => error)?.error;
  const what = [`${name} ${dimensions}D`, whole(count), by === 'boxes' ? 'in place' : by];
  if (problem) return [...what, problem, ...Array(motionTitles.length - what.length - 1).fill('')];
  const [sweep, auto] = contenders;
  const wrong = auto.wrong ? ` WRONG in frame ${auto.wrong.frame}` : '';
  const ratio = ratiosOf(row);
  return [
    ...what,
    `${whole(pairs.mean)}, ${whole(pairs.least)}–${whole(pairs.most)}${wrong}`,
    percent(auto.kept),
    short(sweep.update.median),
    ...[auto.update.median, auto.update.p95, auto.update.worst, auto.update.mean].map(short),
    ...[ratio.median, ratio.mean, ratio.p95, ratio.start].map(times),
    short(auto.give.median),
    String(Math.round(auto.bytes / count)),
  ];
}
