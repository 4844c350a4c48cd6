// Fig. 4: a box on a grid, and the arrays that contain it. The grid is a real one, rebuilt whenever the box moves.
import { coltech, Entity, World } from 'broadphase/ro';
import {
  boxOn,
  columns,
  createView,
  element,
  fitWorld,
  gridOn,
  makeDraggable,
  sayer,
  slider,
  text,
} from '../kit/index.ts';

const side = 200;
const boxSize = { x: 50, y: 80 };
const keyStep = 5;
/** With more rows or columns, their cells are drawn small. */
const most = 6;
const letter = (row: number) => String.fromCharCode(65 + row);

export function mount(root: HTMLElement): void {
  const grid = new coltech.SpatialGrid(0, 0, side, side, 40);
  const world = new World(null, { coltech: grid });
  const entity = new Entity(20, 50, boxSize.x, boxSize.y);
  world.addEntity(entity);
  const { pos } = entity;
  /** Where the box was dragged to; pos is the same in whole numbers. */
  const exact = { ...pos };
  const cellSize = () => grid.pxCellSize.x;
  const count = () => Math.ceil(side / cellSize());

  const [left, right] = columns(root);
  const margins = [24, 24, 10, 10] as const;
  const place = (view: { width: number; height: number }) => fitWorld(view, [0, 0, side, side], margins);

  const view = createView(left, {
    label: 'A box on a grid.',
    height: (width) => Math.min(width, 420),
    draw(ctx, width, height, colors) {
      const fit = place({ width, height });
      const cell = cellSize();
      ctx.save();
      ctx.beginPath();
      ctx.rect(fit.x - 1, fit.y - 1, side * fit.scale + 2, side * fit.scale + 2);
      ctx.clip();
      grid.grid.forEach((column, col) => {
        column.forEach((_, row) => {
          boxOn(ctx, fit, [col * cell, row * cell, cell, cell], { fill: colors.cell });
        });
      });
      gridOn(ctx, fit, { minX: 0, minY: 0, columns: count(), rows: count(), cellSize: cell }, colors.grid);
      boxOn(ctx, fit, [0, 0, side, side], { line: colors.grid });
      boxOn(ctx, fit, [pos.x, pos.y, boxSize.x, boxSize.y], { fill: colors.box, line: colors.hit, lineWidth: 2 });
      ctx.restore();
      for (let i = 0; i < count(); i++) {
        const middle = Math.min((i + 0.5) * cell, (i * cell + side) / 2) * fit.scale;
        const color = grid.grid[i] ? colors.text : colors.muted;
        text(ctx, String(i), fit.x + middle, fit.y - 12, color);
        const inRow = grid.grid.some((column) => column[i]);
        text(ctx, letter(i), fit.x - 13, fit.y + middle, inRow ? colors.text : colors.muted);
      }
      ctx.fillStyle = colors.now;
      ctx.beginPath();
      ctx.arc(fit.x + pos.x * fit.scale, fit.y + pos.y * fit.scale, 5, 0, 7);
      ctx.fill();
      text(
        ctx,
        `${pos.x}, ${pos.y}`,
        fit.x + pos.x * fit.scale + 8,
        fit.y + pos.y * fit.scale + 13,
        colors.text,
        'left',
      );
    },
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

  /** Puts the box at a place within the grid, and shows its cells. */
  const show = () => {
    exact.x = Math.min(Math.max(exact.x, 0), side - boxSize.x);
    exact.y = Math.min(Math.max(exact.y, 0), side - boxSize.y);
    pos.x = Math.round(exact.x);
    pos.y = Math.round(exact.y);
    entity.ppos = { ...pos };
    world.step();

    const rows: HTMLElement[] = [];
    const many = count() > most;
    arrays.classList.toggle('many', many);
    for (let col = 0; col < count(); col++) {
      const column = grid.grid[col] as (Entity[] | undefined)[] | undefined;
      const cells = element('span', { class: 'array' });
      if (!column) cells.append(element('span', { class: 'nothing' }, 'empty'));
      else
        for (let row = 0; row < count(); row++) {
          cells.append(
            element('span', { class: column[row] ? 'slot full' : 'slot' }, column[row] ? (many ? '■' : '[box]') : '·'),
          );
        }
      rows.push(element('code', {}, `grid[${col}]`), cells);
    }
    arrays.replaceChildren(...rows);

    const col = grid.columnOf(pos.x);
    const row = grid.cellOf(pos.y);
    const { allocatedCells } = grid;
    const corner = `The upper left corner is in grid[${col}][${letter(row)}], which is grid[${col}][${row}] in code.`;
    say(`${allocatedCells} ${allocatedCells === 1 ? 'cell holds' : 'cells hold'} the box. ${corner}`);
    view.describe(
      `A box of 50 by 80 at ${pos.x}, ${pos.y} on a grid of ${count()} by ${count()} cells of ${cellSize()}. ` +
        `It lies in ${allocatedCells} of them. ${corner}`,
    );
    view.redraw();
  };

  makeDraggable(view, {
    label: 'box that can be moved by arrow keys',
    holds(x, y) {
      const fit = place(view);
      const inX = (x - fit.x) / fit.scale - pos.x;
      const inY = (y - fit.y) / fit.scale - pos.y;
      return inX >= 0 && inY >= 0 && inX <= boxSize.x && inY <= boxSize.y;
    },
    moved(dx, dy) {
      const { scale } = place(view);
      exact.x += dx / scale;
      exact.y += dy / scale;
      show();
    },
    stepped(x, y) {
      exact.x += x * keyStep;
      exact.y += y * keyStep;
      show();
    },
  });
  show();
}
