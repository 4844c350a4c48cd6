// Whether the size of a box has changed. A box that only moves keeps its size, except for the rounding of its
// coordinates to float32, which is not worth a new shape in a physics engine.

/** A little more than two roundings, as a share of the coordinate. */
const rounding = 3e-7;

export const resized = (before, after, coordinate) => Math.abs(after - before) > rounding * Math.abs(coordinate);
