// Three small worlds, each with a frame as in a game, from pairs of boxes to exact results. `move()` moves everything.
// `broad()` gives the boxes to the space, which finds their pairs. `narrow()` finds those that really touch, the `hits`,
// as [a, b, a, b, …]. `react()` reacts to them.
import { BroadPhase } from 'broadphase';
import { maskOf, masksTouch } from './pixel-masks.mjs';
import { boundsOf, circle, contactOf, polygon } from './separating-axes.mjs';
import { meeting } from './swept-boxes.mjs';

/** Side of the world. */
export const world = 200;

/** Pseudorandom numbers, the same for the same seed. */
function dice(seed) {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

/** Keeps a place within the world: turns the speed around at its border. */
const bounced = (at, speed, reach) => (at < reach ? Math.abs(speed) : at > world - reach ? -Math.abs(speed) : speed);

/** Turning polygons and circles, which push each other apart. */
export function shapes(count = 60, seed = 1) {
  const random = dice(seed);
  const space = new BroadPhase();
  const things = Array.from({ length: count }, (_, id) => {
    const size = 4 + 6 * random();
    const sides = 3 + (id % 4);
    const corners = Array.from({ length: sides }, (_, k) => {
      const angle = (2 * Math.PI * k) / sides;
      return [size * Math.cos(angle), size * Math.sin(angle)];
    });
    const shape = id % 5 === 0 ? circle(size) : polygon(corners);
    shape.pos.x = size + random() * (world - 2 * size);
    shape.pos.y = size + random() * (world - 2 * size);
    const [dx, dy, turn] = [random() - 0.5, random() - 0.5, 0.04 * (random() - 0.5)];
    return { shape, size, dx, dy, turn, box: [0, 0, 0, 0] };
  });
  const hits = [];
  /** For each hit: the direction from `a` to `b`, and the depth. */
  const contacts = [];
  return {
    space,
    things,
    hits,
    move() {
      for (const thing of things) {
        const { shape, size } = thing;
        thing.dx = bounced(shape.pos.x, thing.dx, size);
        thing.dy = bounced(shape.pos.y, thing.dy, size);
        shape.pos.x += thing.dx;
        shape.pos.y += thing.dy;
        if (shape.setAngle) shape.setAngle(shape.angle + thing.turn);
        boundsOf(shape, thing.box);
      }
    },
    broad() {
      for (const [id, { box }] of things.entries()) space.set(id, box[0], box[1], box[2], box[3]);
      space.update();
    },
    narrow() {
      hits.length = contacts.length = 0;
      const { pairs } = space;
      for (let k = 0; k < pairs.length; k += 2) {
        const [a, b] = [things[pairs[k]], things[pairs[k + 1]]];
        const contact = contactOf(a.shape, b.shape);
        if (!contact) continue;
        hits.push(pairs[k], pairs[k + 1]);
        contacts.push({ out: { x: contact.overlapN.x, y: contact.overlapN.y }, depth: contact.overlap });
      }
    },
    /** Pushes shapes apart a little each frame, and turns them away from each other. */
    react() {
      for (const [k, { out, depth }] of contacts.entries()) {
        const [a, b] = [things[hits[2 * k]], things[hits[2 * k + 1]]];
        const push = Math.min(0.25, depth / 4);
        a.shape.pos.x -= out.x * push;
        a.shape.pos.y -= out.y * push;
        b.shape.pos.x += out.x * push;
        b.shape.pos.y += out.y * push;
        const toward = (a.dx - b.dx) * out.x + (a.dy - b.dy) * out.y;
        if (toward <= 0) continue;
        a.dx -= toward * out.x;
        a.dy -= toward * out.y;
        b.dx += toward * out.x;
        b.dy += toward * out.y;
      }
    },
  };
}

const ring = ['   #######   ', '  #########  ', ' ####   #### ', '###       ###', '###       ###', '##         ##'];
const pictures = [
  maskOf([...ring, ...ring.toReversed()]),
  maskOf([
    '#            ',
    '##           ',
    '####         ',
    '######       ',
    '########     ',
    '##########   ',
    '#############',
  ]),
  maskOf([
    '      #      ',
    '     ###     ',
    '     ###     ',
    '#############',
    '  #########  ',
    '   #######   ',
    '  ####  ###  ',
    ' ##       ## ',
  ]),
];

/** Pictures that drift over each other: their boxes overlap far more often than their solid pixels. */
export function masks(count = 60, seed = 2) {
  const random = dice(seed);
  const space = new BroadPhase();
  const things = Array.from({ length: count }, (_, id) => {
    const mask = pictures[id % pictures.length];
    const place = () => 13 + random() * (world - 26);
    return { mask, x: place(), y: place(), dx: random() - 0.5, dy: random() - 0.5, left: 0, top: 0 };
  });
  const hits = [];
  return {
    space,
    things,
    hits,
    move() {
      for (const thing of things) {
        const { mask } = thing;
        thing.dx = bounced(thing.x, thing.dx, 13);
        thing.dy = bounced(thing.y, thing.dy, 13);
        thing.x += thing.dx;
        thing.y += thing.dy;
        // The pixels are at whole numbers, so the box is too.
        thing.left = Math.round(thing.x - mask.width / 2);
        thing.top = Math.round(thing.y - mask.height / 2);
      }
    },
    broad() {
      for (const [id, { mask, left, top }] of things.entries()) {
        // One pixel smaller than the picture, so that neighbours do not touch.
        space.set(id, left, top, left + mask.width - 1, top + mask.height - 1);
      }
      space.update();
    },
    narrow() {
      hits.length = 0;
      const { pairs } = space;
      for (let k = 0; k < pairs.length; k += 2) {
        const [a, b] = [things[pairs[k]], things[pairs[k + 1]]];
        if (masksTouch(a.mask, a.left, a.top, b.mask, b.left, b.top)) hits.push(pairs[k], pairs[k + 1]);
      }
    },
    react() {},
  };
}

const bullets = 1;
const targets = 2;
/** How far a bullet flies in one frame: 40 of its own widths. */
const speed = 40;

/** Bullets too fast for a test once per frame, and moving targets: each bullet hits the first one on its path. */
export function fastBoxes(count = 60, seed = 3) {
  const random = dice(seed);
  const space = new BroadPhase();
  const things = Array.from({ length: count }, (_, id) => {
    const isBullet = id % 3 === 0;
    const [width, height] = isBullet ? [1, 1] : [2 + 4 * random(), 4 + 10 * random()];
    const x = random() * (world - width);
    const y = random() * (world - height);
    const angle = 2 * Math.PI * random();
    const way = isBullet ? [speed * Math.cos(angle), speed * Math.sin(angle)] : [random() - 0.5, random() - 0.5];
    return { isBullet, box: [x, y, x + width, y + height], way, time: 1, first: -1 };
  });
  for (const [id, { isBullet, box }] of things.entries()) {
    space.set(id, ...box).setFilter(id, isBullet ? bullets : targets, isBullet ? targets : bullets);
  }
  const hits = [];
  return {
    space,
    things,
    hits,
    move() {
      for (const thing of things) {
        const { box, way } = thing;
        thing.time = 1;
        thing.first = -1;
        for (let k = 0; k < 2; k++) way[k] = bounced(box[k], way[k], thing.isBullet ? 1 : 15);
      }
    },
    broad() {
      for (const [id, { box, way }] of things.entries()) {
        space.setSwept(id, box[0], box[1], box[2], box[3], way[0], way[1]);
      }
      space.update();
    },
    narrow() {
      hits.length = 0;
      const { pairs } = space;
      for (let k = 0; k < pairs.length; k += 2) {
        const [a, b] = [things[pairs[k]], things[pairs[k + 1]]];
        const [bullet, target] = a.isBullet ? [a, pairs[k + 1]] : [b, pairs[k]];
        const met = meeting(a.box, a.way, b.box, b.way);
        if (!met) continue;
        hits.push(pairs[k], pairs[k + 1]);
        if (met.time < bullet.time || bullet.first < 0) {
          bullet.time = met.time;
          bullet.first = target;
        }
      }
    },
    /** A bullet flies until it hits something, and back from there. */
    react() {
      for (const { box, way, time, first } of things) {
        for (let k = 0; k < 4; k++) box[k] += way[k % 2] * (first < 0 ? 1 : time);
        if (first >= 0) way[0] = -way[0];
      }
    },
  };
}
