// Groups that care about each other or not. Each question has a search of its own, among those alone whom it is about;
// what nobody asks is not looked for.
import { findPairs, findPairsBetween } from 'broadphase';
import type { ro as Ro } from 'broadphase/ro';
import { createRandom } from '../../src/scenes/random.ts';
import { turnRound } from './crowd.ts';

export type Group = 'players' | 'powerUps' | 'enemies';
export type Question = readonly [one: Group, other: Group];

/** Everyone of one group who overlaps someone of the other or, where both are the same, one of its own. */
export function ask(members: Readonly<Record<Group, readonly Ro.Entity[]>>, [one, other]: Question) {
  const red = members[one];
  const blue = members[other];
  const found = one === other ? findPairs(boxesOf(red)) : findPairsBetween(boxesOf(red), boxesOf(blue));
  const pairs: [Ro.Entity, Ro.Entity][] = [];
  for (let i = 0; i < found.length; i += 2) pairs.push([red[found[i]], blue[found[i + 1]]]);
  return pairs;
}

/** The boxes of entities as the library takes them: minX, minY, maxX, maxY, one after the other. */
function boxesOf(entities: readonly Ro.Entity[]): Float64Array {
  return Float64Array.from(
    entities.flatMap((entity) => {
      const { min, max } = entity.getAABB();
      return [...min, ...max];
    }),
  );
}

export function groups(
  ro: typeof Ro,
  canvas: HTMLCanvasElement | null,
  coltech: Ro.coltech.Technique,
  colors = { box: '#9db4d3', hit: '#24456f', accent: '#3f5bd9', now: '#c2410c' },
) {
  const members: Record<Group, Ro.Entity[]> = { players: [], powerUps: [], enemies: [] };
  /** The questions that are asked. */
  const questions = new Set<Question>();
  let found: [Ro.Entity, Ro.Entity][] = [];
  let pairCount = 0; // of everyone with everyone: what is found without groups

  const world = new ro.World(canvas, {
    coltech,

    handleCollisions(_dt, pairs) {
      pairCount = pairs.length;
      found = [...questions].flatMap((question) => ask(members, question));
      if (this.screen) mark(this.screen.ctx);
    },

    draw() {
      for (const entity of members.enemies) entity.draw(colors.box);
      for (const entity of members.powerUps) entity.draw(colors.now);
      for (const entity of members.players) entity.draw(colors.accent);
    },

    update() {
      for (const entity of this.entities) turnRound(entity, width, height);
    },
  });

  /** A frame around everyone who was found, and a line from one to the other. */
  function mark(ctx: CanvasRenderingContext2D) {
    ctx.strokeStyle = colors.hit;
    ctx.lineWidth = 2;
    for (const [a, b] of found) {
      for (const { pos, size } of [a, b]) ctx.strokeRect(pos.x, pos.y, size.x, size.y);
      ctx.beginPath();
      ctx.moveTo(a.pos.x + a.halfSize.x, a.pos.y + a.halfSize.y);
      ctx.lineTo(b.pos.x + b.halfSize.x, b.pos.y + b.halfSize.y);
      ctx.stroke();
    }
  }

  const { x: width, y: height } = world.screen?.size ?? { x: 480, y: 360 };
  const random = createRandom(21);
  add('players', 5, 26, 2);
  add('powerUps', 30, 14, 0.3);
  add('enemies', 40, 22, 1);

  function add(group: Group, count: number, side: number, speed: number) {
    for (let i = 0; i < count; i++) {
      const entity = new ro.Entity(random() * (width - side), random() * (height - side), side, side);
      entity.ppos.x += speed * (2 * random() - 1);
      entity.ppos.y += speed * (2 * random() - 1);
      members[group].push(entity);
      world.addEntity(entity);
    }
  }

  return {
    world,
    questions,
    get found() {
      return found;
    },
    get pairCount() {
      return pairCount;
    },
  };
}
