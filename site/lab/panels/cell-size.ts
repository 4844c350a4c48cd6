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

/** Costs by the step of the slider, measured one at a time. */
class Measurements {
  costs = new Map<number, Cost>();
  readonly #measure: (step: number) => Promise<Cost>;
  readonly #changed: () => void;
  #queue: number[] = [];
  #measuring = false;

  constructor(measure: (step: number) => Promise<Cost>, changed: () => void) {
    this.#measure = measure;
    this.#changed = changed;
  }

  /** Forgets all, and what is being measured too. */
  clear(): void {
    this.#queue = [];
    this.costs = new Map();
  }

  /** Measures what is not known yet. */
  add(steps: readonly number[]): void {
    this.#queue.push(...steps.filter((step) => !this.costs.has(step) && !this.#queue.includes(step)));
    if (!this.#measuring) void this.#work();
  }

  async #work(): Promise<void> {
    this.#measuring = true;
    while (this.#queue.length > 0) {
      const step = this.#queue.shift()!;
      const { costs } = this;
      const cost = await this.#measure(step).catch(() => undefined);
      if (!cost || costs !== this.costs) continue;
      costs.set(step, cost);
      this.#changed();
    }
    this.#measuring = false;
  }
}

/**
 * Makes the curve: milliseconds by cell size, both logarithmic, with a line at the size that is chosen. Returns what
 * draws it.
 */
function createCurve(
  root: HTMLElement,
  steps: readonly number[],
  sizeAt: (step: number) => number,
  chosen: () => number | undefined,
): (costs: ReadonlyMap<number, Cost>) => void {
  const color = (name: string) => () => getComputedStyle(root).getPropertyValue(name).trim();
  const options = chartOptions(root, (ms) => digits.format(ms));
  const place = root.querySelector<HTMLElement>('#curve')!;
  place.setAttribute('role', 'img');
  const plot = new uPlot(
    {
      ...options,
      height,
      axes: [
        {
          ...options.axes![1],
          size: 24,
          splits: () => steps.filter((_, k) => k % labelled === 0).map(sizeAt),
          filter: (_, splits) => splits,
          values: (_, splits) => splits.map((size) => digits.format(size)),
        },
        { ...options.axes![1], splits: (_, __, low, high) => roundNumbers(low, high), filter: (_, splits) => splits },
      ],
      scales: {
        x: { time: false, distr: 3, range: () => [sizeAt(steps[0]), sizeAt(steps.at(-1)!)] },
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
            const size = chosen();
            if (size === undefined) return;
            ctx.fillStyle = color('--text')();
            ctx.fillRect(Math.round(valToPos(size, 'x', true)), bbox.top, Math.max(1, devicePixelRatio), bbox.height);
          },
        ],
      },
    },
    [[], []],
    place,
  );
  fitChart(plot, place);
  return (costs) => {
    plot.setData([steps.map(sizeAt), steps.map((step) => costs.get(step)?.ms ?? null)]);
    place.setAttribute('aria-label', describe(costs));
  };
}

/** The curve in words. */
function describe(costs: ReadonlyMap<number, Cost>): string {
  const best = [...costs.values()].sort((a, b) => a.ms - b.ms)[0];
  if (!best) return 'Milliseconds by cell size: nothing measured yet.';
  return `Milliseconds by cell size: ${costs.size} sizes measured, the best is ${best.cellSize}.`;
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
  const [first, last] = [Number(slider.min), Number(slider.max)];
  const steps = Array.from({ length: last - first + 1 }, (_, k) => first + k);
  let typical = 1;
  let before = slider.valueAsNumber;

  const sizeAt = (step: number) => Number((typical * 2 ** (step / stepsPerDoubling)).toPrecision(3));
  const chosen = () => (byLibrary.checked ? undefined : sizeAt(slider.valueAsNumber));
  const drawCurve = createCurve(root, steps, sizeAt, chosen);
  const draw = () => {
    drawCurve(measured.costs);
    const step = slider.valueAsNumber;
    const known = measured.costs.get(step);
    text.textContent = byLibrary.checked
      ? `Typical box: ${digits.format(typical)} wide`
      : `${sizeAt(step)}${known ? `: ${digits.format(known.ms)} ms` : ''}`;
    slider.style.setProperty('--filled', `${(100 * (step - first)) / (last - first)}%`);
    slider.setAttribute('aria-valuetext', `${sizeAt(step)}`);
  };
  const measured = new Measurements((step) => measure(sizeAt(step)), draw);

  slider.addEventListener('input', () => {
    const now = slider.valueAsNumber;
    byLibrary.checked = false;
    const way = Math.sign(now - before) || 1;
    const passed = Array.from({ length: Math.abs(now - before) + 1 }, (_, k) => now - way * k);
    before = now;
    draw();
    changed(sizeAt(now));
    measured.add(passed);
  });
  byLibrary.addEventListener('change', () => {
    draw();
    changed(chosen());
    if (!byLibrary.checked) measured.add([slider.valueAsNumber]);
  });
  find('#whole-curve').addEventListener('click', () => measured.add(steps));

  return {
    begin(sizes, cell) {
      measured.clear();
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
