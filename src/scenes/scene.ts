// What every scene is: boxes that a step moves by one frame, in place and without allocating.

export interface Scene {
  readonly name: string;
  readonly dimensions: 2 | 3;
  readonly count: number;
  /** Minima then maxima of every box, as `BroadPhase.setAll` takes them. */
  readonly boxes: Float32Array;
  /** The side of the world, which reaches from 0 to `world` along every axis. */
  readonly world: number;
  /** Boxes 0 … fixed - 1 never move, and no two of them overlap. Left out: none is known to rest. */
  readonly fixed?: number;
  /** Moves every moving box by one frame, in place. */
  step(): void;
}

/** Where the scenes keep their boxes. */
export abstract class BoxScene implements Scene {
  readonly name: string;
  readonly dimensions: 2 | 3;
  readonly count: number;
  readonly boxes: Float32Array;
  readonly world: number;

  constructor(name: string, dimensions: 2 | 3, count: number, world: number) {
    this.name = name;
    this.dimensions = dimensions;
    this.count = count;
    this.boxes = new Float32Array(2 * dimensions * count);
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
