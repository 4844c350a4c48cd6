// Two scenes: a heap, where most pairs of boxes touch, and a swarm in the air, where few do and all move.
import Matter from 'matter-js';

const { Bodies, Body, Composite, Engine } = Matter;

/** Boxes and circles fall between walls. */
export function createHeap(count) {
  const engine = Engine.create();
  const width = 20 * Math.sqrt(count);
  const still = { isStatic: true };
  Composite.add(engine.world, [
    Bodies.rectangle(width / 2, 25, width + 100, 50, still),
    Bodies.rectangle(-25, -width, 50, 2 * width, still),
    Bodies.rectangle(width + 25, -width, 50, 2 * width, still),
  ]);
  const columns = Math.floor(width / 16);
  for (let k = 0; k < count; k++) {
    const [x, y] = [12 + 16 * (k % columns) + (k % 7), -16 * Math.floor(k / columns) - 10];
    const body = k % 2 ? Bodies.circle(x, y, 6 + (k % 3)) : Bodies.rectangle(x, y, 10 + (k % 5), 12);
    if (k % 50 === 0) body.collisionFilter.group = -1;
    Composite.add(engine.world, body);
  }
  const wheel = Body.create({
    parts: [Bodies.rectangle(width / 2, -500, 120, 10), Bodies.rectangle(width / 2, -500, 10, 120)],
  });
  Composite.add(engine.world, wheel);
  return engine;
}

/** Fast circles and boxes without gravity. */
export function createSwarm(count) {
  const engine = Engine.create({ gravity: { x: 0, y: 0 } });
  const width = 30 * Math.sqrt(count);
  for (let k = 0; k < count; k++) {
    const [x, y] = [(k * 0.618034 * width) % width, (k * 0.754878 * width) % width];
    const body = k % 2 ? Bodies.circle(x, y, 4) : Bodies.rectangle(x, y, 8, 8);
    body.frictionAir = 0;
    Body.setVelocity(body, { x: 6 * Math.cos(k), y: 6 * Math.sin(k) });
    Composite.add(engine.world, body);
  }
  return engine;
}
