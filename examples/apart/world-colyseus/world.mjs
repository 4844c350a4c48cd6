// What all processes and clients know about the world: its size, its zones, and which ids are clients.
import { Zones } from 'broadphase/shard';

export const world = { width: 6000, height: 3000 };

/** How far an entity sees, along each axis. */
export const sight = 80;

/** Milliseconds from tick to tick. */
export const tickTime = 50;

/** The furthest an entity moves in a tick. */
const fastest = 6;

/** Ids below this are entities of clients; the others wander by themselves. */
export const avatars = 1000;

export const isAvatar = (id) => id < avatars;

/**
 * The world, cut along x. Every entity has a box as wide as its sight, so two boxes overlap if one sees the other. The
 * margin makes a zone see everything that entities whose box begins in it see.
 */
export function cutInto(count) {
  const x = Array.from({ length: count - 1 }, (_, k) => (world.width * (k + 1)) / count);
  return new Zones({ borders: { x }, margin: sight });
}

/** The box of an entity: as wide as its sight, around it. */
export const boxOf = ({ x, y }) => [x - sight / 2, y - sight / 2, x + sight / 2, y + sight / 2];

/** The zone of an entity at this place: the one that owns its box. */
export const zoneOf = (zones, place) => zones.ownerOf(boxOf(place));

/** The nearest x at which a place is of this zone. */
export function xInZone({ count }, zone, x) {
  const [from, to] = [zone, zone + 1].map((k) => (world.width * k) / count + sight / 2);
  return Math.min(to - 1, Math.max(from, x));
}

/** All entities at the beginning of the world, the same in every process. */
export function* beginnings(count) {
  let state = 20260101;
  const random = () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
  const turn = () => (2 * random() - 1) * fastest;
  for (let id = 0; id < count; id++) {
    yield { id, x: random() * world.width, y: random() * world.height, vx: turn(), vy: turn() };
  }
}

/** Moves an entity by a tick. `shut(x)` says whether no zone is there to take it over. */
export function move(entity, shut) {
  for (const [place, speed, size] of [
    ['x', 'vx', world.width],
    ['y', 'vy', world.height],
  ]) {
    let to = entity[place] + entity[speed];
    if (to < 0 || to > size || (place === 'x' && shut(to))) {
      entity[speed] = -entity[speed];
      to = Math.min(size, Math.max(0, entity[place]));
    }
    entity[place] = to;
  }
}
