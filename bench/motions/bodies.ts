// The bodies of every motion: positions in doubles, as in games, and their boxes.
import { createRandom, type Random } from '../../src/scenes/random.ts';

/** The side of a box, unless a motion changes it. */
const side = 10;

export class Bodies {
  readonly dimensions: 2 | 3;
  readonly count: number;
  readonly random: Random;
  /** The world reaches from 0 to this along every axis. */
  readonly world: number;
  /** The minimum of each box, axis by axis. */
  readonly at: Float64Array;
  /** The velocity per frame: 0 until a motion sets it. */
  readonly velocity: Float64Array;
  /** The side of each box. */
  readonly sides: Float64Array;
  /** Minima then maxima of every box. */
  readonly boxes: Float64Array;

  /** @param room how many times the volume of the boxes the world has */
  constructor(dimensions: 2 | 3, count: number, seed: number, room = 4) {
    this.dimensions = dimensions;
    this.count = count;
    this.random = createRandom(seed);
    this.world = (room * count) ** (1 / dimensions) * side;
    this.at = Float64Array.from({ length: dimensions * count }, () => this.random() * this.world);
    this.velocity = new Float64Array(dimensions * count);
    this.sides = new Float64Array(count).fill(side);
    this.boxes = new Float64Array(2 * dimensions * count);
    this.put();
  }

  /** Gives every box a velocity of up to `speed` along each axis. */
  push(speed: number): void {
    for (let k = 0; k < this.velocity.length; k++) this.velocity[k] = this.symmetric(speed);
  }

  /** A uniform random number from -size to size. */
  symmetric(size: number): number {
    return (2 * this.random() - 1) * size;
  }

  /** Approximately normal, of mean 0: the sum of four draws, which is cheap. */
  bell(deviation: number): number {
    const { random } = this;
    return (random() + random() + random() + random() - 2) * Math.sqrt(3) * deviation;
  }

  /** Moves one coordinate by its velocity; at a wall it turns around. */
  bounce(k: number): void {
    this.at[k] += this.velocity[k];
    if ((this.at[k] < 0 && this.velocity[k] < 0) || (this.at[k] > this.world && this.velocity[k] > 0)) {
      this.velocity[k] *= -1;
    }
  }

  /** Moves one coordinate; a body that leaves the world enters on the other side. */
  shift(k: number, by: number): void {
    this.at[k] += by;
    if (this.at[k] < 0) this.at[k] += this.world;
    else if (this.at[k] > this.world) this.at[k] -= this.world;
  }

  /** Computes the boxes, of all positions or of those from `first` to before `end`. */
  put(first = 0, end = this.count): void {
    const { dimensions, at, boxes, sides } = this;
    for (let id = first, from = dimensions * first, k = 2 * from; id < end; id++, k += dimensions) {
      for (let axis = 0; axis < dimensions; axis++, k++, from++) {
        boxes[k] = at[from];
        boxes[k + dimensions] = at[from] + sides[id];
      }
    }
  }
}

/** Sets up bodies, and returns a function that moves them by one frame. Frames count from 1; frame 0 is the start. */
export type Motion = (bodies: Bodies) => (frame: number) => void;
