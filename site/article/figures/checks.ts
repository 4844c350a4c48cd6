// Fig. 1: comparisons against the number of boxes, for brute force, the grid and the library, counted by running them.
import { coltech, Entity, World } from 'broadphase/ro';
import { createRandom } from '../../../src/scenes/random.ts';
import { choice, createView, dot, element, levelLine, row, type Sheet, slider, text } from '../kit/index.ts';

/** Boxes between two points of the plot. */
const interval = 100;
const most = 3000;
const side = 10;
/** A cell of the grid: a little larger than a box. */
const cellSize = 15;
/** The world's area per box, so that a crowd of any size has the same density. */
const roomEach = 500;
/** Milliseconds of counting before the page gets a turn. */
const patience = 12;

const series = [
  { key: 'brute', name: 'Brute force', color: 'now', dash: [] },
  { key: 'grid', name: 'Grid', color: 'accent', dash: [] },
  { key: 'library', name: 'Library', color: 'text', dash: [5, 4] },
] as const;
type Key = (typeof series)[number]['key'];
type Scale = 'even' | 'tenfold';
type Counts = Readonly<Record<Key, number>> & { readonly pairs: number };

type Point = readonly [boxes: number, counts: Counts];

/** Runs the three on the same boxes, and counts the tests of one box against another in each. */
function countChecks(boxes: number): Counts {
  const extent = Math.sqrt(boxes * roomEach) + side;
  const run = <T extends coltech.EntityList<Entity>>(technique: T) => {
    const world = new World(null, { coltech: technique });
    const random = createRandom(boxes);
    for (let i = 0; i < boxes; i++) {
      world.addEntity(new Entity(random() * (extent - side), random() * (extent - side), side, side));
    }
    technique.update();
    const pairs = technique.queryForCollisionPairs().length;
    return { tests: technique.collisionTests, pairs };
  };
  const brute = run(new coltech.BruteForce());
  const library = new coltech.BroadPhase();
  const { tests } = run(library);
  library.space.dispose();
  return {
    brute: brute.tests,
    grid: run(new coltech.SpatialGrid(0, 0, extent, extent, cellSize)).tests,
    library: tests,
    pairs: brute.pairs,
  };
}

/** 1, 2 or 5 times a power of ten: about `parts` of them make `range`. */
function niceStep(range: number, parts: number): number {
  const rough = range / parts;
  const power = 10 ** Math.floor(Math.log10(rough));
  return ([1, 2, 5, 10].find((factor) => factor * power >= rough) ?? 10) * power;
}

const short = new Intl.NumberFormat('en', { notation: 'compact', maximumFractionDigits: 1 });
const whole = new Intl.NumberFormat('en');

const scales: readonly (readonly [Scale, string])[] = [
  ['even', 'even'],
  ['tenfold', '×10'],
];
const margins = { left: 46, right: 14, top: 16, bottom: 30 };

export function mount(root: HTMLElement): void {
  const counting = new Counting();
  let boxes = 1000;
  let scale: Scale = 'even';
  /** The number of boxes that the pointer or the arrow keys point at. */
  let pointed: number | undefined;

  const view = createView(root, {
    label: 'A plot of comparisons against boxes.',
    height: (width) => Math.min(400, Math.max(260, width * 0.46)),
    draw(sheet) {
      const axes = axesOf(sheet, boxes, scale);
      drawScales(sheet, axes);
      drawCurves(sheet, axes, counting.points(boxes));
      mark(sheet, axes, shownPoint());
    },
  });
  const legend = element('table', { class: 'plot-legend' });
  root.append(legend);
  const tools = row(root);
  slider(tools, {
    label: 'Boxes',
    min: interval,
    max: most,
    step: interval,
    value: boxes,
    format: (value) => whole.format(value),
    moved(value) {
      boxes = value;
      pointed = undefined;
      counting.upTo(boxes, report);
    },
  });
  choice<Scale>(tools, 'Scale', scales, scale, (value) => {
    scale = value;
    report();
  });

  /** The point shown in the numbers below the plot: the one pointed at, or else the last. */
  const shownPoint = (): Point => {
    const all = counting.points(boxes);
    return all.find(([n]) => n === pointed) ?? all[all.length - 1];
  };

  const report = () => {
    const [n, counts] = shownPoint();
    legend.replaceChildren(...legendParts(n, counts));
    view.describe(inWords(n, counts));
    view.redraw();
  };

  const pointAt = (boxes: number | undefined) => {
    pointed = boxes;
    report();
  };
  point(view.canvas, {
    at(x) {
      const share = (x - margins.left) / (view.width - margins.left - margins.right);
      pointAt(Math.round((share * boxes) / interval) * interval);
    },
    on: (way) => pointAt(Math.min(Math.max(shownPoint()[0] + way * interval, 0), boxes)),
    away: () => pointAt(undefined),
  });

  counting.upTo(boxes, report);
}

/** The points of the plot, counted when they are needed. */
class Counting {
  readonly #counted = new Map<number, Counts>([[0, { brute: 0, grid: 0, library: 0, pairs: 0 }]]);
  #timer = 0;

