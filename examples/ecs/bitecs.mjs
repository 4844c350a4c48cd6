// bitECS: components are arrays by entity, and an entity is the id of its box in the space. Its components decide
// whether the box is static, and which others it meets.
import { addComponent, addEntity, createWorld, observe, onRemove, query, removeEntity } from 'bitecs';
import { BroadPhase } from 'broadphase';

export const Position = { x: [], y: [] };
export const Velocity = { x: [], y: [] };
/** Half the width and half the height. */
export const Extent = { x: [], y: [] };

export function createGame() {
  const world = createWorld();
  const space = new BroadPhase();
  // An entity that is removed, or loses its extent, is removed from the space at once.
  observe(world, onRemove(Extent), (entity) => space.delete(entity));
  return { world, space };
}

export function spawn({ world }, x, y, halfWidth, halfHeight, vx = 0, vy = 0) {
  const entity = addEntity(world);
  for (const component of [Position, Velocity, Extent]) addComponent(world, entity, component);
  [Position.x[entity], Position.y[entity]] = [x, y];
  [Extent.x[entity], Extent.y[entity]] = [halfWidth, halfHeight];
  [Velocity.x[entity], Velocity.y[entity]] = [vx, vy];
  return entity;
}

export const despawn = ({ world }, entity) => removeEntity(world, entity);

export function moveSystem({ world }, dt) {
  for (const entity of query(world, [Position, Velocity])) {
    Position.x[entity] += Velocity.x[entity] * dt;
    Position.y[entity] += Velocity.y[entity] * dt;
  }
}

/** Returns all pairs of overlapping entities, as [a, b, a, b, …]. */
export function collisionSystem({ world, space }) {
  for (const entity of query(world, [Position, Extent])) {
    const [x, y] = [Position.x[entity], Position.y[entity]];
    const [halfWidth, halfHeight] = [Extent.x[entity], Extent.y[entity]];
    space.set(entity, x - halfWidth, y - halfHeight, x + halfWidth, y + halfHeight);
  }
  return space.update().pairs;
}
