// A player, power-ups to collect, and a crowd that only gets in the way. Each step answers two questions: which
// power-ups does the player touch, and does the guard touch the player? Other collisions are not needed.
import type { ro as Ro } from 'broadphase/ro';
import { createRandom } from '../../../src/scenes/random.ts';
import { turnRound } from './crowd.ts';

const REACH = 3.2; // the player's speed, in pixels per step

export function player(
  ro: typeof Ro,
  canvas: HTMLCanvasElement | null,
  coltech: Ro.coltech.BroadPhase,
  colors = { box: '#9db4d3', hit: '#24456f', accent: '#3f5bd9', now: '#c2410c' },
) {
  const random = createRandom(3);
  let pairCount = 0;
  let touched = 0; // power-ups in this step
  let collected = 0; // in all
  let caught = false;

  const world = new ro.World(canvas, {
    coltech,

    handleCollisions(_dt, pairs) {
      const { space } = coltech;
      pairCount = pairs.length;

      touched = 0;
      for (const id of space.collisionsOf(coltech.idOf(hero))) {
        const powerUp = powerUps.get(id);
        if (!powerUp) continue; // one of the crowd, or the guard
        touched++;
        collected++;
        scatter(powerUp);
      }
      caught = space.isColliding(coltech.idOf(guard), coltech.idOf(hero));
    },

    draw(ctx) {
      for (const entity of crowd) entity.draw(colors.box);
      for (const entity of powerUps.values()) entity.draw(colors.now);
      guard.draw(caught ? colors.now : colors.hit);
      hero.draw(colors.accent);
      ctx.strokeStyle = colors.accent;
      ctx.lineWidth = 2;
      ctx.strokeRect(hero.pos.x - 4, hero.pos.y - 4, hero.size.x + 8, hero.size.y + 8);
    },

    update() {
      steer(goal, hero, world.input);
      follow(ro, hero, goal, width, height);
      put(guard, guard.pos.x + 0.008 * (hero.pos.x - guard.pos.x), guard.pos.y + 0.008 * (hero.pos.y - guard.pos.y));
      for (const entity of this.entities) turnRound(entity, width, height);
    },
  });

  const { x: width, y: height } = world.screen?.size ?? { x: 480, y: 360 };
  const goal = { x: width / 2, y: height / 2 };
  const { hero, guard, powerUps, crowd } = populate(ro, world, coltech, random, scatter);
  put(hero, goal.x, goal.y);

  function scatter(entity: Ro.Entity) {
    put(entity, random() * (width - entity.size.x), random() * (height - entity.size.y));
  }

  return {
    world,
    get pairCount() {
      return pairCount;
    },
    get touched() {
      return touched;
    },
    get collected() {
      return collected;
    },
    get caught() {
      return caught;
    },
  };
}

/** Adds the player, the guard, the power-ups by their ids in the library's space, and the crowd. */
function populate(
  ro: typeof Ro,
  world: Ro.World,
  coltech: Ro.coltech.BroadPhase,
  random: () => number,
  scatter: (entity: Ro.Entity) => void,
) {
  const add = (side: number) => {
    const entity = new ro.Entity(0, 0, side, side);
    scatter(entity);
    world.addEntity(entity);
    return entity;
  };
  const hero = add(18);
  const guard = add(30);
  const powerUps = new Map<number, Ro.Entity>();
  for (let i = 0; i < 24; i++) {
    const powerUp = add(8);
    powerUps.set(coltech.idOf(powerUp), powerUp);
  }
  const crowd = Array.from({ length: 60 }, () => add(10 + 22 * random()));
  for (const { pos, ppos } of crowd) {
    ppos.x = pos.x + random() - 0.5;
    ppos.y = pos.y + random() - 0.5;
  }
  return { hero, guard, powerUps, crowd };
}

/** Places an entity without giving it a velocity. */
function put(entity: Ro.Entity, x: number, y: number) {
  entity.pos = { x, y };
  entity.ppos = { x, y };
}

/** The keys move the goal, or the pointer is the goal. */
function steer(goal: Ro.Vector, hero: Ro.Entity, input: Ro.World['input']) {
  if (input?.pointer.isOver) {
    goal.x = input.pointer.x - hero.size.x / 2;
    goal.y = input.pointer.y - hero.size.y / 2;
  }
  const key = (code: string) => Number(input?.isDown(code) ?? false);
  const keys = { x: key('ArrowRight') - key('ArrowLeft'), y: key('ArrowDown') - key('ArrowUp') };
  if (keys.x !== 0 || keys.y !== 0) {
    goal.x = hero.pos.x + keys.x * REACH;
    goal.y = hero.pos.y + keys.y * REACH;
  }
}

/** Moves the player towards the goal, within the world. */
function follow(ro: typeof Ro, hero: Ro.Entity, goal: Ro.Vector, width: number, height: number) {
  const { pos, size } = hero;
  const way = { x: goal.x - pos.x, y: goal.y - pos.y };
  const stride = Math.min(1, REACH / (ro.ov3.length(way) || 1));
  put(hero, within(pos.x + way.x * stride, width - size.x), within(pos.y + way.y * stride, height - size.y));
}

const within = (position: number, end: number) => Math.min(Math.max(position, 0), end);
