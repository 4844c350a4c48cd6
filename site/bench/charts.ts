// The charts, drawn by Observable Plot: bars of one race, a heat map of techniques, and what these share with the curves
// of growth.ts. All on logarithmic scales, since contenders differ by factors.
import * as Plot from '@observablehq/plot';
import { formatCount, formatMilliseconds } from '../shared/format.ts';
import { isOurs, type Race, ratios, reference, timed } from './records.ts';

export const ours = 'var(--accent)';
export const others = 'var(--control-line)';
export const style = { fontSize: '12px', background: 'none', overflow: 'visible' };
const rowHeight = 22;
/** Narrower charts have fewer marks, in pixels. */
const roomy = 440;
/** Room for the names on the left, and for the label after the longest bar. */
const [nameRoom, labelRoom] = [140, 62];

/** Where a logarithmic axis may have marks between powers of ten: the fewest that make enough. */
const steps = [[1], [1, 3], [1, 2, 5], [1, 1.5, 2, 3, 4, 6, 8]];

/** The marks of a logarithmic axis: at least two, and more where there is room. */
export function marks(from: number, to: number, enough = 3): number[] {
  let found: number[] = [];
  for (const between of steps) {
    found = [];
    for (let power = Math.floor(Math.log10(from)); 10 ** power <= to; power++) {
      const here = between.map((step) => Number(`${step}e${power}`)); // exact, as products are not
      found.push(...here.filter((at) => at >= from && at <= to));
    }
    if (found.length >= enough) break;
  }
  return found;
}

export type Chart = (SVGSVGElement | HTMLElement) & Plot.Plot;

/** Makes a chart one picture with a name. Plot names its parts for itself, which says nothing within a picture. */
export function asPicture(chart: Element, label: string): void {
  for (const part of chart.querySelectorAll('g')) {
    for (const name of ['aria-label', 'aria-description']) part.removeAttribute(name);
  }
  chart.setAttribute('role', 'img');
  chart.setAttribute('aria-label', label);
}

/** How many times as long. */
export const times = (ratio: number) => `${ratio < 10 ? ratio.toPrecision(2) : formatCount(ratio)}×`;
const shortName = (name: string) => (name.length > 19 ? `${name.slice(0, 18)}…` : name);

/** A bar for each contender: its median frame, then its ratio to ours; a line reaches to its 95th percentile. */
export function bars(race: Race, width: number): Chart {
  const us = reference(race);
  const rows = timed(race).map((result) => ({
    name: shortName(result.name),
    ours: isOurs(result),
    ...result.total,
    reach: Math.max(result.total.p95, result.total.median),
    note: `${us ? times(result.total.median / us.total.median) : ''}${result.wrong ? ' wrong' : ''}`,
    title: `${result.name}: median ${formatMilliseconds(result.total.median)} ms, p95 ${formatMilliseconds(result.total.p95)} ms, worst ${formatMilliseconds(result.total.worst)} ms${result.wrong ? `; finds ${formatCount(result.wrong.pairs!)} of ${formatCount(result.wrong.exact!)} pairs` : ''}`,
  }));
  const least = Math.min(...rows.map(({ median }) => median));
  const most = Math.max(...rows.map(({ reach }) => reach));
  return Plot.plot({
    width,
    height: rows.length * rowHeight + 46,
    marginLeft: nameRoom,
    marginRight: labelRoom,
    marginTop: 6,
    marginBottom: 36,
    style,
    x: {
      type: 'log',
      label: 'ms a frame, logarithmic',
      domain: [least / 2, most],
      ticks: marks(least / 2, most, width < roomy ? 2 : 3),
      tickFormat: ms,
      grid: true,
    },
    y: { label: null, domain: rows.map(({ name }) => name), tickSize: 0 },
    marks: [
      Plot.barX(rows, {
        y: 'name',
        x1: least / 2,
        x2: 'median',
        fill: (row) => (row.ours ? ours : others),
        insetTop: 3,
        insetBottom: 3,
        rx: 2,
        title: 'title',
      }),
      Plot.ruleY(rows, { y: 'name', x1: 'median', x2: 'reach', stroke: 'currentColor', strokeOpacity: 0.65 }),
      Plot.tickX(rows, {
        y: 'name',
        x: 'reach',
        stroke: 'currentColor',
        strokeOpacity: 0.65,
        insetTop: 6,
        insetBottom: 6,
      }),
      Plot.text(rows, { y: 'name', x: 'reach', text: 'note', dx: 6, textAnchor: 'start', fill: 'currentColor' }),
    ],
  });
}

/** A row for each race, a column for each technique: its time in multiples of the best. */
export function heat(races: readonly Race[], width: number): Chart {
  const rowOf = ({ name, count }: Race) => `${name} ${short(count)}`;
  const cells = races.flatMap((race) => ratios(race).map(({ name, ratio }) => ({ row: rowOf(race), name, ratio })));
  const names = [...new Set(cells.map(({ name }) => name))];
  const wide = Math.max(width, 130 + 46 * names.length);
  return Plot.plot({
    width: wide,
    height: 96 + 24 * races.length,
    marginLeft: 128,
    marginTop: 96,
    marginRight: 64,
    marginBottom: 4,
    style,
    x: { label: null, domain: names, axis: 'top', tickRotate: -42, tickSize: 0 },
    y: { label: null, domain: races.map(rowOf), tickSize: 0 },
    color: { type: 'log', domain: [1, 8], clamp: true, interpolate: warmth },
    marks: [
      Plot.cell(cells, {
        x: 'name',
        y: 'row',
        fill: 'ratio',
        inset: 1,
        rx: 3,
        title: (cell) => `${cell.name} on ${cell.row}: ${times(cell.ratio)} the best`,
      }),
      Plot.text(cells, {
        x: 'name',
        y: 'row',
        text: (cell) => (cell.ratio < 1.05 && cell.ratio > 0.95 ? '1' : times(cell.ratio).slice(0, -1)),
        fill: 'var(--text)',
      }),
    ],
  });
}

/** A mix of two colours of the page, in its current colour scheme. */
const warmth = (share: number) => `color-mix(in oklab, var(--heat-best) ${100 * (1 - share)}%, var(--heat-worst))`;

const short = (count: number) =>
  count >= 1e6 ? `${count / 1e6}M` : count >= 1e3 ? `${Number((count / 1e3).toPrecision(3))}k` : `${count}`;
export const ms = (value: number) => Number(value.toPrecision(2)).toString();
