// Fig. 5: a grid that does not begin at 0, and the calculation from a position to its cell.
import { coltech } from 'broadphase/ro';
import {
  boxOn,
  choice,
  columns,
  createView,
  element,
  fitWorld,
  gridOn,
  makeDraggable,
  sayer,
  text,
} from '../kit/index.ts';

const cellSize = 40;
const cells = 5;
const extent = cells * cellSize;
/** The part of the world in view: minX, minY, across, down. */
const world = [-160, -130, 360, 280] as const;
const keyStep = 10;
const reach = 26;

type Moved = 'point' | 'grid';

export function mount(root: HTMLElement): void {
  const point = { x: -30, y: 46 };
  const min = { x: -120, y: -90 };
  /** Where the two were dragged to; point and min are the same in whole numbers. */
  const exact = { point: { ...point }, grid: { ...min } };
  let arrowsMove: Moved = 'point';
  let held: Moved = 'point';
  let grid = new coltech.SpatialGrid(min.x, min.y, min.x + extent, min.y + extent, cellSize);

  const [left, right] = columns(root);
  const place = (view: { width: number; height: number }) => fitWorld(view, world, [2, 2, 2, 2]);

  const view = createView(left, {
    label: 'A point and a grid.',
    height: (width) => (width * world[3]) / world[2],
    draw(ctx, width, height, colors) {
      const fit = place({ width, height });
      const px = (x: number) => fit.x + x * fit.scale;
      const py = (y: number) => fit.y + y * fit.scale;
      const cell: [number, number, number, number] = [
        min.x + grid.columnOf(point.x) * cellSize,
        min.y + grid.cellOf(point.y) * cellSize,
        cellSize,
        cellSize,
      ];
      boxOn(ctx, fit, cell, { fill: colors.cell });
      gridOn(ctx, fit, { minX: min.x, minY: min.y, columns: cells, rows: cells, cellSize }, colors.grid);
      for (let i = 0; i < cells; i++) {
        text(ctx, String(i), px(min.x + (i + 0.5) * cellSize), py(min.y) - 10, colors.muted);
        text(ctx, String(i), px(min.x) - 10, py(min.y + (i + 0.5) * cellSize), colors.muted);
      }
      // The axes of the world.
      ctx.strokeStyle = colors.muted;
      ctx.lineWidth = 1;
      ctx.setLineDash([2, 4]);
      ctx.beginPath();
      ctx.moveTo(px(0), 0);
      ctx.lineTo(px(0), height);
      ctx.moveTo(0, py(0));
      ctx.lineTo(width, py(0));
      ctx.stroke();
      ctx.setLineDash([]);
      text(ctx, '0, 0', px(0) + 6, py(0) - 10, colors.muted, 'left');
      text(ctx, 'x →', width - 8, py(0) + 12, colors.muted, 'right');
      text(ctx, 'y ↓', px(0) + 8, height - 12, colors.muted, 'left');

      ctx.strokeStyle = colors.accent;
      ctx.lineWidth = 2;
      ctx.setLineDash([5, 4]);
      ctx.beginPath();
      ctx.moveTo(px(min.x), py(point.y));
      ctx.lineTo(px(point.x), py(point.y));
      ctx.lineTo(px(point.x), py(min.y));
      ctx.stroke();
      ctx.setLineDash([]);

      ctx.fillStyle = colors.accent;
      ctx.fillRect(px(min.x) - 6, py(min.y) - 6, 12, 12);
      ctx.fillStyle = colors.now;
      ctx.beginPath();
      ctx.arc(px(point.x), py(point.y), 7, 0, 7);
      ctx.fill();
      text(ctx, `${point.x}, ${point.y}`, px(point.x) + 12, py(point.y) + 13, colors.text, 'left');
    },
  });

  choice<Moved>(
    right,
    'The arrow keys move',
    [
      ['point', 'the point'],
      ['grid', 'the grid'],
    ],
    arrowsMove,
    (value) => {
      arrowsMove = value;
    },
  );
  const sum = element('pre', { class: 'sum', tabindex: 0, 'aria-label': 'The sum' });
  right.append(sum);
  const say = sayer(right);

  const within = (value: number, low: number, length: number, inset: number) =>
    Math.min(Math.max(value, low + inset), low + length - inset);

  const show = () => {
    exact.point.x = within(exact.point.x, world[0], world[2], 8);
    exact.point.y = within(exact.point.y, world[1], world[3], 8);
    exact.grid.x = within(exact.grid.x, world[0], world[2] - extent, 18);
    exact.grid.y = within(exact.grid.y, world[1], world[3] - extent, 18);
    point.x = Math.round(exact.point.x);
    point.y = Math.round(exact.point.y);
    min.x = Math.round(exact.grid.x);
    min.y = Math.round(exact.grid.y);
    grid = new coltech.SpatialGrid(min.x, min.y, min.x + extent, min.y + extent, cellSize);
    const sumOf = (name: string, at: number, begin: number, index: number) => {
      const quotient = (at - begin) / cellSize;
      const signed = begin < 0 ? `(${begin})` : String(begin);
      const border = Math.floor(quotient) === index ? '' : `   ${Math.floor(quotient)} → border cell`;
      return `${name} = floor((${at} − ${signed}) / ${cellSize})\n       = floor(${quotient.toFixed(2)})\n       = ${index}${border}`;
    };
    const col = grid.columnOf(point.x);
    const cell = grid.cellOf(point.y);
    sum.textContent = `${sumOf('column', point.x, min.x, col)}\n\n${sumOf('cell  ', point.y, min.y, cell)}`;
    const words = `grid.min is { x: ${min.x}, y: ${min.y} }. The point { x: ${point.x}, y: ${point.y} } is in grid[${col}][${cell}].`;
    say(words);
    view.describe(`A grid of 5 by 5 cells of ${cellSize}, and a point. ${words}`);
    view.redraw();
  };

  /** Which of the two is at a place in the view. */
  const at = (x: number, y: number): Moved | undefined => {
    const fit = place(view);
    const near = (of: { x: number; y: number }) =>
      Math.hypot(fit.x + of.x * fit.scale - x, fit.y + of.y * fit.scale - y) <= reach;
    return near(point) ? 'point' : near(min) ? 'grid' : undefined;
  };
  const move = (what: Moved, dx: number, dy: number) => {
    exact[what].x += dx;
    exact[what].y += dy;
    show();
  };
  makeDraggable(view, {
    label: 'point and grid that can be moved by arrow keys',
    holds(x, y) {
      const what = at(x, y);
      if (what) held = what;
      return what !== undefined;
    },
    moved(dx, dy) {
      const { scale } = place(view);
      move(held, dx / scale, dy / scale);
    },
    stepped: (x, y) => move(arrowsMove, x * keyStep, y * keyStep),
  });
  show();
}
