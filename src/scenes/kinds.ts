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
  /**
   * Called once per scene; gives the function that writes between which walls, from 0 to 1 along each axis, a box stays:
   * low and high, axis by axis. It starts anywhere between them.
   */
  ranges(random: Random, dimensions: number): (range: Float64Array) => void;
}

const anywhere: Kind['ranges'] = () => (range) => {
  for (let k = 0; k < range.length; k++) range[k] = k % 2;
};

/**
 * Every box belongs to one of 20 clusters of Gaussian shape, each as wide (sigma) as 2 % of the world. A place that is
 * drawn between walls, which stand as far to both sides of the centre as a Gaussian point in space is from its own, is
 * Gaussian itself: so the cluster keeps its shape while its boxes fly to and fro.
 */
const inClusters: Kind['ranges'] = (random, dimensions) => {
  const clusters = 20;
  const centres = Float64Array.from({ length: clusters * dimensions }, random);
  return (range) => {
    const centre = Math.floor(random() * clusters) * dimensions;
    for (let axis = 0; axis < dimensions; axis++) {
      const reach = 0.02 * Math.hypot(normal(random), normal(random), normal(random));
      range[2 * axis] = Math.max(0, centres[centre + axis] - reach);
      range[2 * axis + 1] = Math.min(1, centres[centre + axis] + reach);
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
  uniform: { density: 0.25, moving: 1, size: ten, ranges: anywhere },
  sparse: { density: 0.001, moving: 1, size: ten, ranges: anywhere },
  dense: { density: 4, moving: 1, size: ten, ranges: anywhere },
  mixed: {
    density: 0.5,
    moving: 1,
    size: (sizes, random) => sizes.fill(pareto(random, 2, 2000, 1.3)),
    ranges: anywhere,
  },
  giants: { density: 0.5, moving: 1, size: oneInAThousandHuge, ranges: anywhere },
  clustered: { density: 0.05, moving: 1, size: ten, ranges: inClusters },
  static: { density: 0.25, moving: 0.05, size: ten, ranges: anywhere },
  skewed: { density: 0.1, moving: 1, size: longAlongOneAxis, ranges: anywhere },
} satisfies Record<string, Kind>;
