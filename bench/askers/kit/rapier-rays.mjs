// What the adapters for rapier's query pipeline share. Colliders have no bodies and their groups meet nobody, so a step
// does little more than update the structure for ray casts. It computes in float32, from centres and half sizes.
import { reach } from '../../harness/queries.mjs';

/** A member of group 0 that meets no group. */
const nobody = 0x00010000;

export async function rapierRays(RAPIER, { dimensions, count, boxes }) {
  await RAPIER.init();
  const world = new RAPIER.World({ x: 0, y: 0, z: 0 });
  const stride = 2 * dimensions;
  const place = { x: 0, y: 0, z: 0 };
  const half = { x: 0, y: 0, z: 0 };
  const axes = ['x', 'y', 'z'].slice(0, dimensions);
  function read(frame, at) {
    for (let axis = 0; axis < dimensions; axis++) {
      half[axes[axis]] = (frame[at + axis + dimensions] - frame[at + axis]) / 2;
      place[axes[axis]] = (frame[at + axis + dimensions] + frame[at + axis]) / 2;
    }
  }
  const ids = new Map();
  const colliders = Array.from({ length: count }, (_, id) => {
    read(boxes, stride * id);
    const description = RAPIER.ColliderDesc.cuboid(half.x, half.y, half.z)
      .setTranslation(...axes.map((name) => place[name]))
      .setCollisionGroups(nobody);
    const collider = world.createCollider(description);
    ids.set(collider.handle, id);
    return collider;
  });
  const origin = { x: 0, y: 0, z: 0 };
  const direction = { x: 0, y: 0, z: 0 };
  const ray = new RAPIER.Ray(origin, direction);
  return {
    update(frame) {
      for (let id = 0; id < count; id++) {
        read(frame, stride * id);
        colliders[id].setTranslation(place);
      }
      world.step();
    },
    rayCast(q, at) {
      let sum = 0;
      for (let axis = 0; axis < dimensions; axis++) {
        origin[axes[axis]] = q[at + axis];
        direction[axes[axis]] = q[at + dimensions + axis];
        sum += q[at + dimensions + axis] ** 2;
      }
      const hit = world.castRay(ray, reach / Math.sqrt(sum), true);
      return hit === null ? [] : [ids.get(hit.collider.handle)];
    },
  };
}
