// What a user saw: to remove 3,000 of 20,000 entities from a world of broadphase/ro took 1.3 s; and a loop over
// world.entities that adds to the world never ended.
import { coltech, Entity, World } from 'broadphase/ro';
import { expect, test } from 'vitest';

const techniques = {
  BruteForce: () => new coltech.BruteForce(),
  SpatialGrid: () => new coltech.SpatialGrid(0, 0, 100, 100, 10),
  BroadPhase: () => new coltech.BroadPhase(),
};

test.each(Object.entries(techniques))('%s: 60,000 entities are removed, first to last, in no time', (_, technique) => {
  const world = new World(null, { coltech: technique() });
  const entities = Array.from({ length: 60_000 }, (_, k) => new Entity(k % 100, 0, 1, 1));
  for (const entity of entities) world.addEntity(entity);
  const begun = performance.now();
  for (const entity of entities) world.removeEntity(entity);
  expect(performance.now() - begun).toBeLessThan(5000); // a minute and more before
  expect(world.entities).toEqual([]);
  expect(world.broadPhase.entities).toEqual([]);
});

test.each(Object.entries(techniques))('%s: a loop over the entities may add and remove', (_, technique) => {
  const world = new World(null, { coltech: technique() });
  for (let k = 0; k < 4; k++) world.addEntity(new Entity(10 * k, 0, 1, 1));
  for (const list of [world, world.broadPhase]) {
    let visits = 0;
    for (const entity of list.entities) {
      if (++visits > 100) break;
      world.removeEntity(entity);
      world.addEntity(new Entity(entity.pos.x + 1, 0, 1, 1));
    }
    expect(visits).toBe(4);
  }
  expect(world.entities.map(({ pos }) => pos.x)).toEqual([2, 12, 22, 32]);
  expect(world.broadPhase.entities).toEqual(world.entities);
  const before = world.entities;
  expect(world.entities).toBe(before);
  world.removeEntity(before[1]);
  expect(before).toHaveLength(4);
  expect(world.entities).toHaveLength(3);
});
