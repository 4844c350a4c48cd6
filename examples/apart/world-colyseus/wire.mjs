// Typed arrays as text and back, since messages over Redis are JSON.

export const pack = (array) => Buffer.from(array.buffer, array.byteOffset, array.byteLength).toString('base64');

export function unpack(text, Type) {
  const bytes = Buffer.from(text, 'base64');
  return new Type(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
}

export const packDelta = ({ from, to, ids, changes, boxes }) => ({
  from,
  to,
  ids: pack(ids),
  changes: pack(changes),
  boxes: pack(boxes),
});

export const unpackDelta = ({ from, to, ids, changes, boxes }) => ({
  from,
  to,
  ids: unpack(ids, Uint32Array),
  changes: unpack(changes, Uint8Array),
  boxes: unpack(boxes, Float64Array),
});

/** Entities with all their properties. */
export const packEntities = (entities) =>
  pack(Float64Array.from(entities.flatMap(({ id, x, y, vx, vy }) => [id, x, y, vx, vy])));

export function unpackEntities(text) {
  const numbers = unpack(text, Float64Array);
  return Array.from({ length: numbers.length / 5 }, (_, k) => {
    const [id, x, y, vx, vy] = numbers.subarray(5 * k);
    return { id, x, y, vx, vy };
  });
}
