// One race as a figure: its bars, the figures as a table, and the command that reproduces them.
import { formatCount, formatMilliseconds } from '../shared/format.ts';
import { asPicture, bars } from './charts.ts';
import { make, scrolling } from './elements.ts';
import { type Race, reference, timed } from './records.ts';

export function raceFigure(race: Race, width: number, command: string): HTMLElement {
  const chart = bars(race, width);
  const [fastest] = timed(race);
  asPicture(
    chart,
    `Bars: the time of each contender on ${race.name} with ${formatCount(race.count)} boxes. The fastest: ${fastest.name}, ${formatMilliseconds(fastest.total.median)} ms a frame.`,
  );
  const us = reference(race);
  const untimed = race.contenders
    .filter(({ total }) => !total)
    .map(({ name, error, slow }) => [name, error ?? `over ${formatMilliseconds(slow!)} ms a frame`, '', '', '', '']);
  const rows = timed(race).map(({ name, total, timed: frames }) => [
    name,
    ...[total.median, total.p95, total.worst].map(formatMilliseconds),
    us ? `${(total.median / us.total.median).toPrecision(3)}` : '',
    `${frames}`,
  ]);
  const { mean, least, most } = race.pairs;
  const pairs = least === most ? formatCount(mean) : `${formatCount(least)} to ${formatCount(most)}`;
  return make(
    'figure',
    {},
    make(
      'figcaption',
      {},
      `${titleOf(race)} `,
      make('span', { className: 'aside' }, `${formatCount(race.count)} boxes, ${pairs} pairs, ${race.frames} frames`),
    ),
    chart,
    make(
      'details',
      {},
      make('summary', {}, 'Figures, and how to get them yourself'),
      make('pre', { className: 'code' }, make('code', {}, command)),
      scrolling(
        `Figures of ${titleOf(race)}`,
        ['contender', 'median ms', 'p95 ms', 'worst ms', 'of ours', 'frames'],
        [...rows, ...untimed],
      ),
    ),
  );
}

const titleOf = ({ name, dimensions, numbers, kind }: Race) =>
  `${name}${kind === 'motions' ? ` ${dimensions}D` : ''}${numbers === 'double' ? ', in doubles' : ''}`;
