// Line segments of what is in a space, for renderers that draw lines from one array.
import type { BroadPhase } from 'broadphase';
import { bad, checkRay, checkSpace } from './checks.ts';
import { Shapes, type Sink } from './shapes.ts';

/** Whole segments, in 2D and 3D, as renderers want it of an array of points. */
const firstRoom = 1020;

/**
 * Line segments in one Float32Array, for anything that draws lines: three.js, PixiJS, regl, WebGL itself. Each segment
 * is two points, of 2 numbers each, in 3D of 3. The array is reused and grows. Reading the space makes some garbage:
 * this is for debugging.
 *
 * @example
 * const space = new BroadPhase().set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
 * const lines = new Lines().addPairs(space);
 * lines.points(); // → Float32Array [5, 5, 10, 10]
 */
export class Lines {
  /** 2 or 3: how many numbers a point has. */
  readonly dimensions: 2 | 3;
  /** The points; the array is longer than the part in use. Growing replaces it by another array. */
  data: Float32Array<ArrayBuffer>;
  /** The number of elements of `data` in use. */
  length = 0;
  readonly #sink: Sink;

  /**
   * @param dimensions 2 or 3, those of the spaces to draw
   *
   * @example
   * new Lines(3).points(); // → Float32Array []
   */
  constructor(dimensions: 2 | 3 = 2) {
    if (dimensions !== 2 && dimensions !== 3) bad('new Lines', dimensions, '2 or 3 dimensions', RangeError);
    this.dimensions = dimensions;
    this.data = new Float32Array(firstRoom);
    const from = new Float64Array(dimensions);
    const to = new Float64Array(dimensions);
    this.#sink = {
      line: (a, b) => this.#line(a, b),
      // A corner has a bit for each axis: where it is set, the corner is at the maximum. An edge sets one bit more.
      box: (numbers, at) => {
        for (let corner = 0; corner < 1 << dimensions; corner++) {
          for (let axis = 0; axis < dimensions; axis++) {
            if (corner & (1 << axis)) continue;
            for (let k = 0; k < dimensions; k++) {
              from[k] = numbers[at + k + (corner & (1 << k) ? dimensions : 0)];
              to[k] = k === axis ? numbers[at + k + dimensions] : from[k];
            }
            this.#line(from, to);
          }
        }
      },
    };
  }

  /**
   * Removes all lines, and keeps the array. Chainable.
   *
   * @example
   * new Lines().clear().length; // → 0
   */
  clear(): this {
    this.length = 0;
    return this;
  }

  /**
   * The points in use: a view of `data`.
   *
   * @example
   * new Lines().addBoxes(new BroadPhase().set(7, 0, 0, 1, 1)).points().length; // → 16
   */
  points(): Float32Array<ArrayBuffer> {
    return this.data.subarray(0, this.length);
  }

  /**
   * Adds the edges of all boxes: 4 each, in 3D 12. Infinite boxes are clipped to the extent of the finite ones.
   * Chainable.
   * @throws RangeError if the space has other dimensions, as all methods do
   *
   * @example
   * new Lines().addBoxes(new BroadPhase({ dimensions: 3 })); // throws RangeError: addBoxes: got a space of 3 dimensions, expected 2
   */
  addBoxes(space: BroadPhase<2 | 3>): this {
    this.#shapes('addBoxes', space).boxes(this.#sink);
    return this;
  }

  /**
   * Adds the edges of the boxes that are in a pair. Chainable.
   *
   * @example
   * const space = new BroadPhase().set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).set(11, 90, 0, 99, 9).update();
   * new Lines().addTouching(space).length; // → 32
   */
  addTouching(space: BroadPhase<2 | 3>): this {
    this.#shapes('addTouching', space).touching(this.#sink);
    return this;
  }

  /**
   * Adds a line for each pair, from centre to centre. Chainable.
   *
   * @example
   * const space = new BroadPhase().set(7, 0, 0, 2, 2).set(9, 1, 1, 3, 3).update();
   * new Lines().addPairs(space).points(); // → Float32Array [1, 1, 2, 2]
   */
  addPairs(space: BroadPhase<2 | 3>): this {
    this.#shapes('addPairs', space).pairs(this.#sink);
    return this;
  }

  /**
   * Adds the edges of the cells, strips or nodes that the technique uses. Chainable.
   *
   * @example
   * const space = new BroadPhase({ technique: 'strip-sweep' }).set(7, 0, 0, 10, 10).update();
   * new Lines().addCells(space).length === 4 * space.structure().length; // → true
   */
  addCells(space: BroadPhase<2 | 3>): this {
    this.#shapes('addCells', space).cells(this.#sink);
    return this;
  }

  /**
   * Adds the edges of the fullest cells: those with at least two boxes, and half as many as the fullest. Chainable.
   *
   * @example
   * const space = new BroadPhase({ technique: 'strip-sweep' }).set(7, 0, 0, 10, 10).update();
   * new Lines().addHotCells(space).length; // → 0
   */
  addHotCells(space: BroadPhase<2 | 3>): this {
    this.#shapes('addHotCells', space).hotCells(this.#sink);
    return this;
  }

  /**
   * Casts a ray, and adds it up to what it hits, with the normal and the edges of the box. Chainable.
   * @param ray the origin, the direction, and optionally the maximum distance: 4 or 5 numbers, in 3D 6 or 7
   * @throws RangeError or TypeError as `rayCast` does
   *
   * @example
   * const space = new BroadPhase().update();
   * new Lines().addRay(space, [0, 0, 1, 0, 8]).points(); // → Float32Array [0, 0, 8, 0]
   */
  addRay(space: BroadPhase<2 | 3>, ray: readonly number[]): this {
    checkRay('addRay', ray, this.dimensions);
    this.#shapes('addRay', space).ray(this.#sink, ray);
    return this;
  }

  #shapes(where: string, space: BroadPhase<2 | 3>): Shapes {
    checkSpace(where, space, this.dimensions);
    return new Shapes(space);
  }

  #line(from: ArrayLike<number>, to: ArrayLike<number>): void {
    const { dimensions } = this;
    if (this.length + 2 * dimensions > this.data.length) {
      const grown = new Float32Array(2 * this.data.length);
      grown.set(this.data);
      this.data = grown;
    }
    for (let k = 0; k < dimensions; k++) {
      this.data[this.length + k] = from[k];
      this.data[this.length + dimensions + k] = to[k];
    }
    this.length += 2 * dimensions;
  }
}
