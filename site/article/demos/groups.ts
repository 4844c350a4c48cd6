// Groups that care about each other or not. All boxes are in one space. For each, a filter says what it is (its layer)
// and what it cares about (its mask). A pair is found if the layer of each is in the mask of the other.
import { findPairs } from 'broadphase';
import type { ro as Ro } from 'broadphase/ro';
import { createRandom } from '../../../src/scenes/random.ts';
import { turnRound } from './crowd.ts';

/** One bit each. */
const LAYERS = { players: 1, powerUps: 2, enemies: 4 };
export type Group = keyof typeof LAYERS;
export type Question = readonly [one: Group, other: Group];

export function groups(
  ro: typeof Ro,
  canvas: HTMLCanvasElement | null,
  coltech: Ro.coltech.BroadPhase,
  colors = { box: '#9db4d3', accent: '#3f5bd9', now: '#c2410c', text: '#17181b' },
) {
  const members: Record<Group, Ro.Entity[]> = { players: [], powerUps: [], enemies: [] };
  let pairCount = 0;

  const world = new ro.World(canvas, {
    coltech,

    handleCollisions(_dt, pairs) {
      pairCount = pairs.length;
      if (this.screen) mark(this.screen.ctx, pairs);
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

  /** Draws a frame around each box of a pair, and a line between the two. */
  function mark(ctx: CanvasRenderingContext2D, found: Ro.coltech.Pair<Ro.Entity>[]) {
    ctx.strokeStyle = colors.text;
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

  /** From now on, finds the pairs of these questions and no others. */
  function ask(questions: Iterable<Question>) {
    const masks = { players: 0, powerUps: 0, enemies: 0 };
    for (const [one, other] of questions) {
      masks[one] |= LAYERS[other];
      masks[other] |= LAYERS[one];
    }
    for (const group of ['players', 'powerUps', 'enemies'] as const) {
      for (const entity of members[group]) coltech.space.setFilter(coltech.idOf(entity), LAYERS[group], masks[group]);
    }
  }

  return {
    world,
    ask,
    /** Counts the pairs without filters. */
    countAll: () => countPairs(world.entities),
    get pairCount() {
      return pairCount;
    },
  };
}

function countPairs(entities: readonly Ro.Entity[]): number {
  const boxes = entities.flatMap((entity) => {
    const { min, max } = entity.getAABB();
    return [...min, ...max];
  });
  return findPairs(boxes).length / 2;
}
