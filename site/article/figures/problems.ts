// Fig. 15: the work of a grid against its cell size. Boxes of one size make a valley; giants among them fill it up.
import { ro } from 'broadphase/ro';
import { demoColumns } from '../demo.ts';
import { countWork, place } from '../demos/cells.ts';
import source from '../demos/cells.ts?raw';
import { mixedSizes } from '../demos/mixed-sizes.ts';
import {
  counters,
  createView,
  dot,
  excerpt,
  levelLine,
  listing,
  type Sheet,
  sayer,
  slider,
  text,
} from '../kit/index.ts';

const boxes = 160;
const mostGiants = 16;
const sizes: number[] = [];
for (let size = 3; size <= 400; size = Math.max(size + 1, Math.round(size * 1.2))) sizes.push(size);
/** The work at the top of the plot. */
const most = 300_000;
const least = 100;

interface Measured {
  giants: number;
  /** By the grid, for each cell size. */
  work: number[];
  /** The index of the cell size with the least work. */
  best: number;
  /** By brute force. */
  brute: number;
}

/** The work for a crowd with this number of giants. */
function measure(giants: number): Measured {
  const crowd = mixedSizes(boxes, giants);
  const grid = place(new ro.coltech.SpatialGrid(0, 0, 480, 300, sizes[0]), crowd);
  const work = sizes.map((size) => {
    grid.cellSize = size;
    return countWork(grid).work;
  });
  const bruteForce = place(new ro.coltech.BruteForce(), crowd);
  bruteForce.queryForCollisionPairs();
  return { giants, work, best: work.indexOf(Math.min(...work)), brute: bruteForce.collisionTests };
}

export function mount(root: HTMLElement): void {
  let measured = measure(0);

  const [left, right] = demoColumns(root);
  const view = createView(left, {
    label: 'A plot of work against cell size.',
    height: (width) => Math.min(320, Math.max(240, width * 0.72)),
    draw: (sheet) => draw(sheet, measured),
  });
  slider(left, {
    label: 'Giants among 160 boxes',
    min: 0,
    max: mostGiants,
    value: 0,
    moved(giants) {
      measured = measure(giants);
      show();
    },
  });
  const write = counters(right, { least: 'Least work', size: 'At a cell size of', brute: 'By brute force' });
  const say = sayer(right);
  listing(right, 'site/article/demos/cells.ts', excerpt(source, 'export function countWork'));
  show();

  function show(): void {
    const { giants, work, best, brute } = measured;
    const good = sizes.filter((_, i) => work[i] < brute / 4);
    write({ least: work[best], size: sizes[best], brute });
    const range =
      good.length > 0
        ? `Cells from ${good[0]} to ${good[good.length - 1]} take less than a quarter of the work of brute force.`
        : 'No cell size takes less than a quarter of the work of brute force.';
    say(range);
    view.describe(
      `A plot of work against cell size, for ${boxes} boxes of which ${giants} are giants. The least work, ` +
        `${work[best].toLocaleString('en')}, is at ${sizes[best]}; brute force takes ${brute.toLocaleString('en')}. ${range}`,
    );
    view.redraw();
  }
}

/** The work against the cell size, both on logarithmic scales; the work of brute force is dashed. */
function draw(sheet: Sheet, { work, best, brute }: Measured): void {
  const { ctx, width, height, colors } = sheet;
  const [start, end, top, bottom] = [46, width - 12, 14, height - 42];
  const x = (size: number) =>
    start + ((end - start) * Math.log(size / sizes[0])) / Math.log(sizes[sizes.length - 1] / sizes[0]);
  const y = (value: number) => bottom - ((bottom - top) * Math.log(value / least)) / Math.log(most / least);

  for (let value = least; value <= most; value *= 10) {
    const label = value < 1000 ? String(value) : `${value / 1000}k`;
    levelLine(sheet, [start, end], y(value), label);
  }
  for (const size of [3, 10, 30, 100, 300]) text(ctx, String(size), x(size), bottom + 14, colors.muted);
  text(ctx, 'cell size', (start + end) / 2, bottom + 32, colors.muted);

  ctx.strokeStyle = colors.muted;
  ctx.setLineDash([5, 4]);
  ctx.lineWidth = 1.5;
  ctx.beginPath();
  ctx.moveTo(start, y(brute));
  ctx.lineTo(end, y(brute));
  ctx.stroke();
  ctx.setLineDash([]);
  text(ctx, 'brute force', end, y(brute) - 11, colors.muted, 'right');

  ctx.strokeStyle = colors.accent;
  ctx.lineWidth = 2.5;
  ctx.lineJoin = 'round';
  ctx.beginPath();
  sizes.forEach((size, i) => {
    ctx.lineTo(x(size), y(work[i]));
  });
  ctx.stroke();
  dot(ctx, x(sizes[best]), y(work[best]), 5, colors.now);
  text(ctx, `least at ${sizes[best]}`, x(sizes[best]), y(work[best]) + 16, colors.now);
}
