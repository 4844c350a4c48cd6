// Fig. 4: a box on a grid, and the arrays that contain it. The grid is a real one, rebuilt whenever the box moves.
import { coltech, Entity, World } from 'broadphase/ro';
import { boxOn, cellBox, dot, fitWorld, gridOn, text } from '../kit/drawing.ts';
import {
  columns,
  confine,
  contains,
  createView,
  element,
  makeDraggable,
  type Sheet,
  sayer,
  showArrays,
  slider,
} from '../kit/index.ts';

const side = 200;
const boxSize = { x: 50, y: 80 };
const keyStep = 5;
/** With more rows or columns, their cells are drawn small. */
const most = 6;
const margins = [24, 24, 10, 10] as const;
const letter = (row: number) => String.fromCharCode(65 + row);

/** The number of columns, and of rows. */
const countOf = (grid: coltech.SpatialGrid) => Math.ceil(side / grid.pxCellSize.x);

const place = (view: { width: number; height: number }) => fitWorld(view, [0, 0, side, side], margins);

export function mount(root: HTMLElement): void {
  const grid = new coltech.SpatialGrid(0, 0, side, side, 40);
  const world = new World(null, { coltech: grid });
  const entity = new Entity(20, 50, boxSize.x, boxSize.y);
  world.addEntity(entity);
  const { pos } = entity;
  /** Where the box was dragged to; pos is the same in whole numbers. */
  const exact = { ...pos };

  const [left, right] = columns(root);

  const view = createView(left, {
    label: 'A box on a grid.',
    height: (width) => Math.min(width, 420),
    draw: (sheet) => draw(sheet, grid, pos),
  });

  // In the other column, or above the arrays on a phone: these need more room or less, and must not move the slider.
  slider(left, {
    label: 'Cell size',
    min: 20,
    max: 80,
    step: 5,
    value: 40,
    moved(value) {
      grid.cellSize = value;
      show();
    },
  });
  const say = sayer(right);
  const arrays = element('div', { class: 'arrays all' });
  right.append(arrays);

  const show = () => {
    entity.ppos = { ...pos };
    world.step();
    const count = countOf(grid);
    arrays.classList.toggle('many', count > most);
    showArrays(arrays, arraysOf(grid));

    const { allocatedCells } = grid;
    const corner = cornerInWords(grid.columnOf(pos.x), grid.cellOf(pos.y));
    say(`${allocatedCells} ${allocatedCells === 1 ? 'cell holds' : 'cells hold'} the box. ${corner}`);
    view.describe(
      `A box of 50 by 80 at ${pos.x}, ${pos.y} on a grid of ${count} by ${count} cells of ${grid.pxCellSize.x}. ` +
        `It lies in ${allocatedCells} of them. ${corner}`,
    );
    view.redraw();
  };
  /** Moves the box within the grid. */
  const move = (dx: number, dy: number) => {
    exact.x += dx;
    exact.y += dy;
    confine(exact, [0, 0, side - boxSize.x, side - boxSize.y]);
    pos.x = Math.round(exact.x);
    pos.y = Math.round(exact.y);
    show();
  };

  makeDraggable(view, {
    label: 'box that can be moved by arrow keys',
    fit: () => place(view),
    holds: (x, y) => contains([pos.x, pos.y, boxSize.x, boxSize.y], x, y),
    moved: move,
    stepped: (x, y) => move(x * keyStep, y * keyStep),
  });
  show();
}

const cornerInWords = (col: number, row: number) =>
  `The upper left corner is in grid[${col}][${letter(row)}], which is grid[${col}][${row}] in code.`;

/** What is in each cell of each column. */
function arraysOf(grid: coltech.SpatialGrid): ((string | undefined)[] | undefined)[] {
  const indices = Array.from({ length: countOf(grid) }, (_, i) => i);
  const box = indices.length > most ? '■' : '[box]';
  return indices.map((col) => {
    const column = grid.grid[col] as Entity[][] | undefined;
    return column && indices.map((row) => column[row] && box);
  });
}

/** The cells of the box, the lines of the grid with their numbers and letters, and the box at a place. */
function draw(sheet: Sheet, grid: coltech.SpatialGrid, { x, y }: { x: number; y: number }): void {
  const { ctx, colors } = sheet;
  const fit = place(sheet);
  const cell = grid.pxCellSize.x;
  const count = countOf(grid);
  ctx.save();
  ctx.beginPath();
  ctx.rect(fit.x - 1, fit.y - 1, side * fit.scale + 2, side * fit.scale + 2);
  ctx.clip();
  grid.grid.forEach((column, col) => {
    column.forEach((_, row) => {
      boxOn(ctx, fit, cellBox(col, row, cell), { fill: colors.cell });
    });
  });
  gridOn(ctx, fit, { minX: 0, minY: 0, columns: count, rows: count, cellSize: cell }, colors.grid);
  boxOn(ctx, fit, [0, 0, side, side], { line: colors.grid });
  boxOn(ctx, fit, [x, y, boxSize.x, boxSize.y], { fill: colors.box, line: colors.hit, lineWidth: 2 });
  ctx.restore();
  for (let i = 0; i < count; i++) {
    const middle = Math.min((i + 0.5) * cell, (i * cell + side) / 2) * fit.scale;
    text(ctx, String(i), fit.x + middle, fit.y - 12, grid.grid[i] ? colors.text : colors.muted);
    const inRow = grid.grid.some((column) => column[i]);
    text(ctx, letter(i), fit.x - 13, fit.y + middle, inRow ? colors.text : colors.muted);
  }
  const [left, top] = [fit.x + x * fit.scale, fit.y + y * fit.scale];
  dot(ctx, left, top, 5, colors.now);
  text(ctx, `${x}, ${y}`, left + 8, top + 13, colors.text, 'left');
}
