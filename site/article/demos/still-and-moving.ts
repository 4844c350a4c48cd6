// Boxes on a retained grid: some move, the others rest. The cells that a step changes light up.
import type { ro as Ro } from 'broadphase/ro';
import { createRandom } from '../../../src/scenes/random.ts';
import { turnRound } from './crowd.ts';
import type { RetainedGrid } from './retained-grid.ts';

const COUNT = 240;
const SPEED = 1.6; // the most pixels per step
const FADE = 12; // steps until a cell is dark again
const FOLLOW = 0.06; // the weight of the last step in the averages
const ENOUGH = 30; // steps for averages from the beginning

/** A cell that changed lately, and how many steps ago. */
interface Touched {
  column: number;
  row: number;
  age: number;
}

export function stillAndMoving(
  ro: typeof Ro,
  canvas: HTMLCanvasElement | null,
  coltech: RetainedGrid,
  colors = { box: '#9db4d3', hit: '#24456f', now: '#c2410c', grid: '#d3d5da' },
) {
  /** By place. */
  const touched = new Map<string, Touched>();
  /** Changes since the last step that took time. */
  const since = { moved: 0, changes: [] as RetainedGrid['changes'] };
  /** Averages per step. */
  const work = { moved: 0, changed: 0 };

  const world = new ro.World(canvas, {
    coltech,

    draw(ctx) {
      lightCells(ctx, touched.values(), coltech.cellSize, colors.now);
      drawLines(ctx, width, height, coltech.cellSize, colors.grid);
      for (const entity of this.entities) entity.draw(colors.box);
    },

    handleCollisions(_dt, pairs) {
      for (const entity of new Set(pairs.flat())) entity.draw(colors.hit);
    },

    update(dt) {
      for (const entity of this.entities) turnRound(entity, width, height);
      since.moved += coltech.moved;
      since.changes.push(...coltech.changes);
      if (dt > 0) account();
    },
  });

  const { x: width, y: height } = world.screen?.size ?? { x: 480, y: 360 };

  const velocities = addBoxes(ro, world, width, height);
  world.step(0); // all boxes enter their cells, which does not count
  since.moved = 0;
  since.changes = [];

  /** Lights the changed cells, and updates the averages. */
  function account() {
    for (const [name, cell] of touched) if (++cell.age > FADE) touched.delete(name);
    for (const { column, row } of since.changes) touched.set(`${column}:${row}`, { column, row, age: 0 });
    work.moved += FOLLOW * (since.moved - work.moved);
    work.changed += FOLLOW * (since.changes.length - work.changed);
    since.moved = 0;
    since.changes = [];
  }

  /** Makes this share of the boxes move, from 0 to 1, and the others rest. */
  function move(share: number) {
    world.entities.forEach((entity, i) => {
      const { x, y } = i < share * COUNT ? velocities.get(entity)! : { x: 0, y: 0 };
      entity.ppos = { x: entity.pos.x - x, y: entity.pos.y - y };
    });
  }

  /** Makes the averages those of the boxes that move now, by some steps at once. */
  function settle() {
    const sum = { moved: 0, changed: 0 };
    world.step(); // still counts changes from before
    for (let i = 0; i < ENOUGH; i++) {
      work.moved = work.changed = 0;
      world.step();
      sum.moved += work.moved / FOLLOW;
      sum.changed += work.changed / FOLLOW;
    }
    work.moved = sum.moved / ENOUGH;
    work.changed = sum.changed / ENOUGH;
  }

  return { world, move, settle, work };
}

/** Returns the velocity of each box when it moves. */
function addBoxes(ro: typeof Ro, world: Ro.World, width: number, height: number) {
  const random = createRandom(9);
  const velocities = new Map<Ro.Entity, Ro.Vector>();
  for (let i = 0; i < COUNT; i++) {
    const side = 6 + 10 * random();
    const entity = new ro.Entity(random() * (width - side), random() * (height - side), side, side);
    velocities.set(entity, { x: SPEED * (2 * random() - 1), y: SPEED * (2 * random() - 1) });
    world.addEntity(entity);
  }
  return velocities;
}

/** Cells that have just changed are the brightest. */
function lightCells(ctx: CanvasRenderingContext2D, touched: Iterable<Touched>, size: number, color: string) {
  ctx.fillStyle = color;
  for (const { column, row, age } of touched) {
    ctx.globalAlpha = 0.35 * (1 - age / FADE);
    ctx.fillRect(column * size, row * size, size, size);
  }
  ctx.globalAlpha = 1;
}

function drawLines(ctx: CanvasRenderingContext2D, width: number, height: number, size: number, color: string) {
  ctx.strokeStyle = color;
  ctx.lineWidth = 1;
  ctx.beginPath();
  for (let x = size; x < width; x += size) ctx.rect(x, 0, 0, height);
  for (let y = size; y < height; y += size) ctx.rect(0, y, width, 0);
  ctx.stroke();
}
