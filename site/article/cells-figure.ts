// What figures 6 to 8 have in common: boxes on a grid, a slider for the cell size, the visited cells shaded, and the
// resulting work beside that of brute force.
import { ro } from 'broadphase/ro';
import { demoColumns } from './demo.ts';
import { type Box, bestCellSize, countWork, place } from './demos/cells.ts';
import source from './demos/cells.ts?raw';
import {
  button,
  counters,
  createView,
  element,
  excerpt,
  listing,
  row,
  type Sheet,
  sayer,
  slider,
} from './kit/index.ts';

/** The world of these figures. */
export const world = { width: 480, height: 300 };

/** The cell sizes on the slider: each a tenth larger than the one before. */
const cellSizes: number[] = [];
for (let size = 4; size <= world.width; size = Math.max(size + 1, Math.round(size * 1.1))) cellSizes.push(size);
cellSizes.push(world.width);

/** Lines closer than this, in CSS pixels, become a grey area. */
const finest = 3;

export interface CellsFigure {
  boxes: readonly Box[];
  /** The initial cell size. */
  cellSize: number;
  /** What the boxes are, in words. */
  what: string;
}

export function cellsFigure(root: HTMLElement, { boxes, cellSize, what }: CellsFigure): void {
  const first = nearest(cellSize);
  const grid = place(new ro.coltech.SpatialGrid(0, 0, world.width, world.height, cellSizes[first]), boxes);
  const bruteForce = place(new ro.coltech.BruteForce(), boxes);
  bruteForce.queryForCollisionPairs();
  const [left, right] = demoColumns(root);
  let counted = countWork(grid);

  const view = createView(left, {
    label: what,
    height: (width) => (width * world.height) / world.width,
    draw: (sheet) => drawGrid(sheet, grid, counted.pairs),
  });

  const controls = row(left);
  const size = slider(controls, {
    label: 'Cell size',
    min: 0,
    max: cellSizes.length - 1,
    value: first,
    format: (index) => String(cellSizes[index]),
    moved: (index) => choose(cellSizes[index]),
  });
  button(controls, 'Least work', () => {
    const best = bestCellSize(grid, cellSizes);
    size.value = nearest(best);
    choose(best);
  });

  const write = counters(right, {
    visits: 'Cells to visit',
    lookUps: 'Pairs looked up',
    tests: 'Pairs tested',
    brute: 'By brute force',
  });
  const setBars = workBars(right);
  const say = sayer(right);
  listing(right, 'site/article/demos/cells.ts', excerpt(source, 'export function countWork'));
  show();

  function choose(cellSize: number): void {
    grid.cellSize = cellSize;
    show();
  }

  function show(): void {
    counted = countWork(grid);
    const { visits, lookUps, tests, work } = counted;
    const brute = bruteForce.collisionTests;
    write({ visits, lookUps, tests, brute });
    setBars([visits, lookUps, tests], brute);
    say(`Cells of ${grid.pxCellSize.x}: ${verdict(work / brute)}`);
    view.describe(
      `${what}, on a grid with cells of ${grid.pxCellSize.x}. ${visits.toLocaleString('en')} of ` +
        `${grid.totalCells.toLocaleString('en')} cells are shaded: they have to be visited.`,
    );
    view.redraw();
  }
}

function nearest(cellSize: number): number {
  const distances = cellSizes.map((each) => Math.abs(each - cellSize));
  return distances.indexOf(Math.min(...distances));
}

/** The visited cells, the lines of the grid, and the boxes, darker if they collide. */
function drawGrid(
  { ctx, width, height, colors }: Sheet,
  grid: ro.coltech.SpatialGrid,
  pairs: ro.coltech.Pair<ro.Entity>[],
): void {
  const scale = width / world.width;
  const cell = grid.pxCellSize.x * scale;

  ctx.fillStyle = colors.cell;
  grid.grid.forEach((column, x) => {
    column.forEach((_, y) => {
      ctx.fillRect(x * cell, y * cell, cell, cell);
    });
  });

  ctx.strokeStyle = colors.grid;
  ctx.globalAlpha = Math.min(1, cell / (4 * finest));
  if (cell >= finest) {
    ctx.beginPath();
    for (let x = cell; x < width; x += cell) ctx.rect(x, 0, 0, height);
    for (let y = cell; y < height; y += cell) ctx.rect(0, y, width, 0);
    ctx.lineWidth = 1;
    ctx.stroke();
  }
  ctx.globalAlpha = 1;

  const colliding = new Set(pairs.flat());
  for (const entity of grid.entities) {
    const { x, y } = entity.pos;
    const side = [x * scale, y * scale, entity.size.x * scale, entity.size.y * scale] as const;
    const color = colliding.has(entity) ? colors.hit : colors.box;
    ctx.fillStyle = ctx.strokeStyle = color;
    ctx.lineWidth = 1.5;
    ctx.globalAlpha = 0.45;
    ctx.fillRect(...side);
    ctx.globalAlpha = 1;
    ctx.strokeRect(...side);
  }
}

/** The work of a grid as a share of that of brute force, in words. */
function verdict(ratio: number): string {
  const factor = (value: number) => (value < 10 ? value.toFixed(1) : Math.round(value).toLocaleString('en'));
  if (ratio > 1.05) return `${factor(ratio)} times the work of brute force.`;
  return ratio < 0.95 ? `brute force has ${factor(1 / ratio)} times this work.` : 'as much work as brute force.';
}

/** The kinds of work of a grid, and their names in the key below the bars. */
const kinds = { visits: 'cells visited', lookUps: 'pairs looked up', tests: 'pairs tested' };

/** A bar for the grid above one for brute force. Returns what sets them: each kind of work, and the tests of brute force. */
function workBars(root: HTMLElement): (parts: readonly number[], brute: number) => void {
  const ours = bar('Grid', Object.keys(kinds));
  const theirs = bar('Brute force', ['tests']);
  const key = Object.entries(kinds).flatMap(([part, name]) => [element('i', { 'data-part': part }), ` ${name} `]);
  root.append(
    element('div', { class: 'bars', 'aria-hidden': true }, ours.line, theirs.line),
    element('p', { class: 'bar-key', 'aria-hidden': true }, ...key),
  );
  return (parts, brute) => {
    const work = parts.reduce((sum, part) => sum + part);
    const most = Math.max(work, brute);
    ours.set(
      parts.map((part) => part / most),
      work,
    );
    theirs.set([brute / most], brute);
  };
}

/** A horizontal bar in parts, with its name before it and its sum after it. */
function bar(name: string, parts: readonly string[]) {
  const pieces = parts.map((part) => element('span', { 'data-part': part }));
  const sum = element('b');
  return {
    line: element('p', { class: 'bar' }, element('span', {}, name), element('span', {}, ...pieces), sum),
    set(shares: readonly number[], total: number) {
      pieces.forEach((piece, i) => {
        piece.style.width = `${100 * shares[i]}%`;
      });
      sum.textContent = total.toLocaleString('en');
    },
  };
}
