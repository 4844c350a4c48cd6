// The contenders when the benchmark runs in a browser: our techniques, and the peers of bench/ in plain JavaScript,
// with the same adapters.
import { BroadPhase, type TechniqueName } from 'broadphase';

export interface Contender {
  name: string;
  peer: string;
  dimensions: readonly number[];
  create(setting: { dimensions: 2 | 3; count: number; boxes: Float32Array }): Promise<Running>;
}

export interface Running {
  /** Takes a frame, finds all pairs, and returns how many. */
  update(boxes: Float32Array | Float64Array): number;
  pairs(): ArrayLike<number>;
}

interface Adapter {
  dimensions: readonly number[];
  create(setting: object): Running;
}

const technique = (name: TechniqueName): Contender => ({
  name,
  peer: 'broadphase',
  dimensions: [2, 3],
  async create({ dimensions, count }) {
    const space = new BroadPhase({ dimensions, technique: name });
    return {
      update(boxes) {
        space.boxes(count).set(boxes);
        return space.update().pairCount;
      },
      pairs: () => space.pairs,
    };
  },
});

const adapters = import.meta.glob<Adapter>(
  '../../bench/peers/{flatbush,rbush,box-intersect,tutorial-grid,tutorial-brute-force}.mjs',
);

const peer = (name: string, dimensions: readonly number[], variant?: string): Contender => ({
  name: variant ? `${name} (${variant})` : name,
  peer: name,
  dimensions,
  create: async (setting) => (await adapters[`../../bench/peers/${name}.mjs`]()).create({ ...setting, variant }),
});

export const contenders: readonly Contender[] = [
  ...BroadPhase.techniques.map(technique),
  peer('flatbush', [2]),
  peer('rbush', [2], 'load'),
  peer('box-intersect', [2, 3]),
  peer('tutorial-grid', [2, 3]),
  peer('tutorial-brute-force', [2, 3]),
];
