// Pixel masks of pictures: two touch if both have a solid pixel in the same place. Pixels are at whole numbers, and
// only those in the intersection of the two boxes are tested.

/** A mask from rows of text, in which everything but a space is solid. The first row is the topmost. */
export function maskOf(rows) {
  const width = Math.max(...rows.map((row) => row.length));
  const solid = new Uint8Array(width * rows.length);
  for (const [y, row] of rows.entries()) {
    for (let x = 0; x < row.length; x++) if (row[x] !== ' ') solid[y * width + x] = 1;
  }
  return { width, height: rows.length, solid };
}

/** A mask from the pixels of a picture (ImageData). Pixels with at least this alpha are solid. */
export function maskOfImage({ width, height, data }, alpha = 128) {
  return {
    width,
    height,
    solid: Uint8Array.from({ length: width * height }, (_, k) => Number(data[4 * k + 3] >= alpha)),
  };
}

/** Whether mask `a` with its corner at (ax, ay) and mask `b` at (bx, by) have a solid pixel in common. */
export function masksTouch(a, ax, ay, b, bx, by) {
  const [left, top] = [Math.max(ax, bx), Math.max(ay, by)];
  const [right, bottom] = [Math.min(ax + a.width, bx + b.width), Math.min(ay + a.height, by + b.height)];
  for (let y = top; y < bottom; y++) {
    const inA = (y - ay) * a.width - ax;
    const inB = (y - by) * b.width - bx;
    for (let x = left; x < right; x++) if (a.solid[inA + x] & b.solid[inB + x]) return true;
  }
  return false;
}
