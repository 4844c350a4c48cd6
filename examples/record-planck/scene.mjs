// Boxes and circles fall onto a seesaw on a ground of edges.
import { Box, Chain, Circle, RevoluteJoint, Vec2, World } from 'planck';

export function createScene(count = 200) {
  const world = new World({ gravity: new Vec2(0, -10) });
  const ground = world.createBody();
  ground.createFixture(new Chain(Array.from({ length: 41 }, (_, k) => new Vec2(k - 20, (k % 3) / 4))));
  const plank = world.createDynamicBody({ position: new Vec2(0, 3) });
  plank.createFixture(new Box(6, 0.2), { density: 1 });
  world.createJoint(new RevoluteJoint({}, ground, plank, new Vec2(0, 3)));
  for (let k = 0; k < count; k++) {
    const body = world.createDynamicBody({ position: new Vec2(((k * 7) % 17) - 8 + k / 500, 6 + Math.floor(k / 17)) });
    body.createFixture(k % 2 ? new Circle(0.2 + (k % 5) / 20) : new Box(0.2 + (k % 4) / 16, 0.3), { density: 1 });
  }
  return world;
}
