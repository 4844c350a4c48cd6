// Out of a file of results of coherence.mjs: the table, and each goal with its figure.
import { short, whole } from './table.mjs';

const times = (ratio) => `${ratio.toFixed(2)}x`;

/** The titles of the columns, and how a table in Markdown aligns them. */
const columns = [
  ['what moves', '---'],
  ['boxes', '---:'],
  ['pairs', '---:'],
  ['all anew', '---:'],
  ['`auto`: mean / p95 / worst', '---:'],
  ['of all anew', '---:'],
  ['worst frame; all anew against itself', '---:'],
  ['cold start: mean, worst frame; itself', '---:'],
  ['kept', '---:'],
  ['`incremental`: mean, worst frame', '---:'],
  ['bytes a box: anew, `auto`, `incremental`', '---:'],
];

/** The table as titles and rows of text. */
export const coherenceCells = (rows) => ({ titles: columns.map(([title]) => title), rows: rows.map(cellsOf) });

/** The goals as rows of text: what, the figure, whether it is met. */
export const coherenceVerdicts = (rows) =>
  coherenceGoals(rows).map(({ goal, figure, met }) => [
    goal,
    figure,
    met === undefined ? 'not measured' : met ? 'yes' : 'no',
  ]);

export function coherenceTable(played) {
  const row = (cells) => `| ${cells.join(' | ')} |`;
  const { titles, rows } = coherenceCells(played);
  return [row(titles), row(columns.map(([, rule]) => rule)), ...rows.map(row)].join('\n');
}

/** A row while others are still being played. */
export function coherenceLine(row) {
  return cellsOf(row)
    .map((cell, k) => (k === 0 ? cell.padEnd(32) : k === 1 ? cell.padStart(9) : cell))
    .join('  ');
}

function cellsOf({ name, problem, wrong, count, pairs, kept, figures, itself }) {
  if (problem) return [name, problem];
  const { auto, incremental, 'strip-sweep': anew } = figures;
  return [
    wrong ? `${name}: ${wrong.technique} WRONG in frame ${wrong.frame}` : name,
    whole(count),
    whole(pairs),
    short(anew.mean),
    [auto.mean, auto.p95, auto.worst].map(short).join(' / '),
    times(auto.ratio),
    `${times(auto.worstRatio)}; ${times(itself.steady.worstRatio)}`,
    `${times(auto.filling.ratio)}, ${times(auto.filling.worstRatio)}; ${times(itself.filling.worstRatio)}`,
    `${Math.round(100 * kept)} %`,
    `${times(incremental.ratio)}, ${times(incremental.worstRatio)}`,
    [anew, auto, incremental].map(({ bytes }) => Math.round(bytes)).join(', '),
  ];
}

/** Each goal: how many of its rows reach it, and the worst. `undefined` where none was played. */
export function coherenceGoals(rows) {
  const played = rows.filter(({ problem }) => !problem);
  const of = (...kinds) => played.filter(({ kind }) => kinds.includes(kind));
  /** `value(row)` must be at most the limit. */
  const goal = (text, chosen, value, limit, unit) => {
    const found = chosen.map((row) => ({ row, value: value(row) })).sort((a, b) => b.value - a.value);
    if (found.length === 0) return { goal: text, figure: '' };
    const good = found.filter((entry) => entry.value <= limit).length;
    const [{ row, value: highest }] = found;
    const where = found.length > 1 ? ` (${row.name}, ${whole(row.count)})` : '';
    const figure = `${good} of ${found.length}; the worst: ${unit(highest)}${where}`;
    return { goal: text, figure, met: good === found.length };
  };
  const mean = ({ figures }) => figures.auto.mean;
  const ratio = ({ figures }) => figures.auto.ratio;
  const ms = (value) => `${short(value)} ms`;
  const moved = of('slow', 'fast');
  const native = ({ figures, nativeMs }) => figures.auto.mean / nativeMs;
  const tricks = of('adversarial');
  const others = played.filter(({ kind }) => kind !== 'adversarial');
  // What is as much for all anew against itself is the machine.
  const beyond = (its, machine) => its.worstRatio / Math.max(1, machine.worstRatio);
  const worst = ({ figures, itself }) => beyond(figures.auto, itself.steady);
  const worstFilling = ({ figures, itself }) => beyond(figures.auto.filling, itself.filling);
  const wrong = played.filter((row) => row.wrong);
  return [
    goal('100,000 still and 1,000 moving: 0.1 ms', of('tiles'), mean, 0.1, ms),
    goal('100,000 still, none moving: 5 microseconds', of('still'), mean, 0.005, ms),
    goal('5 % move: a quarter of all anew', of('static'), ratio, 0.25, times),
    goal('5 % move: the time of the best native library, by its earlier figure', of('static'), native, 1, times),
    goal('all move by up to a fiftieth of their size: a quarter of all anew', of('slow'), ratio, 0.25, times),
    goal('all move by up to a fifth of their size: 0.6 of all anew', of('fast'), ratio, 0.6, times),
    goal('p95 of these at most 1.5 times the mean', moved, ({ figures: { auto } }) => auto.p95 / auto.mean, 1.5, times),
    goal(
      'recorded scenes: the time of the best native library, by its earlier figure',
      of('recorded', 'asleep'),
      native,
      1,
      times,
    ),
    goal('a recorded scene asleep: 0.05 ms', of('asleep'), mean, 0.05, ms),
    goal(
      'what is meant to harm: no frame above 1.15 of all anew, as far as that varies itself',
      tricks,
      worst,
      1.15,
      times,
    ),
    goal('anything else: no frame above 1.15 of all anew, as far as that varies itself', others, worst, 1.15, times),
    goal(
      'cold starts: no frame above 1.15 of all anew, as far as that varies itself',
      played,
      worstFilling,
      1.15,
      times,
    ),
    {
      goal: 'the same pairs as all anew, in every frame compared',
      figure: played.length > 0 ? `${played.length - wrong.length} of ${played.length}` : '',
      met: played.length > 0 ? wrong.length === 0 : undefined,
    },
  ];
}
