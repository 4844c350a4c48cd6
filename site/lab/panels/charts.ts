// Live charts of the last frames, by uPlot: milliseconds, tests, pairs, memory. Numbers are kept in rings of fixed
// size; the charts are drawn a few times a second, not in each frame.
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { heapSize } from '../../shared/heap.ts';
import type { Picture } from '../worker/messages.ts';

const kept = 240;
const height = 84;
const axisWidth = 46;
const MB = 1e6;

interface Chart {
  title: string;
  /** The numbers of a picture that are drawn, and how they are formatted. */
  lines: readonly ((picture: Picture) => number | undefined)[];
  write(value: number): string;
}

const compact = new Intl.NumberFormat('en', { notation: 'compact', maximumSignificantDigits: 3 });
const digits = new Intl.NumberFormat('en', { maximumSignificantDigits: 3 });

const shown: readonly Chart[] = [
  { title: 'Milliseconds', lines: [({ ms }) => (Number.isNaN(ms) ? undefined : ms)], write: (ms) => digits.format(ms) },
  { title: 'Tests', lines: [({ stats }) => stats.tests], write: (tests) => compact.format(tests) },
  { title: 'Pairs', lines: [({ stats }) => stats.pairs], write: (pairs) => compact.format(pairs) },
  {
    title: 'Kernel and heap, MB',
    lines: [({ stats }) => stats.bytes / MB, ({ heap }) => (heap ?? heapSize() ?? Number.NaN) / MB],
    write: (bytes) => digits.format(bytes),
  },
];

/** The axes, strokes and sizes that all charts of the lab share. Colours are read when they are used. */
export function chartOptions(root: HTMLElement, write: (value: number) => string): Omit<uPlot.Options, 'series'> {
  const style = getComputedStyle(root);
  const color = (name: string) => () => style.getPropertyValue(name).trim();
  const axis = {
    stroke: color('--muted'),
    grid: { stroke: color('--line'), width: 1 },
    ticks: { show: false },
    font: '11px system-ui, sans-serif',
  };
  return {
    width: 200,
    height,
    legend: { show: false },
    cursor: { show: false },
    padding: [8, 14, 6, 0],
    axes: [
      { ...axis, show: false },
      {
        ...axis,
        size: axisWidth,
        space: 28,
        values: (_, ticks) => ticks.map((tick) => (tick === null ? '' : write(tick))),
      },
    ],
  };
}

/** Makes a chart as wide as there is room, and draws it again when the colours change. */
export function fitChart(plot: uPlot, root: HTMLElement): void {
  new ResizeObserver(() => {
    const width = Math.floor(root.clientWidth);
    if (width > 0 && width !== plot.width) plot.setSize({ width, height: plot.height });
  }).observe(root);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => plot.redraw(false, true));
}

/** A frame in which the machine was busy elsewhere would dwarf all others: values above this quantile are cut off. */
const usual = 0.97;
const headroom = 1.3;

function top(lines: readonly Float64Array[]): number {
  let most = 0;
  for (const line of lines) {
    const sorted = line.filter(Number.isFinite).sort();
    most = Math.max(most, sorted[Math.floor(usual * (sorted.length - 1))] ?? 0);
  }
  return most > 0 ? headroom * most : 1;
}

export interface Charts {
  add(picture: Picture): void;
  draw(): void;
  clear(): void;
}

export function createCharts(root: HTMLElement): Charts {
  const color = (name: string) => () => getComputedStyle(root).getPropertyValue(name).trim();
  const strokes = [color('--accent'), color('--muted')];
  const at = Float64Array.from({ length: kept }, (_, k) => k - kept + 1);
  let count = 0;
  /** How many frames are drawn. */
  let length = 0;
  const charts = shown.map(({ title, lines, write }) => {
    const place = document.createElement('div');
    place.className = 'chart';
    place.innerHTML = '<h2><span></span><b class="reading"></b></h2>';
    place.querySelector('span')!.textContent = title;
    root.append(place);
    const rings = lines.map(() => new Float64Array(kept));
    const values = lines.map(() => new Float64Array(kept));
    const plot = new uPlot(
      {
        ...chartOptions(root, write),
        scales: {
          x: { time: false },
          y: { range: () => [0, top(values.map((each) => each.subarray(kept - length)))] },
        },
        series: [{}, ...lines.map((_, k) => ({ stroke: strokes[k], width: 1.5, points: { show: false } }))],
      },
      [at.subarray(kept), ...values.map((each) => each.subarray(kept))],
      place,
    );
    fitChart(plot, place);
    return { lines, write, rings, values, plot, text: place.querySelector('b')! };
  });
  return {
    add(picture) {
      for (const { lines, rings } of charts) {
        lines.forEach((line, k) => {
          rings[k][count % kept] = line(picture) ?? rings[k][(count + kept - 1) % kept];
        });
      }
      count++;
    },
    draw() {
      length = Math.min(count, kept);
      const begin = count - length;
      for (const { rings, values, plot, write, text } of charts) {
        rings.forEach((ring, k) => {
          for (let i = 0; i < length; i++) values[k][kept - length + i] = ring[(begin + i) % kept];
        });
        plot.setData([at.subarray(kept - length), ...values.map((each) => each.subarray(kept - length))]);
        const last = values.map((each) => each[kept - 1]).filter((value) => !Number.isNaN(value));
        const written = length > 0 ? last.map(write).join(' and ') : '–';
        if (text.textContent !== written) text.textContent = written;
      }
    },
    clear() {
      count = 0;
    },
  };
}
