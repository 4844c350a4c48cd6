// Plots as SVG text: bars, and lines over common axes. Titles show the numbers, without a script. Colours are the
// page's variables --c0 … --c5.
import { leastOf, mostOf } from './extremes.ts';
import { number, time } from './terminal.ts';

const width = 900;
const colours = 6;
const lineHeight = 24;

/** A bar for each, on a logarithmic scale that begins below the smallest: techniques differ by factors. */
export function barPlot(bars: readonly { name: string; value: number }[], title: string): string {
  const values = bars.map(({ value }) => value).filter((value) => value > 0);
  const low = Math.log10(leastOf(values)) - 0.3;
  const high = Math.log10(mostOf(values)) + 0.001;
  const labels = 260;
  const room = width - labels - 80;
  const rows = bars.map(({ name, value }, k) => {
    const y = k * lineHeight;
    const length = value > 0 ? (room * (Math.log10(value) - low)) / (high - low) : 0;
    return `<g><title>${htmlText(name)}: ${time(value)}</title><text x="${labels - 8}" y="${y + 16}" text-anchor="end">${htmlText(name)}</text>
<rect x="${labels}" y="${y + 4}" width="${length.toFixed(1)}" height="${lineHeight - 8}" fill="var(--c0)"/>
<text x="${(labels + length + 6).toFixed(1)}" y="${y + 16}">${time(value)}</text></g>`;
  });
  return svg(bars.length * lineHeight + 4, title, rows.join('\n')) + `<p class="legend">${htmlText(title)}</p>`;
}

export interface Line {
  name: string;
  points: readonly { x: number; y: number }[];
}

const height = 300;
const [left, right, top, bottom] = [70, 24, 10, 40];
/** The largest number of places along the axis with a title. */
const mostPlaces = 500;
const mostMarks = 9;

interface Axes {
  x: string;
  y: string;
  /** Both axes are logarithmic; else the vertical one begins at zero. */
  logarithmic?: boolean;
}

/** Lines over common axes. A title at each place shows the numbers of all lines there. */
export function linePlot(lines: readonly Line[], axes: Axes): string {
  const all = lines.flatMap(({ points }) => points);
  const place = axes.logarithmic ? Math.log2 : (value: number) => value;
  const scale = (values: readonly number[], from: number, to: number) => {
    const low = place(leastOf(values));
    const span = place(mostOf(values)) - low || 1;
    return (value: number) => from + ((place(value) - low) / span) * (to - from);
  };
  const xs = [...new Set(all.map(({ x }) => x))].sort((a, b) => a - b);
  const ys = all.map(({ y }) => y).filter((y) => y > 0 || !axes.logarithmic);
  const most = mostOf(ys) || 1;
  const marked = axes.logarithmic ? ticksAround(leastOf(ys), most) : ticks(most);
  const heights = [marked[0], marked.at(-1)!];
  const places = axes.logarithmic ? ticksAround(xs[0], xs.at(-1)!) : some(xs, mostMarks);
  const across = scale(places, left, width - right);
  const up = scale(heights, height - bottom, top);
  const grid = marked.map(
    (y) => `<line class="axis" x1="${left}" x2="${width - right}" y1="${up(y).toFixed(1)}" y2="${up(y).toFixed(1)}"/>
<text x="${left - 8}" y="${(up(y) + 4).toFixed(1)}" text-anchor="end">${number(y)}</text>`,
  );
  const marks = places.map(
    (x) => `<text x="${across(x).toFixed(1)}" y="${height - bottom + 18}" text-anchor="middle">${number(x)}</text>`,
  );
  const paths = lines.map(({ points }, k) => {
    const colour = `var(--c${k % colours})`;
    const at = points.map(({ x, y }) => `${across(x).toFixed(1)} ${up(y).toFixed(1)}`);
    if (at.length > 1) return `<path class="line" stroke="${colour}" d="M${at.join('L')}"/>`;
    return at
      .map((one) => `<circle cx="${one.split(' ')[0]}" cy="${one.split(' ')[1]}" r="3" fill="${colour}"/>`)
      .join('');
  });
  const names = `<text x="${width / 2}" y="${height - 4}" text-anchor="middle">${htmlText(axes.x)}</text>
<text transform="translate(14 ${(height - bottom) / 2}) rotate(-90)" text-anchor="middle">${htmlText(axes.y)}</text>`;
  const legend = lines.map(
    ({ name }, k) => `<li><i style="background:var(--c${k % colours})"></i>${htmlText(name)}</li>`,
  );
  const content = [...grid, ...marks, ...paths, names, ...strips(lines, some(xs, mostPlaces), across, axes)];
  return `${svg(height, `${axes.y} over ${axes.x}`, content.join('\n'))}<ul class="legend">${legend.join('')}</ul>`;
}

/** At most `most` of them, evenly spaced, including the first and the last. */
function some(values: readonly number[], most: number): number[] {
  if (values.length <= most) return [...values];
  return Array.from({ length: most }, (_, k) => values[Math.round((k * (values.length - 1)) / (most - 1))]);
}

/** A strip at each place along the axis, up to halfway to its neighbours, whose title has the numbers there. */
function strips(lines: readonly Line[], xs: readonly number[], across: (x: number) => number, axes: Axes): string[] {
  const values = lines.map(({ name, points }) => ({ name, at: new Map(points.map(({ x, y }) => [x, y])) }));
  return xs.map((x, k) => {
    const from = k > 0 ? (across(xs[k - 1]) + across(x)) / 2 : left;
    const to = k + 1 < xs.length ? (across(x) + across(xs[k + 1])) / 2 : width - right;
    const there = values.filter(({ at }) => at.has(x)).map(({ name, at }) => `${name}: ${number(at.get(x)!)}`);
    const title = htmlText([`${axes.x} ${number(x)}`, ...there].join('\n'));
    return `<rect class="at" x="${from.toFixed(1)}" y="${top}" width="${(to - from).toFixed(1)}" height="${height - top - bottom}"><title>${title}</title></rect>`;
  });
}

/** Round numbers on a logarithmic scale, 1, 2 and 5 of each power of ten, from the last below to the first above. */
function ticksAround(low: number, high: number): number[] {
  const first = Math.floor(Math.log10(low));
  const powers = Array.from({ length: Math.ceil(Math.log10(high)) - first + 2 }, (_, k) => 10 ** (first + k));
  const all = powers.flatMap((power) => [power, 2 * power, 5 * power]);
  return all.slice(
    all.findLastIndex((each) => each <= low),
    all.findIndex((each) => each > low && each >= high) + 1,
  );
}

/** Four or five round numbers from 0 to above the most. */
function ticks(most: number): number[] {
  const rough = most / 4;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 2.5, 5, 10].map((factor) => factor * power).find((each) => each >= rough)!;
  return Array.from({ length: Math.floor(most / step) + 2 }, (_, k) => k * step);
}

const svg = (height: number, title: string, content: string) =>
  `<div class="wide"><svg viewBox="0 0 ${width} ${height}" role="img" aria-label="${htmlText(title)}">${content}</svg></div>`;

/** Text in HTML. */
export const htmlText = (text: string): string =>
  text.replace(/[&<>"']/g, (character) => `&#${character.charCodeAt(0)};`);
