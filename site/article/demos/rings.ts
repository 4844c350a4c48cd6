// Rings of squares at rest, and on each ring one that goes round. Squares that collide are darker. A click adds a ring,
// and so does the Enter key.
import type { ro as Ro } from 'broadphase/ro';

const SIDE = 10; // of a square, in pixels
const GAP = 22; // between two rings: wide enough that resting squares never touch
const SPEED = 0.0012; // of the movers, in radians per millisecond

export function rings(
  ro: typeof Ro,
  canvas: HTMLCanvasElement | null,
  coltech: Ro.coltech.Technique,
  colors = { box: '#9db4d3', hit: '#24456f' },
) {
  const movers: { square: Ro.Entity; radius: number; angle: number }[] = [];
  let pairCount = 0;

  const world = new ro.World(canvas, {
    coltech,

    draw() {
      for (const square of this.entities) square.draw(colors.box);
    },

    handleCollisions(_dt, pairs) {
      pairCount = pairs.length;
      for (const [a, b] of pairs) {
        a.draw(colors.hit);
        b.draw(colors.hit);
      }
    },

    update(dt) {
      for (const mover of movers) {
        mover.angle += SPEED * dt;
        mover.square.pos = onRing(mover.radius, mover.angle);
      }
    },
  });

  const { x: width, y: height } = world.screen?.size ?? { x: 400, y: 300 };

  function onRing(radius: number, angle: number) {
    return {
      x: (width - SIDE) / 2 + Math.cos(angle) * radius,
      y: (height - SIDE) / 2 + Math.sin(angle) * radius,
    };
  }

  function addSquare(radius: number, angle: number) {
    const { x, y } = onRing(radius, angle);
    const square = new ro.Entity(x, y, SIDE, SIDE);
    world.addEntity(square);
    return square;
  }

  function addRing() {
    const radius = GAP * (movers.length + 1);
    const count = Math.floor((Math.PI * radius) / SIDE); // two sides of ring for each square
    for (let i = 0; i < count; i++) addSquare(radius, (i / count) * 2 * Math.PI);
    movers.push({ square: addSquare(radius, 0), radius, angle: 0 });
  }

  function startOver() {
    for (const square of world.entities) world.removeEntity(square);
    movers.length = 0;
    addRing();
  }

  addRing();
  canvas?.addEventListener('click', addRing);
  canvas?.addEventListener('keydown', ({ key }) => {
    if (key === 'Enter') addRing();
  });
  return {
    world,
    addRing,
    startOver,
    get ringCount() {
      return movers.length;
    },
    get pairCount() {
      return pairCount;
    },
  };
}
