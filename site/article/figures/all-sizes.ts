// Fig. 20: giants and dwarfs once more, each in the grid whose cells fit it.
import { type Entity, ro } from 'broadphase/ro';
import { demoColumns } from '../demo.ts';
import { bestCellSize, countWork, place } from '../demos/cells.ts';
import { HierarchicalGrid } from '../demos/hierarchical-grid.ts';
import source from '../demos/hierarchical-grid.ts?raw';
import { mixedSizes } from '../demos/mixed-sizes.ts';
import { boxOn, cellBox, fitWorld } from '../kit/drawing.ts';
import { choice, counters, createView, excerpt, listing, type Sheet, sayer } from '../kit/index.ts';

const width = 480;
const height = 300;

export function mount(root: HTMLElement): void {
  const boxes = mixedSizes(80, 4);
  const grids = place(new HierarchicalGrid(), boxes);
  grids.update();
  const pairs = grids.queryForCollisionPairs();
  const colliding = new Set(pairs.flat());
  const sizes = grids.grids.map(({ cellSize }) => cellSize);
  const flat = place(new ro.coltech.SpatialGrid(0, 0, width, height, 32), boxes);
  const [finest] = sizes;
  flat.cellSize = finest;
  const worst = countWork(flat).work;
  flat.cellSize = bestCellSize(
    flat,
    Array.from({ length: 100 }, (_, i) => 4 + 2 * i),
  );
  const best = countWork(flat).work;
  /** The cells whose grid is shown; 0 for all of them. */
  let shown = 0;

  const [left, right] = demoColumns(root);
  const view = createView(left, {
    label: 'Boxes of very different sizes, each with the cells of its own grid.',
    height: (across) => (across * height) / width,
    draw: (sheet) => draw(sheet, grids, colliding, (cellSize) => shown === 0 || shown === cellSize),
  });
  const options = sizes.map((cellSize) => [cellSize, `Cells of ${cellSize}`] as const);
  choice(left, 'Grid', [[0, 'All'], ...options], shown, (cellSize) => {
    shown = cellSize;
    show();
  });
  const write = counters(left, {
    grids: 'Grids',
    lookUps: 'Lookups',
    tests: 'Pairs tested',
    pairs: 'Pairs found',
  });
  const say = sayer(left);
  listing(right, 'site/article/demos/hierarchical-grid.ts', excerpt(source, 'queryForCollisionPairs()'));

  write({ grids: sizes.length, lookUps: grids.lookUps, tests: grids.collisionTests, pairs: pairs.length });
  show();

  function show(): void {
    const members = grids.entities.filter((entity) => grids.cellSizeOf(entity) === shown).length;
    say(
      shown === 0
        ? `${grids.lookUps + grids.collisionTests} lookups and tests, with nothing tuned. The best single cell size for ` +
            `these boxes, ${flat.pxCellSize.x}, takes ${best}; cells of ${finest} ` +
            `take ${worst.toLocaleString('en')}.`
        : `${members} of ${boxes.length} boxes are in the grid with cells of ${shown}.`,
    );
    view.describe(
      `${boxes.length} boxes of very different sizes in ${sizes.length} grids with cells of ${sizes.join(', ')}. ` +
        `Shown: ${shown === 0 ? 'all grids' : `the grid with cells of ${shown}, with ${members} boxes`}.`,
    );
    view.redraw();
  }
}

/** The cells of the lit grids, and all boxes, those of the other grids pale. */
function draw(
  sheet: Sheet,
  grids: HierarchicalGrid,
  colliding: ReadonlySet<Entity>,
  isLit: (cellSize: number) => boolean,
): void {
  const { ctx, colors } = sheet;
  const fit = fitWorld(sheet, [0, 0, width, height], [0, 0, 0, 0]);
  for (const { cellSize, cells } of grids.grids.toReversed()) {
    if (!isLit(cellSize)) continue;
    for (const name of cells.keys()) {
      const [column, cell] = name.split(':').map(Number);
      const look = { fill: colors.cell, line: colors.accent, lineWidth: cellSize < 16 ? 0.75 : 1.25 };
      boxOn(ctx, fit, cellBox(column, cell, cellSize), look);
    }
  }
  for (const entity of grids.entities) {
    const { pos, size } = entity;
    const color = colliding.has(entity) ? colors.hit : colors.box;
    const lit = isLit(grids.cellSizeOf(entity));
    ctx.globalAlpha = lit ? 0.6 : 0.15;
    boxOn(ctx, fit, [pos.x, pos.y, size.x, size.y], { fill: color });
    ctx.globalAlpha = lit ? 1 : 0.3;
    boxOn(ctx, fit, [pos.x, pos.y, size.x, size.y], { line: color });
    ctx.globalAlpha = 1;
  }
}