  /** Those up to this number of boxes, as far as they have been counted. */
  points(boxes: number): Point[] {
    return [...this.#counted].filter(([n]) => n <= boxes).sort(([a], [b]) => a - b);
  }

  /** Counts the missing ones up to this number of boxes, a few at a time, and tells after each few; out of sight, too. */
  upTo(boxes: number, tell: () => void): void {
    clearTimeout(this.#timer);
    const started = performance.now();
    for (let n = interval; n <= boxes; n += interval) {
      if (this.#counted.has(n)) continue;
      this.#counted.set(n, countChecks(n));
      if (performance.now() - started > patience) {
        this.#timer = window.setTimeout(() => this.upTo(boxes, tell));
        break;
      }
    }
    tell();
  }
}

/** Lets the reader point into the plot: at a place by mouse, pen or finger, or one point on by the arrow keys. */
function point(
  canvas: HTMLCanvasElement,
  { at, on, away }: { at(x: number): void; on(way: 1 | -1): void; away(): void },
): void {
  canvas.tabIndex = 0;
  canvas.addEventListener('pointermove', ({ offsetX }) => at(offsetX));
  canvas.addEventListener('pointerleave', away);
  canvas.addEventListener('keydown', (event) => {
    if (event.key !== 'ArrowRight' && event.key !== 'ArrowLeft') return;
    event.preventDefault();
    on(event.key === 'ArrowRight' ? 1 : -1);
  });
}

/** The head and the body of the table of numbers below the plot. */
function legendParts(boxes: number, counts: Counts): HTMLElement[] {
  const heads = ['Boxes', ...series.map(({ name }) => name), 'Pairs'];
  const cells = [boxes, ...series.map(({ key }) => counts[key]), counts.pairs];
  const head = element('tr');
  const body = element('tr');
  heads.forEach((name, i) => {
    const swatch = series[i - 1] ? [element('i', { class: `swatch ${series[i - 1].key}` })] : [];
    head.append(element('th', { scope: 'col' }, ...swatch, name));
    body.append(element('td', {}, whole.format(cells[i])));
  });
  return [element('thead', {}, head), element('tbody', {}, body)];
}

const inWords = (boxes: number, { brute, grid, library }: Counts) =>
  `Comparisons for ${whole.format(boxes)} boxes: brute force ${whole.format(brute)}, ` +
  `grid ${whole.format(grid)}, library ${whole.format(library)}. ` +
  'Left and right arrow keys choose another number of boxes.';

type Axes = ReturnType<typeof axesOf>;

/** Where numbers of boxes and of comparisons are on a sheet. */
function axesOf({ width, height }: Sheet, boxes: number, scale: Scale) {
  const { left, top } = margins;
  const right = width - margins.right;
  const bottom = height - margins.bottom;
  const highest = (boxes * (boxes - 1)) / 2;
  const logTop = Math.log10(highest);
  const share = (checks: number) => (scale === 'even' ? checks / highest : Math.log10(Math.max(1, checks)) / logTop);
  const x = (n: number) => left + (n / boxes) * (right - left);
  const y = (checks: number) => top + (1 - share(checks)) * (bottom - top);
  return { left, right, top, bottom, boxes, scale, highest, x, y };
}

function drawScales(sheet: Sheet, axes: Axes): void {
  const { ctx, colors } = sheet;
  const { left, right, top, bottom, boxes, scale, highest } = axes;
  const level = (checks: number) => levelLine(sheet, [left, right], axes.y(checks), short.format(checks), colors.line);
  if (scale === 'even') {
    const step = niceStep(highest, 5);
    for (let tick = 0; tick <= highest; tick += step) level(tick);
  } else for (let tick = 1; tick <= highest; tick *= 10) level(tick);
  const step = niceStep(boxes, Math.min(6, (right - left) / 70));
  for (let tick = 0; tick <= boxes; tick += step) {
    text(ctx, whole.format(tick), axes.x(tick), bottom + 16, colors.muted, tick === boxes ? 'right' : 'center');
  }
  text(ctx, 'comparisons', left + 8, top + 4, colors.muted, 'left');
}

function drawCurves({ ctx, colors }: Sheet, axes: Axes, points: readonly Point[]): void {
  ctx.lineWidth = 2.5;
  ctx.lineJoin = 'round';
  for (const { key, color, dash } of series) {
    ctx.strokeStyle = colors[color];
    ctx.setLineDash([...dash]);
    ctx.beginPath();
    for (const [n, counts] of points) {
      if (axes.scale === 'tenfold' && n === 0) continue;
      ctx.lineTo(axes.x(n), axes.y(counts[key]));
    }
    ctx.stroke();
  }
  ctx.setLineDash([]);
}

/** A line through a point, with a dot on each curve. */
function mark({ ctx, colors }: Sheet, axes: Axes, [boxes, counts]: Point): void {
  const x = axes.x(boxes);
  ctx.strokeStyle = colors.muted;
  ctx.lineWidth = 1;
  ctx.beginPath();
  ctx.moveTo(Math.round(x) - 0.5, axes.top);
  ctx.lineTo(Math.round(x) - 0.5, axes.bottom);
  ctx.stroke();
  for (const { key, color } of series) dot(ctx, x, axes.y(counts[key]), 4.5, colors[color]);
}
