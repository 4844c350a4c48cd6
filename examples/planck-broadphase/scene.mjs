// Two scenes: a heap, where most pairs of boxes touch, and a swarm in the air, where few do and all move.
import { Box, Chain, Circle, Vec2 } from 'planck';

export function fillHeap(world, count) {
  world.setGravity(new Vec2(0, -10));
  const width = Math.sqrt(count);
  const corners = [new Vec2(-width, 4 * width), new Vec2(-width, 0), new Vec2(width, 0), new Vec2(width, 4 * width)];
  world.createBody().createFixture(new Chain(corners));
  const columns = Math.floor(1.9 * width);
  for (let k = 0; k < count; k++) {
    const place = new Vec2(-0.95 * width + (k % columns) + 0.2 * Math.sin(k), 0.6 + 1.1 * Math.floor(k / columns));
    const body = world.createDynamicBody({ position: place });
    body.createFixture(k % 2 ? new Circle(0.4) : new Box(0.4, 0.35), { density: 1 });
  }
}

export function fillSwarm(world, count) {
  const width = 3 * Math.sqrt(count);
  for (let k = 0; k < count; k++) {
    const body = world.createDynamicBody({
      position: new Vec2((k * 0.618034 * width) % width, (k * 0.754878 * width) % width),
      linearVelocity: new Vec2(20 * Math.cos(k), 20 * Math.sin(k)),
    });
    body.createFixture(k % 2 ? new Circle(0.4) : new Box(0.4, 0.4), { density: 1 });
  }
}
