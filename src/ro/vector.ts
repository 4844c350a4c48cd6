/** Anything with an x and a y: positions, sizes and directions are plain objects, not instances of a class. */
export interface Vector {
  x: number;
  y: number;
}
