// Fig. 5: a grid that does not begin at 0, and the calculation from a position to its cell.
import { coltech } from 'broadphase/ro';
import { boxOn, dot, fitWorld, gridOn, text } from '../kit/drawing.ts';
import { choice, columns, confine, createView, element, makeDraggable, type Sheet, sayer } from '../kit/index.ts';

const cellSize = 40;
const cells = 5;
const extent = cells * cellSize;
/** The part of the world in view: minX, minY, across, down. */
const world = [-160, -130, 360, 280] as const;
const keyStep = 10;
const reach = 26;

interface Point {
  x: number;
  y: number;
}
type Moved = 'point' | 'grid';

export function mount(root: HTMLElement): void {
  const point = { x: -30, y: 46 };
  /** Where the two were dragged to; point and grid.min are the same in whole numbers. */
  const exact = { point: { ...point }, grid: { x: -120, y: -90 } };
  let arrowsMove: Moved = 'point';
  let held: Moved = 'point';
  let grid = gridAt(exact.grid);

  const [left, right] = columns(root);

  const view = createView(left, {
    label: 'A point and a grid.',
    height: (width) => (width * world[3]) / world[2],
    draw: (sheet) => draw(sheet, point, grid),
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

  const show = () => {
    confine(exact.point, inset(8, 0));
    confine(exact.grid, inset(18, extent));
    point.x = Math.round(exact.point.x);
    point.y = Math.round(exact.point.y);
    grid = gridAt(exact.grid);
    const { min } = grid;
    const col = grid.columnOf(point.x);
    const cell = grid.cellOf(point.y);
    sum.textContent = `${sumOf('column', point.x, min.x, col)}\n\n${sumOf('cell  ', point.y, min.y, cell)}`;
    const words = `grid.min is { x: ${min.x}, y: ${min.y} }. The point { x: ${point.x}, y: ${point.y} } is in grid[${col}][${cell}].`;
    say(words);
    view.describe(`A grid of 5 by 5 cells of ${cellSize}, and a point. ${words}`);
    view.redraw();
  };

  const move = (what: Moved, dx: number, dy: number) => {
    exact[what].x += dx;
    exact[what].y += dy;
    show();
  };
  makeDraggable(view, {
    label: 'point and grid that can be moved by arrow keys',
    fit: () => place(view),
    holds(x, y) {
      const near = (at: Point) => Math.hypot(at.x - x, at.y - y) <= reach / place(view).scale;
      const what = near(point) ? 'point' : near(grid.min) ? 'grid' : undefined;
      if (what) held = what;
      return what !== undefined;
    },
    moved: (dx, dy) => move(held, dx, dy),
    stepped: (x, y) => move(arrowsMove, x * keyStep, y * keyStep),
  });
  show();
}

const place = (view: { width: number; height: number }) => fitWorld(view, world, [2, 2, 2, 2]);

/** Where something of this length on each side may begin, this far from the edges of the world in view. */
const inset = (edge: number, length: number) =>
  [world[0] + edge, world[1] + edge, world[2] - length - 2 * edge, world[3] - length - 2 * edge] as const;

/** A grid that begins at a place in whole numbers. */
function gridAt(at: Point): coltech.SpatialGrid {
  const [x, y] = [Math.round(at.x), Math.round(at.y)];
  return new coltech.SpatialGrid(x, y, x + extent, y + extent, cellSize);
}

/** The calculation of a column or a cell, line by line. */
function sumOf(name: string, at: number, begin: number, index: number): string {
  const quotient = (at - begin) / cellSize;
  const signed = begin < 0 ? `(${begin})` : String(begin);
  const border = Math.floor(quotient) === index ? '' : `   ${Math.floor(quotient)} → border cell`;
  return `${name} = floor((${at} − ${signed}) / ${cellSize})\n       = floor(${quotient.toFixed(2)})\n       = ${index}${border}`;
}

/** The grid with the cell of the point, the axes of the world, and the way from the grid's beginning to the point. */
function draw(sheet: Sheet, point: Point, grid: coltech.SpatialGrid): void {
  const { ctx, width, height, colors } = sheet;
  const { min } = grid;
  const fit = place(sheet);
  const px = (x: number) => fit.x + x * fit.scale;
  const py = (y: number) => fit.y + y * fit.scale;
  const [column, cell] = [grid.columnOf(point.x), grid.cellOf(point.y)];
  boxOn(ctx, fit, [min.x + column * cellSize, min.y + cell * cellSize, cellSize, cellSize], { fill: colors.cell });
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
  dot(ctx, px(point.x), py(point.y), 7, colors.now);
  text(ctx, `${point.x}, ${point.y}`, px(point.x) + 12, py(point.y) + 13, colors.text, 'left');
}
