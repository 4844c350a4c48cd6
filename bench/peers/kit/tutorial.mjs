// Boxes as in tutorials: one object each.

export function objects(count) {
  return Array.from({ length: count }, (_, id) => ({ id, minX: 0, minY: 0, minZ: 0, maxX: 0, maxY: 0, maxZ: 0 }));
}

/** Writes a frame into the objects. */
export function fill(entities, boxes, dimensions) {
  let k = 0;
  for (const entity of entities) {
    entity.minX = boxes[k];
    entity.minY = boxes[k + 1];
    if (dimensions === 3) {
      entity.minZ = boxes[k + 2];
      entity.maxZ = boxes[k + 5];
    }
    entity.maxX = boxes[k + dimensions];
    entity.maxY = boxes[k + dimensions + 1];
    k += 2 * dimensions;
  }
}
