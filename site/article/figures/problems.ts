// Fig. 15: the work of a grid against its cell size. Boxes of one size make a valley; giants among them fill it up.
import { ro } from 'broadphase/ro';
import { demoColumns } from '../demo.ts';
import { countWork, place } from '../demos/cells.ts';
import source from '../demos/cells.ts?raw';
import { mixedSizes } from '../demos/mixed-sizes.ts';
import { text } from '../kit/drawing.ts';
import { counters, createView, excerpt, listing, sayer, slider } from '../kit/index.ts';

const boxes = 160;
const mostGiants = 16;
const sizes: number[] = [];
for (let size = 3; size <= 400; size = Math.max(size + 1, Math.round(size * 1.2))) sizes.push(size);
/** The work at the top of the plot. */
const most = 300_000;
const least = 100;

export function mount(root: HTMLElement): void {
  let work: number[] = [];
  let brute = 0;
  let giants = 0;

  const [left, right] = demoColumns(root);
  const view = createView(left, {
    label: 'A plot of work against cell size.',
    height: (width) => Math.min(320, Math.max(240, width * 0.72)),
    draw(ctx, width, height, colors) {
      const [start, end, top, bottom] = [46, width - 12, 14, height - 42];
      const x = (size: number) =>
        start + ((end - start) * Math.log(size / sizes[0])) / Math.log(sizes[sizes.length - 1] / sizes[0]);
      const y = (value: number) => bottom - ((bottom - top) * Math.log(value / least)) / Math.log(most / least);

      ctx.strokeStyle = colors.grid;
      ctx.lineWidth = 1;
      for (let value = least; value <= most; value *= 10) {
        ctx.beginPath();
        ctx.moveTo(start, Math.round(y(value)) + 0.5);
        ctx.lineTo(end, Math.round(y(value)) + 0.5);
        ctx.stroke();
        const label = value < 1000 ? String(value) : `${value / 1000}k`;
        text(ctx, label, start - 8, y(value), colors.muted, 'right');
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
      const best = bestIndex();
      ctx.fillStyle = colors.now;
      ctx.beginPath();
      ctx.arc(x(sizes[best]), y(work[best]), 5, 0, 2 * Math.PI);
      ctx.fill();
      text(ctx, `least at ${sizes[best]}`, x(sizes[best]), y(work[best]) + 16, colors.now);
    },
  });
  slider(left, {
    label: 'Giants among 160 boxes',
    min: 0,
    max: mostGiants,
    value: giants,
    moved(value) {
      giants = value;
      show();
    },
  });
  const write = counters(right, { least: 'Least work', size: 'At a cell size of', brute: 'By brute force' });
  const say = sayer(right);
  listing(right, 'site/article/demos/cells.ts', excerpt(source, 'export function countWork'));
  show();

  function bestIndex(): number {
    return work.indexOf(Math.min(...work));
  }

  function show(): void {
    const crowd = mixedSizes(boxes, giants);
    const grid = place(new ro.coltech.SpatialGrid(0, 0, 480, 300, sizes[0]), crowd);
    work = sizes.map((size) => {
      grid.cellSize = size;
      return countWork(grid).work;
    });
    const bruteForce = place(new ro.coltech.BruteForce(), crowd);
    bruteForce.queryForCollisionPairs();
    brute = bruteForce.collisionTests;

    const best = bestIndex();
    const good = sizes.filter((_, i) => work[i] < brute / 4);
    write('least', work[best]);
    write('size', sizes[best]);
    write('brute', brute);
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
