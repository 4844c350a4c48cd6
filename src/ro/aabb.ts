// The axis-aligned bounding box (AABB): the one thing every collision technique knows about an entity.

/** The two opposite corners of a box, in absolute world coordinates: x grows to the right, y grows downwards. */
export interface AABB {
  /** The upper left corner. */
  min: [x: number, y: number];
  /** The lower right corner. */
  max: [x: number, y: number];
}

/** What a collision technique needs of a thing: who it is, and where. */
export interface Collidable {
  /** A number of its own, 0 or more, given by `World.addEntity`. */
  _roId: number;
  /** Its box, in absolute world units. */
  getAABB(): AABB;
}

/**
 * Throws unless the box can be compared with others. NaN has to be caught here: every comparison with it is false,
 * so brute force would call it a hit and a grid would find no cell for it.
 * @throws RangeError naming the entity and its box.
 */
export function checkAABB(entity: Collidable): void {
  const { min, max } = entity.getAABB();
  if (min[0] <= max[0] && min[1] <= max[1]) return;
  throw new RangeError(
    `entity ${entity._roId} has the AABB min [${min[0]}, ${min[1]}], max [${max[0]}, ${max[1]}]; ` +
      'expected numbers with min <= max on both axes',
  );
}
