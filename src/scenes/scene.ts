// What every scene is: boxes that a step moves by one frame, in place and without allocating.

/** What the numbers of a scene are held in: a step rounds to it. */
export type Numbers = Float32Array | Float64Array;

/** Makes the array that a scene holds its numbers in. */
export type NumbersType = Float32ArrayConstructor | Float64ArrayConstructor;

export interface Scene<Held extends Numbers = Float32Array> {
  readonly name: string;
  readonly dimensions: 2 | 3;
  readonly count: number;
  /** Minima then maxima of every box, as `BroadPhase.setAll` takes them. */
  readonly boxes: Held;
  /** The side of the world, which reaches from 0 to `world` along every axis. */
  readonly world: number;
  /** Boxes 0 … fixed - 1 never move, and no two of them overlap. Left out: none is known to rest. */
  readonly fixed?: number;
  /** Moves every moving box by one frame, in place. */
  step(): void;
}

/** Where the scenes keep their boxes. */
export abstract class BoxScene implements Scene<Numbers> {
  readonly name: string;
  readonly dimensions: 2 | 3;
  readonly count: number;
  readonly boxes: Numbers;
  readonly world: number;

  constructor(name: string, dimensions: 2 | 3, count: number, world: number, Held: NumbersType) {
    this.name = name;
    this.dimensions = dimensions;
    this.count = count;
    this.boxes = new Held(2 * dimensions * count);
    this.world = world;
  }

  abstract step(): void;

  /** Puts box `index` at `min` along one axis. */
  protected put(index: number, axis: number, min: number, size: number): void {
    const k = 2 * this.dimensions * index + axis;
    this.boxes[k] = min;
    this.boxes[k + this.dimensions] = this.boxes[k] + size;
  }
}
