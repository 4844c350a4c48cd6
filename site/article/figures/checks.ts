// Fig. 1: comparisons against the number of boxes, for brute force, the grid and the library, counted by running them.
import { coltech, Entity, World } from 'broadphase/ro';
import { createRandom } from '../../../src/scenes/random.ts';
import { type Colors, choice, createView, element, row, slider, text } from '../kit/index.ts';

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
type Counts = Readonly<Record<Key, number>> & { readonly pairs: number };

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

export function mount(root: HTMLElement): () => void {
  const counted = new Map<number, Counts>([[0, { brute: 0, grid: 0, library: 0, pairs: 0 }]]);
  let boxes = 1000;
  let scale = 'even' as 'even' | 'tenfold';
  /** The number of boxes that the pointer or the arrow keys point at. */
  let pointed: number | undefined;
  let timer = 0;

  const margins = { left: 46, right: 14, top: 16, bottom: 30 };
  const points = () => [...counted].filter(([n]) => n <= boxes).sort(([a], [b]) => a - b);

  const view = createView(root, {
    label: 'A plot of comparisons against boxes.',
    height: (width) => Math.min(400, Math.max(260, width * 0.46)),
    draw: (ctx, width, height, colors) => plot(ctx, width, height, colors),
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
      count();
      report();
    },
  });
  choice<typeof scale>(
    tools,
    'Scale',
    [
      ['even', 'even'],
      ['tenfold', '×10'],
    ],
    scale,
    (value) => {
      scale = value;
      report();
    },
  );

  function plot(ctx: CanvasRenderingContext2D, width: number, height: number, colors: Colors): void {
    const { left, right, top, bottom } = margins;
    const across = width - left - right;
    const down = height - top - bottom;
    const highest = (boxes * (boxes - 1)) / 2;
    const x = (n: number) => left + (n / boxes) * across;
    const logTop = Math.log10(highest);
    const share = (checks: number) => (scale === 'even' ? checks / highest : Math.log10(Math.max(1, checks)) / logTop);
    const y = (checks: number) => top + (1 - share(checks)) * down;

    ctx.lineWidth = 1;
    const ticks: number[] = [];
    if (scale === 'even') {
      const step = niceStep(highest, 5);
      for (let tick = 0; tick <= highest; tick += step) ticks.push(tick);
    } else for (let tick = 1; tick <= highest; tick *= 10) ticks.push(tick);
    for (const tick of ticks) {
      ctx.strokeStyle = colors.line;
      ctx.beginPath();
      ctx.moveTo(left, Math.round(y(tick)) + 0.5);
      ctx.lineTo(width - right, Math.round(y(tick)) + 0.5);
      ctx.stroke();
      text(ctx, short.format(tick), left - 8, y(tick), colors.muted, 'right');
    }
    const step = niceStep(boxes, Math.min(6, across / 70));
    for (let tick = 0; tick <= boxes; tick += step) {
      text(ctx, whole.format(tick), x(tick), height - bottom + 16, colors.muted, tick === boxes ? 'right' : 'center');
    }
    text(ctx, 'comparisons', left + 8, top + 4, colors.muted, 'left');

    for (const { key, color, dash } of series) {
      ctx.strokeStyle = colors[color];
      ctx.lineWidth = 2.5;
      ctx.setLineDash([...dash]);
      ctx.lineJoin = 'round';
      ctx.beginPath();
      for (const [n, counts] of points()) {
        if (scale === 'tenfold' && n === 0) continue;
        ctx.lineTo(x(n), y(counts[key]));
      }
      ctx.stroke();
      ctx.setLineDash([]);
    }
    const [n, counts] = shownPoint();
    ctx.strokeStyle = colors.muted;
    ctx.lineWidth = 1;
    ctx.beginPath();
    ctx.moveTo(Math.round(x(n)) - 0.5, top);
    ctx.lineTo(Math.round(x(n)) - 0.5, top + down);
    ctx.stroke();
    for (const { key, color } of series) {
      ctx.fillStyle = colors[color];
      ctx.beginPath();
      ctx.arc(x(n), y(counts[key]), 4.5, 0, 7);
      ctx.fill();
    }
  }

  /** The point shown in the numbers below the plot: the one pointed at, or else the last. */
  const shownPoint = (): readonly [number, Counts] => {
    const all = points();
    return all.find(([n]) => n === pointed) ?? all[all.length - 1];
  };

  /** Counts the missing points, a few at a time. */
  const count = () => {
    clearTimeout(timer);
    const started = performance.now();
    for (let n = interval; n <= boxes; n += interval) {
      if (counted.has(n)) continue;
      counted.set(n, countChecks(n));
      if (performance.now() - started > patience) {
        timer = window.setTimeout(count);
        break;
      }
    }
    report();
  };

  const report = () => {
    const [n, counts] = shownPoint();
    const heads = ['Boxes', ...series.map(({ name }) => name), 'Pairs'];
    const cells = [n, ...series.map(({ key }) => counts[key]), counts.pairs];
    const head = element('tr');
    const body = element('tr');
    heads.forEach((name, i) => {
      const swatch = series[i - 1] ? [element('i', { class: `swatch ${series[i - 1].key}` })] : [];
      head.append(element('th', { scope: 'col' }, ...swatch, name));
      body.append(element('td', {}, whole.format(cells[i])));
    });
    legend.replaceChildren(element('thead', {}, head), element('tbody', {}, body));
    view.describe(
      `Comparisons for ${whole.format(n)} boxes: brute force ${whole.format(counts.brute)}, ` +
        `grid ${whole.format(counts.grid)}, library ${whole.format(counts.library)}. ` +
        `Left and right arrow keys choose another number of boxes.`,
    );
    view.redraw();
  };

  const { canvas } = view;
  canvas.tabIndex = 0;
  canvas.addEventListener('pointermove', (event) => {
    const share = (event.offsetX - margins.left) / (view.width - margins.left - margins.right);
    pointed = Math.round((share * boxes) / interval) * interval;
    report();
  });
  canvas.addEventListener('pointerleave', () => {
    pointed = undefined;
    report();
  });
  canvas.addEventListener('keydown', (event) => {
    const way = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
    if (way === 0) return;
    event.preventDefault();
    pointed = Math.min(Math.max(shownPoint()[0] + way * interval, 0), boxes);
    report();
  });

  count();
  return () => clearTimeout(timer);
}
