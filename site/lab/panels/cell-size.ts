// The cell size: a slider over doublings of the typical box, and a curve of the cost of each size, which is measured
// and drawn as the slider is dragged over it.
import uPlot from 'uplot';
import type { CellSizes, Cost } from '../worker/messages.ts';
import { chartOptions, fitChart } from './charts.ts';

/** Steps of the slider per doubling. It reaches from a quarter of the typical box to 256 times its size. */
const stepsPerDoubling = 4;
/** Steps from one label of the curve to the next. */
const labelled = 8;
const height = 130;

export interface CellSizeControl {
  /** Clears the curve, for another scene or technique. */
  begin(sizes: CellSizes, cell: number | undefined): void;
}

const digits = new Intl.NumberFormat('en', { maximumSignificantDigits: 3 });

/** 1, 2 and 5 times the powers of ten that lie in a range above 0. */
function roundNumbers(low: number, high: number): number[] {
  const numbers: number[] = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); power++) {
    for (const digit of [1, 2, 5]) numbers.push(digit * 10 ** power);
  }
  return numbers.filter((number) => number >= low && number <= high);
}

/**
 * @param changed called when a size was chosen; undefined means that the library chooses
 * @param measure measures one size
 */
export function createCellSize(
  root: HTMLElement,
  changed: (cell: number | undefined) => void,
  measure: (cell: number) => Promise<Cost>,
): CellSizeControl {
  const find = <T extends HTMLElement>(selector: string) => root.querySelector<T>(selector)!;
  const slider = find<HTMLInputElement>('#cell');
  const byLibrary = find<HTMLInputElement>('#cell-auto');
  const text = find('#cell-text');
  const whole = find<HTMLButtonElement>('#whole-curve');
  const place = find('#curve');
  const [first, last] = [Number(slider.min), Number(slider.max)];
  const count = last - first + 1;
  let typical = 1;
  let costs = new Map<number, Cost>();
  let queue: number[] = [];
  let measuring = false;
  let turn = 0;
  let before = slider.valueAsNumber;

  const sizeAt = (step: number) => Number((typical * 2 ** (step / stepsPerDoubling)).toPrecision(3));
  const color = (name: string) => () => getComputedStyle(root).getPropertyValue(name).trim();
  const options = chartOptions(root, (ms) => digits.format(ms));
  const plot = new uPlot(
    {
      ...options,
      height,
      axes: [
        {
          ...options.axes![1],
          size: 24,
          splits: () => Array.from({ length: (last - first) / labelled + 1 }, (_, k) => sizeAt(first + k * labelled)),
          filter: (_, splits) => splits,
          values: (_, splits) => splits.map((size) => digits.format(size)),
        },
        { ...options.axes![1], splits: (_, __, low, high) => roundNumbers(low, high), filter: (_, splits) => splits },
      ],
      scales: {
        x: { time: false, distr: 3, range: () => [sizeAt(first), sizeAt(last)] },
        y: { distr: 3, range: (_, low, high) => [(low || 0.01) / 1.3, (high || 1) * 1.3] },
      },
      series: [
        {},
        {
          stroke: color('--accent'),
          width: 2,
          spanGaps: true,
          points: { show: true, size: 5, fill: color('--accent') },
        },
      ],
      hooks: {
        draw: [
          ({ ctx, bbox, valToPos }) => {
            if (byLibrary.checked) return;
            const x = Math.round(valToPos(sizeAt(slider.valueAsNumber), 'x', true));
            ctx.fillStyle = color('--text')();
            ctx.fillRect(x, bbox.top, Math.max(1, devicePixelRatio), bbox.height);
          },
        ],
      },
    },
    [[], []],
    place,
  );
  fitChart(plot, place);

  const draw = () => {
    const steps = Array.from({ length: count }, (_, k) => first + k);
    plot.setData([steps.map(sizeAt), steps.map((step) => costs.get(step)?.ms ?? null)]);
    const step = slider.valueAsNumber;
    const known = costs.get(step);
    text.textContent = byLibrary.checked
      ? `Typical box: ${digits.format(typical)} wide`
      : `${sizeAt(step)}${known ? `: ${digits.format(known.ms)} ms` : ''}`;
    slider.style.setProperty('--filled', `${(100 * (step - first)) / (last - first)}%`);
    slider.setAttribute('aria-valuetext', `${sizeAt(step)}`);
    place.setAttribute('role', 'img');
    const best = [...costs.values()].sort((a, b) => a.ms - b.ms)[0];
    place.setAttribute(
      'aria-label',
      best
        ? `Milliseconds by cell size: ${costs.size} sizes measured, the best is ${best.cellSize}.`
        : 'Milliseconds by cell size: nothing measured yet.',
    );
  };

  /** Measures what is in the queue, one size at a time. */
  const work = async () => {
    if (measuring) return;
    measuring = true;
    while (queue.length > 0) {
      const step = queue.shift()!;
      const begun = turn;
      const cost = await measure(sizeAt(step)).catch(() => undefined);
      if (cost && begun === turn) {
        costs.set(step, cost);
        draw();
      }
    }
    measuring = false;
  };
  const enqueue = (steps: readonly number[]) => {
    queue.push(...steps.filter((step) => !costs.has(step) && !queue.includes(step)));
    void work();
  };

  slider.addEventListener('input', () => {
    const now = slider.valueAsNumber;
    byLibrary.checked = false;
    const way = Math.sign(now - before) || 1;
    const passed = Array.from({ length: Math.abs(now - before) + 1 }, (_, k) => now - way * k);
    before = now;
    draw();
    changed(sizeAt(now));
    enqueue(passed);
  });
  byLibrary.addEventListener('change', () => {
    draw();
    changed(byLibrary.checked ? undefined : sizeAt(slider.valueAsNumber));
    if (!byLibrary.checked) enqueue([slider.valueAsNumber]);
  });
  whole.addEventListener('click', () => enqueue(Array.from({ length: count }, (_, k) => first + k)));

  return {
    begin(sizes, cell) {
      turn++;
      queue = [];
      costs = new Map();
      typical = sizes.typical;
      root.hidden = !sizes.heeded;
      byLibrary.checked = cell === undefined;
      if (cell !== undefined) {
        const step = Math.round(stepsPerDoubling * Math.log2(cell / typical));
        slider.valueAsNumber = Math.min(last, Math.max(first, step));
        before = slider.valueAsNumber;
      }
      draw();
    },
  };
}
