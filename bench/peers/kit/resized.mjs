// Whether a box has another size than before. A box that only moves keeps its size but for the rounding of its two
// coordinates to float32, and that is not worth a new shape in a physics engine.

/** A little more than two roundings, as a share of the coordinate. */
const rounding = 3e-7;

export const resized = (before, after, coordinate) => Math.abs(after - before) > rounding * Math.abs(coordinate);
