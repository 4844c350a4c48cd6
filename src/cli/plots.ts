// Plots as SVG text: bars, and lines over a common axis. Colours are the page's variables --c0 … --c5.
import { number, time } from './terminal.ts';

const width = 900;
const colours = 6;
const lineHeight = 24;

/** One bar each, on a logarithmic scale that begins below the least: techniques differ by factors. */
export function barPlot(bars: readonly { name: string; value: number }[], title: string): string {
  const values = bars.map(({ value }) => value).filter((value) => value > 0);
  const low = Math.log10(Math.min(...values)) - 0.3;
  const high = Math.log10(Math.max(...values)) + 0.001;
  const labels = 260;
  const room = width - labels - 80;
  const rows = bars.map(({ name, value }, k) => {
    const y = k * lineHeight;
    const length = value > 0 ? (room * (Math.log10(value) - low)) / (high - low) : 0;
    return `<text x="${labels - 8}" y="${y + 16}" text-anchor="end">${htmlText(name)}</text>
<rect x="${labels}" y="${y + 4}" width="${length.toFixed(1)}" height="${lineHeight - 8}" fill="var(--c0)"/>
<text x="${(labels + length + 6).toFixed(1)}" y="${y + 16}">${time(value)}</text>`;
  });
  return svg(bars.length * lineHeight + 4, title, rows.join('\n')) + `<p class="legend">${htmlText(title)}</p>`;
}

export interface Line {
  name: string;
  points: readonly { x: number; y: number }[];
}

/** Lines over a common axis from zero upward; the horizontal axis may be logarithmic. */
export function linePlot(lines: readonly Line[], axes: { x: string; y: string; logX?: boolean }): string {
  const height = 300;
  const [left, right, top, bottom] = [70, 10, 10, 40];
  const place = axes.logX ? Math.log2 : (value: number) => value;
  const all = lines.flatMap(({ points }) => points);
  const xs = all.map(({ x }) => place(x));
  const from = Math.min(...xs);
  const to = Math.max(...xs, from + 1e-9);
  // What is far above the rest would press the rest flat: the axis ends at ten times the least, and lines go out of it.
  const least = Math.min(...all.map(({ y }) => y));
  const most = Math.max(...all.map(({ y }) => y));
  const ceiling = 1.05 * (axes.logX ? Math.min(most, 10 * least) : most) || 1;
  const across = (x: number) => (left + ((place(x) - from) / (to - from)) * (width - left - right)).toFixed(1);
  const up = (y: number) => (top + (1 - Math.min(1, y / ceiling)) * (height - top - bottom)).toFixed(1);
  const grid = ticks(ceiling).map(
    (y) => `<line class="axis" x1="${left}" x2="${width - right}" y1="${up(y)}" y2="${up(y)}"/>
<text x="${left - 8}" y="${Number(up(y)) + 4}" text-anchor="end">${number(y)}</text>`,
  );
  const sortedXs = [...new Set(all.map(({ x }) => x))].sort((a, b) => a - b);
  const every = Math.max(1, Math.ceil(sortedXs.length / 8));
  const marks = sortedXs
    .filter((_, k) => k % every === 0)
    .map((x) => `<text x="${across(x)}" y="${height - bottom + 18}" text-anchor="middle">${number(x)}</text>`);
  const paths = lines.map(({ points }, k) => {
    const path = points.map(({ x, y }, at) => `${at === 0 ? 'M' : 'L'}${across(x)} ${up(y)}`).join('');
    const dot = points.length === 1 ? `<circle cx="${across(points[0].x)}" cy="${up(points[0].y)}" r="3"/>` : '';
    return `<path class="line" stroke="var(--c${k % colours})" d="${path}"/>${dot}`;
  });
  const names = `<text x="${width / 2}" y="${height - 4}" text-anchor="middle">${htmlText(axes.x)}</text>
<text transform="translate(14 ${(height - bottom) / 2}) rotate(-90)" text-anchor="middle">${htmlText(axes.y)}</text>`;
  const legend = lines.map(
    ({ name }, k) => `<li><i style="background:var(--c${k % colours})"></i>${htmlText(name)}</li>`,
  );
  const title = `${axes.y} over ${axes.x}`;
  return `${svg(height, title, [...grid, ...marks, ...paths, names].join('\n'))}<ul class="legend">${legend.join('')}</ul>`;
}

/** Four or five round numbers from 0 up to the ceiling. */
function ticks(ceiling: number): number[] {
  const rough = ceiling / 4;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 2.5, 5, 10].map((factor) => factor * power).find((each) => each >= rough)!;
  return Array.from({ length: Math.floor(ceiling / step) + 1 }, (_, k) => k * step);
}

const svg = (height: number, title: string, content: string) =>
  `<div class="wide"><svg viewBox="0 0 ${width} ${height}" role="img" aria-label="${htmlText(title)}">${content}</svg></div>`;

/** Text in HTML. */
export const htmlText = (text: string): string =>
  text.replace(/[&<>"']/g, (character) => `&#${character.charCodeAt(0)};`);
