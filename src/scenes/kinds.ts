// What tells the scenes apart: how large the boxes are, how densely they lie, where they start, how many move.
// A kind knows nothing of the number of dimensions: it fills one size and one place per axis.
import { normal, pareto, type Random } from './random.ts';

export interface Kind {
  /** Total area (3D: volume) of the boxes over that of the world. */
  readonly density: number;
  /** The share of boxes that move. */
  readonly moving: number;
  /** Writes the size of box `index` along each axis. */
  size(sizes: Float64Array, random: Random, index: number): void;
  /** Called once per scene; gives the function that writes where, from 0 to 1 along each axis, a box starts. */
  places(random: Random, dimensions: number): (place: Float64Array) => void;
}

const anywhere: Kind['places'] = (random) => (place) => {
  for (let axis = 0; axis < place.length; axis++) place[axis] = random();
};

/** Every box belongs to one of 20 clusters of Gaussian shape, each as wide (sigma) as 2 % of the world. */
const inClusters: Kind['places'] = (random, dimensions) => {
  const clusters = 20;
  const centres = Float64Array.from({ length: clusters * dimensions }, random);
  return (place) => {
    const centre = Math.floor(random() * clusters) * dimensions;
    for (let axis = 0; axis < dimensions; axis++) {
      place[axis] = Math.min(1, Math.max(0, centres[centre + axis] + 0.02 * normal(random)));
    }
  };
};

const ten: Kind['size'] = (sizes) => sizes.fill(10);

const oneInAThousandHuge: Kind['size'] = (sizes, random, index) =>
  sizes.fill(index % 1000 === 0 ? 250 + 500 * random() : 4 + 4 * random());

const longAlongOneAxis: Kind['size'] = (sizes, random) => {
  sizes.fill(1)[Math.floor(random() * sizes.length)] = 200;
};

export const kinds = {
  uniform: { density: 0.25, moving: 1, size: ten, places: anywhere },
  sparse: { density: 0.001, moving: 1, size: ten, places: anywhere },
  dense: { density: 4, moving: 1, size: ten, places: anywhere },
  mixed: {
    density: 0.5,
    moving: 1,
    size: (sizes, random) => sizes.fill(pareto(random, 2, 2000, 1.3)),
    places: anywhere,
  },
  giants: { density: 0.5, moving: 1, size: oneInAThousandHuge, places: anywhere },
  clustered: { density: 0.05, moving: 1, size: ten, places: inClusters },
  static: { density: 0.25, moving: 0.05, size: ten, places: anywhere },
  skewed: { density: 0.1, moving: 1, size: longAlongOneAxis, places: anywhere },
} satisfies Record<string, Kind>;
