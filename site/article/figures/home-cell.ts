// Fig. 19: every box has one home cell; and the cells that the query of a chosen box has to visit.
import { createRandom } from '../../../src/scenes/random.ts';
import { demoColumns } from '../demo.ts';
import { type Box, place } from '../demos/cells.ts';
import { HomeCellGrid } from '../demos/home-cell-grid.ts';
import source from '../demos/home-cell-grid.ts?raw';
import { boxOn, fitWorld, gridOn } from '../kit/drawing.ts';
import { button, counters, createView, excerpt, listing, makeDraggable, row, sayer, slider } from '../kit/index.ts';

const width = 480;
const height = 320;
const cellSize = 40;

export function mount(root: HTMLElement): void {
  const random = createRandom(5);
  const boxes = Array.from({ length: 40 }, (): Box => {
    const [across, down] = [12 + 20 * random(), 12 + 20 * random()];
    return [random() * (width - across), random() * (height - down), across, down];
  });
  const grid = place(new HomeCellGrid(cellSize), [[150, 90, 60, 30], ...boxes]);
  const { entities } = grid;
  const [largest] = entities;
  let chosen = entities[1];

  const [left, right] = demoColumns(root);
  const view = createView(left, {
    label: 'Boxes, each at home in one cell.',
    height: (across) => (across * height) / width,
    draw(ctx, across, down, colors) {
      const fit = fitWorld({ width: across, height: down }, [0, 0, width, height], [0, 0, 0, 0]);
      const [first, top, last, bottom] = grid.searchArea(chosen);
      for (let column = first; column <= last; column++) {
        for (let cell = top; cell <= bottom; cell++) {
          boxOn(ctx, fit, [column * cellSize, cell * cellSize, cellSize, cellSize], { fill: colors.cell });
        }
      }
      gridOn(ctx, fit, { minX: 0, minY: 0, columns: width / cellSize, rows: height / cellSize, cellSize }, colors.grid);

      const compared = new Set(found().compared);
      const partners = new Set(found().partners);
      for (const entity of entities) {
        const { pos, size } = entity;
        const box = [pos.x, pos.y, size.x, size.y] as const;
        const line = entity === chosen ? colors.now : compared.has(entity) ? colors.hit : colors.box;
        const fill = partners.has(entity) ? colors.hit : colors.box;
        ctx.globalAlpha = compared.has(entity) || entity === chosen ? 0.85 : 0.4;
        boxOn(ctx, fit, box, { fill, line, lineWidth: entity === chosen ? 3 : 1.5 });
        ctx.globalAlpha = 1;
        ctx.fillStyle = line;
        ctx.beginPath();
        ctx.arc(fit.x + pos.x * fit.scale, fit.y + pos.y * fit.scale, 3, 0, 2 * Math.PI);
        ctx.fill();
      }
    },
  });
  const worldUnits = (pixels: number) => (pixels * width) / view.width;
  makeDraggable(view, {
    label: 'A box that can be moved',
    holds: (x, y) => under(x, y) !== undefined,
    moved: (dx, dy) => move(worldUnits(dx), worldUnits(dy)),
    stepped: (dx, dy) => move(4 * dx, 4 * dy),
  });
  view.canvas.addEventListener('pointerdown', ({ offsetX, offsetY }) => choose(under(offsetX, offsetY) ?? chosen));

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
  const write = counters(left, {
    cells: 'Cells searched',
    compared: 'Compared with',
    partners: 'Partners',
    all: 'All look-ups',
  });
  const say = sayer(left, true);
  listing(right, 'site/article/demos/home-cell-grid.ts', excerpt(source, 'queryForCollisionPairs()'));
  listing(right, 'site/article/demos/home-cell-grid.ts', excerpt(source, 'searchArea(entity: Entity)'));
  show();

  /** The boxes that the chosen one is compared with, and those that overlap it. */
  function found() {
    const [first, top, last, bottom] = grid.searchArea(chosen);
    const compared = [];
    for (let column = first; column <= last; column++) {
      for (let cell = top; cell <= bottom; cell++) compared.push(...grid.at(column, cell));
    }
    const others = compared.filter((entity) => entity !== chosen);
    return {
      cells: (last - first + 1) * (bottom - top + 1),
      compared: others,
      partners: others.filter((entity) => grid.aabb2DIntersection(entity, chosen)),
    };
  }

  /** The topmost box at a place in the view. */
  function under(x: number, y: number) {
    const at = { x: worldUnits(x), y: worldUnits(y) };
    return entities.findLast(
      ({ pos, size }) => at.x >= pos.x && at.x <= pos.x + size.x && at.y >= pos.y && at.y <= pos.y + size.y,
    );
  }

  function choose(entity: (typeof entities)[number]): void {
    chosen = entity;
    show();
  }

  function move(dx: number, dy: number): void {
    const { pos, size } = chosen;
    pos.x = Math.min(Math.max(pos.x + dx, 0), width - size.x);
    pos.y = Math.min(Math.max(pos.y + dy, 0), height - size.y);
    show();
  }

  function show(): void {
    for (const entity of entities) entity.updateAABB();
    grid.update();
    grid.queryForCollisionPairs();
    const { cells, compared, partners } = found();
    write('cells', cells);
    write('compared', compared.length);
    write('partners', partners.length);
    write('all', grid.lookUps);
    const sentence =
      `The chosen box looks into ${cells} cells and is compared with ${compared.length} boxes; ` +
      `${partners.length} of them ${partners.length === 1 ? 'overlaps' : 'overlap'} it.`;
    say(`${sentence} A dot marks the corner that decides where a box is at home.`);
    view.describe(`${entities.length} boxes on a grid, each at home in one cell. ${sentence}`);
    view.redraw();
  }
}
