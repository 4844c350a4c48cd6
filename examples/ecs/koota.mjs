// koota: traits of entities. The id of an entity, without its generation and world, is the id of its box in the space.
import { BroadPhase } from 'broadphase';
import { createWorld, trait } from 'koota';

export const Position = trait({ x: 0, y: 0 });
export const Velocity = trait({ x: 0, y: 0 });
/** Half the width and half the height. */
export const Extent = trait({ x: 0, y: 0 });

export function createGame() {
  const world = createWorld();
  const space = new BroadPhase();
  // An entity that is removed, or loses its extent, is removed from the space at once.
  world.onRemove(Extent, (entity) => space.delete(entity.id()));
  return { world, space };
}

export const spawn = ({ world }, x, y, halfWidth, halfHeight, vx = 0, vy = 0) =>
  world.spawn(Position({ x, y }), Velocity({ x: vx, y: vy }), Extent({ x: halfWidth, y: halfHeight }));

export const despawn = (_, entity) => entity.destroy();

export function moveSystem({ world }, dt) {
  world.query(Position, Velocity).updateEach(([position, velocity]) => {
    position.x += velocity.x * dt;
    position.y += velocity.y * dt;
  });
}

/** Returns all pairs of ids of overlapping entities, as [a, b, a, b, …]. */
export function collisionSystem({ world, space }) {
  world.query(Position, Extent).readEach(([{ x, y }, extent], entity) => {
    space.set(entity.id(), x - extent.x, y - extent.y, x + extent.x, y + extent.y);
  });
  return space.update().pairs;
}
