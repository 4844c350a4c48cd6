// A crowd: boxes that drift, and turn back at the edge of the world. Those that collide are darker.
import type { ro as Ro } from 'broadphase/ro';
import { createRandom } from '../../../src/scenes/random.ts';

export interface Crowd {
  count: number;
  /** The sides of the smallest and the largest box. */
  sides: [smallest: number, largest: number];
  /** The most that a box drifts per step. */
  speed: number;
  /** Whether the technique's structure is drawn over the boxes. */
  structure?: boolean;
}

export function crowd(
  ro: typeof Ro,
  canvas: HTMLCanvasElement | null,
  coltech: Ro.coltech.Technique,
  { count, sides: [smallest, largest], speed, structure = false }: Crowd,
  colors = { box: '#9db4d3', hit: '#24456f', accent: '#3f5bd9' },
) {
  let pairCount = 0;

  const world = new ro.World(canvas, {
    coltech,

    draw() {
      for (const entity of this.entities) entity.draw(colors.box);
    },

    handleCollisions(_dt, pairs) {
      pairCount = pairs.length;
      const colliding = new Set(pairs.flat());
      for (const entity of colliding) entity.draw(colors.hit);

      if (structure && this.screen) {
        this.screen.ctx.strokeStyle = colors.accent;
        this.screen.ctx.lineWidth = 1;
        coltech.draw?.(this.screen.ctx);
      }
    },

    update() {
      for (const entity of this.entities) turnRound(entity, width, height);
    },
  });

  const { x: width, y: height } = world.screen?.size ?? { x: 480, y: 360 };
  const random = createRandom(7);

  function add() {
    // Many small ones and few large ones: a power of a random number between 0 and 1 is mostly small.
    const side = () => smallest + (largest - smallest) * random() ** 3;
    const entity = new ro.Entity(0, 0, side(), side());
    entity.pos = { x: random() * (width - entity.size.x), y: random() * (height - entity.size.y) };
    entity.ppos = { x: entity.pos.x + speed * (2 * random() - 1), y: entity.pos.y + speed * (2 * random() - 1) };
    world.addEntity(entity);
  }

  /** Changes the number of boxes. */
  function resize(size: number) {
    while (world.entities.length < size) add();
    for (const entity of world.entities.slice(size)) world.removeEntity(entity);
  }

  resize(count);
  return {
    world,
    resize,
    get pairCount() {
      return pairCount;
    },
  };
}

/** Turns back an entity that is leaving. Its velocity is pos - ppos, so the two are swapped. */
export function turnRound({ pos, ppos, size }: Ro.Entity, width: number, height: number): void {
  const { x, y } = ppos;
  if (pos.x < x ? pos.x < 0 : pos.x + size.x > width) [pos.x, ppos.x] = [x, pos.x];
  if (pos.y < y ? pos.y < 0 : pos.y + size.y > height) [pos.y, ppos.y] = [y, pos.y];
}
