// One race as a figure: its bars, the figures as a table, and the command that reproduces them.
import { formatCount, formatMilliseconds } from '../shared/format.ts';
import { bars } from './charts.ts';
import { make, table } from './elements.ts';
import { type Race, reference, timed } from './records.ts';

export function raceFigure(race: Race, width: number, command: string): HTMLElement {
  const chart = bars(race, width);
  const [fastest] = timed(race);
  chart.setAttribute('role', 'img');
  chart.setAttribute(
    'aria-label',
    `Bars: the time of each contender on ${race.scene} with ${formatCount(race.count)} boxes. The fastest: ${fastest.name}, ${formatMilliseconds(fastest.figures.median)} ms a frame.`,
  );
  const us = reference(race);
  const untimed = race.results
    .filter(({ figures }) => !figures)
    .map(({ name, problem, skipped }) => [name, problem ?? skipped ?? '', '', '', '']);
  const rows = timed(race).map(({ name, figures }) => [
    name,
    ...[figures.median, figures.p95, figures.worst].map(formatMilliseconds),
    us ? `${(figures.median / us.figures.median).toPrecision(3)}` : '',
  ]);
  return make(
    'figure',
    {},
    make(
      'figcaption',
      {},
      `${race.scene} `,
      make('span', { className: 'aside' }, `${formatCount(race.count)} boxes, ${formatCount(race.pairs)} pairs`),
    ),
    chart,
    make(
      'details',
      {},
      make('summary', {}, 'Figures, and how to get them yourself'),
      make('pre', { className: 'code' }, make('code', {}, command)),
      table(['', 'median ms', 'p95 ms', 'worst ms', 'of ours'], [...rows, ...untimed]),
    ),
  );
}
