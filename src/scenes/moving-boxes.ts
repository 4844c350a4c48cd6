// Boxes of one kind in a square (cubic) world, in steady motion: each has its velocity, and turns round at its walls. Walls
// are where a place drawn between them is as likely in any frame as in the first: so a scene stays as dense as it begins.
// A step costs a few nanoseconds per box and axis and allocates nothing. Sizes and velocities are kept aside, so that
// a box neither grows nor shrinks by rounding however long the scene runs.
import type { Kind } from './kinds.ts';
import { createRandom } from './random.ts';
import { BoxScene, type NumbersType } from './scene.ts';

export class MovingBoxes extends BoxScene {
  readonly #sizes: Float32Array;
  readonly #velocities: Float32Array;
  /** Between which each minimum stays: the walls of the world, or a box's own, by which its cluster holds it. */
  readonly #walls: Float64Array;

  constructor(
    name: string,
    kind: Kind,
    dimensions: 2 | 3,
    count: number,
    seed: number,
    speed: number,
    Held: NumbersType,
  ) {
    const random = createRandom(seed);
    const size = new Float64Array(dimensions);
    const sizes = new Float32Array(dimensions * count);
    let volume = 0;
    for (let index = 0; index < count; index++) {
      kind.size(size, random, index);
      sizes.set(size, dimensions * index);
      volume += size.reduce((product, side) => product * side, 1);
    }
    super(name, dimensions, count, (volume / kind.density) ** (1 / dimensions), Held);
    this.#sizes = sizes;
    this.#velocities = new Float32Array(dimensions * count);
    this.#walls = new Float64Array(2 * dimensions * count);

    const range = new Float64Array(2 * dimensions);
    const place = new Float64Array(dimensions);
    const nextRange = kind.ranges(random, dimensions);
    const speedPerAxis = speed / Math.sqrt(dimensions);
    for (let index = 0; index < count; index++) {
      const moves = random() < kind.moving;
      nextRange(range);
      for (let axis = 0; axis < dimensions; axis++) place[axis] = random();
      for (let axis = 0; axis < dimensions; axis++) {
        const k = dimensions * index + axis;
        const velocity = (2 * random() - 1) * speedPerAxis;
        this.#velocities[k] = moves ? velocity : 0;
        // In a world of few boxes a large one may be wider than the world: it then spans it, and stays.
        sizes[k] = Math.min(sizes[k], this.world);
        const room = Math.max(0, this.world - sizes[k]);
        const [low, high] = [range[2 * axis] * room, range[2 * axis + 1] * room];
        this.#walls[2 * k] = low;
        this.#walls[2 * k + 1] = high;
        this.put(index, axis, low + place[axis] * (high - low), sizes[k]);
      }
    }
  }

  step(): void {
    const { dimensions, count, boxes } = this;
    const walls = this.#walls;
    for (let index = 0; index < count; index++) {
      for (let axis = 0; axis < dimensions; axis++) {
        const k = dimensions * index + axis;
        const velocity = this.#velocities[k];
        if (velocity === 0) continue;
        const [low, high] = [walls[2 * k], walls[2 * k + 1]];
        let min = boxes[2 * dimensions * index + axis] + velocity;
        if (min < low || min > high) {
          min = Math.min(high, Math.max(low, min < low ? 2 * low - min : 2 * high - min));
          this.#velocities[k] = -velocity;
        }
        this.put(index, axis, min, this.#sizes[k]);
      }
    }
  }
}
