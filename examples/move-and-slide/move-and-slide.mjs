// Moves a body through a world of boxes, in 2D or 3D: it stops at what it meets, and slides on along it.
// After a stop the body touches the face that it met. From there a move along the face, or away from it, meets nothing,
// and a move into it stops at once, with the face's normal. So the body walks over a floor of tiles, down a wall of
// tiles, and into a corner. It stops at most once per axis.

/**
 * Moves `body` by `way`, and returns the normals of the faces that it met: -1, 0 or 1 for each axis.
 *
 * @param space a BroadPhase, updated since the world changed
 * @param body its `position`, the least corner, and its `size`, both with one number per axis. They may be arrays or
 *   typed arrays.
 * @param way how far it moves along each axis, in this step; it is not changed
 * @param options those of `sweep`: `ignore` names the body's own box
 * @param met filled and returned
 */
export function moveAndSlide(space, body, way, options, met = []) {
  const { position, size } = body;
  const left = Array.from(way);
  for (let axis = 0; axis < left.length; axis++) met[axis] = 0;
  for (let stop = 0; stop <= left.length; stop++) {
    const hit = space.sweep(...position, ...left.map((_, axis) => position[axis] + size[axis]), ...left, options);
    advance(position, left, hit ? hit.time : 1);
    if (!hit) return met;
    const axis = hit.normal.findIndex((side) => side !== 0);
    if (axis < 0) return met; // inside a box from the start: see the guide
    met[axis] = hit.normal[axis];
    for (let k = 0; k < left.length; k++) left[k] *= k === axis ? 0 : 1 - hit.time;
  }
  return met;
}

/** Moves a body, and lets it bounce off what it meets: turns `velocity`, and returns whether it met anything. */
export function moveAndBounce(space, body, velocity, options) {
  const { position, size } = body;
  const hit = space.sweep(...position, ...velocity.map((_, axis) => position[axis] + size[axis]), ...velocity, options);
  advance(position, velocity, hit ? hit.time : 1);
  if (!hit) return false;
  for (let axis = 0; axis < velocity.length; axis++) if (hit.normal[axis] !== 0) velocity[axis] *= -1;
  return true;
}

/** Moves by a share of the way. If a Float32Array rounds the position past its target, takes the number before. */
function advance(position, way, time) {
  for (let axis = 0; axis < way.length; axis++) {
    const to = position[axis] + way[axis] * time;
    position[axis] = to;
    const beyond = (position[axis] - to) * way[axis] > 0;
    if (beyond) position[axis] = to - Math.sign(way[axis]) * Math.abs(to) * 2 ** -24;
  }
}
