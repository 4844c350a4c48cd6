// Fig. 19: every box has one home cell; and the cells that the query of a chosen box has to visit.
import type { Entity } from 'broadphase/ro';
import { createRandom } from '../../../src/scenes/random.ts';
import { demoColumns } from '../demo.ts';
import { type Box, place } from '../demos/cells.ts';
import { HomeCellGrid } from '../demos/home-cell-grid.ts';
import source from '../demos/home-cell-grid.ts?raw';
import { boxOn, cellBox, dot, fitWorld, gridOn } from '../kit/drawing.ts';
import {
  button,
  confine,
  contains,
  counters,
  createView,
  excerpt,
  listing,
  makeDraggable,
  row,
  type Sheet,
  sayer,
  slider,
} from '../kit/index.ts';

const width = 480;
const height = 320;
const cellSize = 40;
const names = { cells: 'Cells searched', compared: 'Compared with', partners: 'Partners', all: 'All lookups' };

function smallBoxes(): Box[] {
  const random = createRandom(5);
  return Array.from({ length: 40 }, () => {
    const [across, down] = [12 + 20 * random(), 12 + 20 * random()];
    return [random() * (width - across), random() * (height - down), across, down];
  });
}

export function mount(root: HTMLElement): void {
  const grid = place(new HomeCellGrid(cellSize), [[150, 90, 60, 30], ...smallBoxes()]);
  const { entities } = grid;
  const [largest] = entities;
  let chosen = entities[1];

  const [left, right] = demoColumns(root);
  const view = createView(left, {
    label: 'Boxes, each at home in one cell.',
    height: (across) => (across * height) / width,
    draw: (sheet) => draw(sheet, grid, chosen),
  });
  const scale = () => view.width / width;
  makeDraggable(view, {
    label: 'A box that can be moved',
    fit: () => ({ x: 0, y: 0, scale: scale() }),
    holds: (x, y) => topmost(entities, x, y) !== undefined,
    moved: move,
    stepped: (dx, dy) => move(4 * dx, 4 * dy),
  });
  view.canvas.addEventListener('pointerdown', ({ offsetX, offsetY }) => {
    choose(topmost(entities, offsetX / scale(), offsetY / scale()) ?? chosen);
  });

  const controls = row(left);
  button(controls, 'Next box', () => choose(entities[(entities.indexOf(chosen) + 1) % entities.length]));
  slider(controls, {
    label: 'Largest box',
    min: 40,
    max: 240,
    step: 10,
    value: largest.size.x,
    format: (across) => `${across} wide`,
    moved(across) {
      largest.size = { x: across, y: across / 2 };
      show();
    },
  });
  const write = counters(left, names);
  const say = sayer(left, true);
  listing(right, 'site/article/demos/home-cell-grid.ts', excerpt(source, 'queryForCollisionPairs()'));
  listing(right, 'site/article/demos/home-cell-grid.ts', excerpt(source, 'searchArea(entity: Entity)'));
  show();

  function choose(entity: Entity): void {
    chosen = entity;
    show();
  }

  function move(dx: number, dy: number): void {
    const { pos, size } = chosen;
    pos.x += dx;
    pos.y += dy;
    confine(pos, [0, 0, width - size.x, height - size.y]);
    show();
  }

  function show(): void {
    for (const entity of entities) entity.updateAABB();
    grid.update();
    grid.queryForCollisionPairs();
    const search = found(grid, chosen);
    const { cells, compared, partners } = search;
    write({ cells, compared: compared.length, partners: partners.length, all: grid.lookUps });
    const sentence = inWords(search);
    say(`${sentence} A dot marks the corner that decides where a box is at home.`);
    view.describe(`${entities.length} boxes on a grid, each at home in one cell. ${sentence}`);
    view.redraw();
  }
}

const boxOf = ({ pos, size }: Entity) => [pos.x, pos.y, size.x, size.y] as const;

/** The topmost box at a place. */
const topmost = (entities: readonly Entity[], x: number, y: number) =>
  entities.findLast((entity) => contains(boxOf(entity), x, y));

/** How many cells are searched for a box, which boxes it is compared with, and which of them overlap it. */
function found(grid: HomeCellGrid, chosen: Entity) {
  const [first, top, last, bottom] = grid.searchArea(chosen);
  const met: Entity[] = [];
  for (let column = first; column <= last; column++) {
    for (let cell = top; cell <= bottom; cell++) met.push(...grid.at(column, cell));
  }
  const compared = met.filter((entity) => entity !== chosen);
  return {
    cells: (last - first + 1) * (bottom - top + 1),
    compared,
    partners: compared.filter((entity) => grid.aabb2DIntersection(entity, chosen)),
  };
}

const inWords = ({ cells, compared, partners }: ReturnType<typeof found>) =>
  `The chosen box looks into ${cells} cells and is compared with ${compared.length} boxes; ` +
  `${partners.length} of them ${partners.length === 1 ? 'overlaps' : 'overlap'} it.`;

/** The cells searched for the chosen box, the grid, and all boxes with their corners. */
function draw(sheet: Sheet, grid: HomeCellGrid, chosen: Entity): void {
  const { ctx, colors } = sheet;
  const fit = fitWorld(sheet, [0, 0, width, height], [0, 0, 0, 0]);
  const [first, top, last, bottom] = grid.searchArea(chosen);
  for (let column = first; column <= last; column++) {
    for (let cell = top; cell <= bottom; cell++) {
      boxOn(ctx, fit, cellBox(column, cell, cellSize), { fill: colors.cell });
    }
  }
  gridOn(ctx, fit, { minX: 0, minY: 0, columns: width / cellSize, rows: height / cellSize, cellSize }, colors.grid);

  const { compared, partners } = found(grid, chosen);
  for (const entity of grid.entities) {
    const isCompared = compared.includes(entity);
    const line = entity === chosen ? colors.now : isCompared ? colors.hit : colors.box;
    const fill = partners.includes(entity) ? colors.hit : colors.box;
    ctx.globalAlpha = isCompared || entity === chosen ? 0.85 : 0.4;
    boxOn(ctx, fit, boxOf(entity), { fill, line, lineWidth: entity === chosen ? 3 : 1.5 });
    ctx.globalAlpha = 1;
    dot(ctx, fit.x + entity.pos.x * fit.scale, fit.y + entity.pos.y * fit.scale, 3, line);
  }
}
