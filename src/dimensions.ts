// The types that depend on how many axes a space has: a box of four numbers in a 3D space is an error when compiled.

/** How many axes boxes have. */
export type Dimensions = 2 | 3;

/** Numbers of many things in one array, one thing after the other: points, rays, planes and so on. */
export type Numbers = Float32Array | Float64Array | readonly number[];

/** The numbers of a box: minima, then maxima. */
export type Box<D extends Dimensions> = D extends 2
  ? [minX: number, minY: number, maxX: number, maxY: number]
  : [minX: number, minY: number, minZ: number, maxX: number, maxY: number, maxZ: number];

/** An id and the numbers of its box. */
export type BoxOfId<D extends Dimensions> = [id: number, ...Box<D>];

/** An id, the centre of its box, and half the size along each axis. */
export type CentredBoxOfId<D extends Dimensions> = D extends 2
  ? [id: number, ...Point<2>, halfWidth: number, halfHeight: number]
  : [id: number, ...Point<3>, halfWidth: number, halfHeight: number, halfDepth: number];

/** The numbers of a box and how far it moves along each axis. */
export type MovingBox<D extends Dimensions> = D extends 2
  ? [...Box<2>, dx: number, dy: number]
  : [...Box<3>, dx: number, dy: number, dz: number];

/** An id, the numbers of its box, and how far it moves along each axis. */
export type MovingBoxOfId<D extends Dimensions> = [id: number, ...MovingBox<D>];

/** The coordinates of a point. */
export type Point<D extends Dimensions> = D extends 2 ? [x: number, y: number] : [x: number, y: number, z: number];

/** The origin and the direction of a ray. */
export type Ray<D extends Dimensions> = D extends 2
  ? [...Point<2>, directionX: number, directionY: number]
  : [...Point<3>, directionX: number, directionY: number, directionZ: number];

/** The arguments of `queryBox`: a box, and options. */
export type BoxQuery<D extends Dimensions, Options> = D extends 2
  ? [...Box<2>, options?: Options]
  : [...Box<3>, options?: Options];
/** The arguments of `queryPoint`: a point, and options. */
export type PointQuery<D extends Dimensions, Options> = D extends 2
  ? [...Point<2>, options?: Options]
  : [...Point<3>, options?: Options];
/** The arguments of `rayCast` and `rayCastAll`: a ray, and options. */
export type RayQuery<D extends Dimensions, Options> = D extends 2
  ? [...Ray<2>, options?: Options]
  : [...Ray<3>, options?: Options];
/** The arguments of `sweep`: a moving box, and options. */
export type SweepQuery<D extends Dimensions, Options> = D extends 2
  ? [...MovingBox<2>, options?: Options]
  : [...MovingBox<3>, options?: Options];
/** The arguments of `nearest`: a point, how many boxes, and options. */
export type NearestQuery<D extends Dimensions, Options> = D extends 2
  ? [...Point<2>, k: number, options?: Options]
  : [...Point<3>, k: number, options?: Options];

/** The arguments of `queryCircle` and `querySphere`: a centre, a radius, and options. */
export type RoundQuery<D extends Dimensions, Options> = [...Point<D>, radius: number, options?: Options];
