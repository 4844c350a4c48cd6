// Records a Rapier world (3D): the box of every collider, computed from its shape, since Rapier does not expose its
// own. In your game: `const recorded = recordRapier(world)`, then `recorded.frame()` after each `world.step()`.
import { ShapeType } from '@dimforge/rapier3d-compat';
import { BroadPhase } from 'broadphase';
import { record } from 'broadphase/trace';

/** @param {import('@dimforge/rapier3d-compat').World} world */
export function recordRapier(world) {
  const space = new BroadPhase({ dimensions: 3 });
  const recording = record(space);
  /** By handle, which is a double, the id, a small integer. @type {Map<number, number>} */
  let known = new Map();
  let next = 0;
  return {
    space,
    recording,
    /** The id of a collider in the recording. */
    idOf: (collider) => known.get(collider.handle),
    frame() {
      const now = new Map();
      world.forEachCollider((collider) => {
        if (!collider.isEnabled()) return;
        const id = known.get(collider.handle) ?? next++;
        now.set(collider.handle, id);
        space.set(id, ...boxOf(collider));
        const groups = collider.collisionGroups(); // its groups in the upper half, those that it meets in the lower
        space.setFilter(id, groups >>> 16, groups & 0xffff);
        space.setStatic(id, collider.parent()?.isFixed() ?? true);
      });
      for (const [handle, id] of known) if (!now.has(handle)) space.delete(id);
      known = now;
      space.update();
    },
    stop: () => recording.stop(),
    download: (name = 'rapier.trace') => recording.download(name),
  };
}

/** Minima, then maxima. */
export function boxOf(collider) {
  const { x, y, z } = collider.translation();
  const rows = rotationOf(collider.rotation());
  const { shape } = collider;
  if (shape.vertices) {
    // Meshes, convex hulls, segments: from all corners.
    const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
    for (let k = 0; k < shape.vertices.length; k += 3) {
      rows.forEach((row, axis) => {
        const at = row[0] * shape.vertices[k] + row[1] * shape.vertices[k + 1] + row[2] * shape.vertices[k + 2];
        box[axis] = Math.min(box[axis], at);
        box[axis + 3] = Math.max(box[axis + 3], at);
      });
    }
    return grown(box, [x, y, z], shape.borderRadius ?? 0);
  }
  const reach = rows.map((row) => reachOf(shape, row));
  return grown([...reach.map((r) => -r), ...reach], [x, y, z], shape.borderRadius ?? 0);
}

const grown = (box, place, by) => box.map((side, k) => place[k % 3] + side + (k < 3 ? -by : by));

/** How far a shape reaches from its centre along an axis of the world, which is `row` in the shape's coordinates. */
function reachOf(shape, row) {
  switch (shape.type) {
    case ShapeType.Ball:
      return shape.radius;
    case ShapeType.Cuboid:
    case ShapeType.RoundCuboid: {
      const { x, y, z } = shape.halfExtents;
      return Math.abs(row[0]) * x + Math.abs(row[1]) * y + Math.abs(row[2]) * z;
    }
    case ShapeType.Capsule:
      return Math.abs(row[1]) * shape.halfHeight + shape.radius;
    case ShapeType.Cylinder:
    case ShapeType.RoundCylinder:
    case ShapeType.Cone: // within its cylinder
    case ShapeType.RoundCone:
      return Math.abs(row[1]) * shape.halfHeight + Math.hypot(row[0], row[2]) * shape.radius;
    default:
      return Infinity; // half spaces and height fields: add a case if yours are smaller
  }
}

/** The rows of the matrix of a rotation. */
function rotationOf({ x, y, z, w }) {
  return [
    [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
    [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
    [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
  ];
}
