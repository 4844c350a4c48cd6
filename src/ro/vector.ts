/** Anything with an x and a y: positions, sizes and directions are plain objects, not instances of a class. */
export interface Vector {
  /** To the right. */
  x: number;
  /** Downwards. */
  y: number;
}
