// What the adapters of rapier2d and rapier3d share. Kinematic or fixed bodies, each with a sensor, are put in place.
// Then comes a whole step, since the broad phase cannot run alone. Its events tell which pairs begin and cease to
// overlap.
import { Contacts } from './contacts.mjs';
import { resized } from './resized.mjs';

export async function rapier(RAPIER, { dimensions, count, boxes, fixed = 0 }) {
  await RAPIER.init();
  const origin = { x: 0, y: 0, z: 0 };
  const world = new RAPIER.World(origin);
  const events = new RAPIER.EventQueue(true);
  const stride = 2 * dimensions;
  const sizes = new Float32Array(dimensions * count);
  const place = { x: 0, y: 0, z: 0 };
  const half = { x: 0, y: 0, z: 0 };
  const axes = ['x', 'y', 'z'].slice(0, dimensions);

  function read(frame, at) {
    for (let axis = 0; axis < dimensions; axis++) {
      half[axes[axis]] = (frame[at + axis + dimensions] - frame[at + axis]) / 2;
      place[axes[axis]] = (frame[at + axis + dimensions] + frame[at + axis]) / 2;
    }
  }

  /** Records the size that was read; returns whether it changed. */
  function grown(id) {
    let changed = false;
    for (let axis = 0, k = dimensions * id; axis < dimensions; axis++, k++) {
      const name = axes[axis];
      if (!resized(sizes[k], half[name], place[name])) continue;
      sizes[k] = half[name];
      changed = true;
    }
    return changed;
  }

  const ids = new Map();
  const bodies = [];
  const colliders = Array.from({ length: count }, (_, id) => {
    read(boxes, stride * id);
    grown(id);
    const description = RAPIER.ColliderDesc.cuboid(half.x, half.y, half.z)
      .setSensor(true)
      .setActiveCollisionTypes(RAPIER.ActiveCollisionTypes.ALL)
      .setActiveEvents(RAPIER.ActiveEvents.COLLISION_EVENTS);
    const { RigidBodyDesc } = RAPIER;
    const body = world.createRigidBody(id < fixed ? RigidBodyDesc.fixed() : RigidBodyDesc.kinematicPositionBased());
    body.setTranslation(place, false);
    bodies.push(body);
    const collider = world.createCollider(description, body);
    ids.set(collider.handle, id);
    return collider;
  });

  const contacts = new Contacts();
  const previous = boxes.slice();
  return {
    update(frame) {
      for (let id = 0, at = 0; id < count; id++, at += stride) {
        let moved = false;
        for (let k = at; k < at + stride; k++) moved ||= frame[k] !== previous[k];
        if (!moved) continue;
        read(frame, at);
        if (grown(id)) colliders[id].setHalfExtents(half);
        bodies[id].setTranslation(place, false);
      }
      previous.set(frame);
      world.step(events);
      events.drainCollisionEvents((a, b, began) => {
        contacts[began ? 'begin' : 'end'](ids.get(a), ids.get(b));
      });
      return contacts.find(frame, dimensions);
    },
    pairs: () => contacts.pairs(),
  };
}
