// Boxes of one kind in a square (cubic) world, in steady motion: each has its velocity, and turns round at the walls.
// A step costs a few nanoseconds per box and axis and allocates nothing. Sizes and velocities are kept aside, so that
// a box neither grows nor shrinks by rounding however long the scene runs.
import type { Kind } from './kinds.ts';
import { createRandom } from './random.ts';
import type { Scene } from './scene.ts';

export class MovingBoxes implements Scene {
  readonly name: string;
  readonly dimensions: 2 | 3;
  readonly count: number;
  readonly boxes: Float32Array;
  readonly world: number;
  readonly #sizes: Float32Array;
  readonly #velocities: Float32Array;

  constructor(name: string, kind: Kind, dimensions: 2 | 3, count: number, seed: number, speed: number) {
    this.name = name;
    this.dimensions = dimensions;
    this.count = count;
    this.boxes = new Float32Array(2 * dimensions * count);
    this.#sizes = new Float32Array(dimensions * count);
    this.#velocities = new Float32Array(dimensions * count);
    const random = createRandom(seed);

    const size = new Float64Array(dimensions);
    let volume = 0;
    for (let index = 0; index < count; index++) {
      kind.size(size, random, index);
      this.#sizes.set(size, dimensions * index);
      volume += size.reduce((product, side) => product * side, 1);
    }
    this.world = (volume / kind.density) ** (1 / dimensions);

    const place = new Float64Array(dimensions);
    const nextPlace = kind.places(random, dimensions);
    const speedPerAxis = speed / Math.sqrt(dimensions);
    for (let index = 0; index < count; index++) {
      const moves = random() < kind.moving;
      nextPlace(place);
      for (let axis = 0; axis < dimensions; axis++) {
        const k = dimensions * index + axis;
        const velocity = (2 * random() - 1) * speedPerAxis;
        this.#velocities[k] = moves ? velocity : 0;
        // In a world of few boxes a large one may be wider than the world: it then spans it, and stays.
        this.#sizes[k] = Math.min(this.#sizes[k], this.world);
        this.#put(index, axis, place[axis] * (this.world - this.#sizes[k]));
      }
    }
  }

  step(): void {
    const { dimensions, count, boxes, world } = this;
    for (let index = 0; index < count; index++) {
      for (let axis = 0; axis < dimensions; axis++) {
        const k = dimensions * index + axis;
        const velocity = this.#velocities[k];
        if (velocity === 0) continue;
        const limit = Math.max(0, world - this.#sizes[k]);
        let min = boxes[2 * dimensions * index + axis] + velocity;
        if (min < 0 || min > limit) {
          min = Math.min(limit, Math.max(0, min < 0 ? -min : 2 * limit - min));
          this.#velocities[k] = -velocity;
        }
        this.#put(index, axis, min);
      }
    }
  }

  #put(index: number, axis: number, min: number): void {
    const k = 2 * this.dimensions * index + axis;
    this.boxes[k] = min;
    this.boxes[k + this.dimensions] = this.boxes[k] + this.#sizes[this.dimensions * index + axis];
  }
}
