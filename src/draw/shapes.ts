// The visible parts of a space as shapes, for any sink: the path of a canvas, or a list of lines. Infinite boxes, cells
// and rays are clipped to the bounds of the finite boxes.
import type { BroadPhase } from 'broadphase';
import { boxesInCells } from './cells.ts';

type Numbers = ArrayLike<number>;

/** A sink for shapes. */
export interface Sink {
  /** A box: minima, then maxima, from `at` on. */
  box(numbers: Numbers, at: number): void;
  line(from: Numbers, to: Numbers): void;
}

/** From this share of the boxes of the fullest cell on, a cell is hot. */
const hotFrom = 0.5;
/** The length of a hit's normal, as a share of the drawing. */
const normalShare = 0.03;

/** The present state of a space, to draw. */
export class Shapes {
  readonly #space: BroadPhase<2 | 3>;
  readonly #dimensions: 2 | 3;
  readonly #box: Float64Array;
  readonly #other: Float64Array;
  /** The bounds of all finite numbers. */
  readonly #low: Float64Array;
  readonly #high: Float64Array;

  constructor(space: BroadPhase<2 | 3>) {
    const { dimensions } = space;
    this.#space = space;
    this.#dimensions = dimensions;
    this.#box = new Float64Array(2 * dimensions);
    this.#other = new Float64Array(2 * dimensions);
    this.#low = new Float64Array(dimensions).fill(Infinity);
    this.#high = new Float64Array(dimensions).fill(-Infinity);
    for (const id of space.keys()) {
      space.get(id, this.#box);
      for (let k = 0; k < this.#box.length; k++) {
        const value = this.#box[k];
        const axis = k % dimensions;
        if (!Number.isFinite(value)) continue;
        if (value < this.#low[axis]) this.#low[axis] = value;
        if (value > this.#high[axis]) this.#high[axis] = value;
      }
    }
    for (let axis = 0; axis < dimensions; axis++) {
      if (this.#low[axis] > this.#high[axis]) this.#low[axis] = this.#high[axis] = 0;
    }
  }

  boxes(sink: Sink): void {
    for (const id of this.#space.keys()) sink.box(this.#of(id, this.#box)!, 0);
  }

  /** Boxes that are in a pair. */
  touching(sink: Sink): void {
    for (const id of new Set(this.#space.pairs)) {
      const box = this.#of(id, this.#box);
      if (box) sink.box(box, 0);
    }
  }

  /** A line from centre to centre. */
  pairs(sink: Sink): void {
    const { pairs } = this.#space;
    for (let k = 0; k < pairs.length; k += 2) {
      const a = this.#of(pairs[k], this.#box);
      const b = this.#of(pairs[k + 1], this.#other);
      if (a && b) sink.line(centre(a), centre(b)); // else one was deleted since the update
    }
  }

  cells(sink: Sink): void {
    const cells = this.#space.structure().slice();
    for (let at = 0; at < cells.length; at += 2 * this.#dimensions) {
      this.#cut(cells, at);
      sink.box(cells, at);
    }
  }

  /** Cells with at least half as many boxes as the fullest has. `begin` gets how full each is, from 0 to 1. */
  hotCells(sink: Sink, begin?: (share: number) => void): void {
    const held = boxesInCells(this.#space);
    const cells = this.#space.structure().slice();
    let most = 1; // a cell with one box is never hot
    for (const boxes of held) most = Math.max(most, boxes);
    held.forEach((boxes, cell) => {
      if (boxes < 2 || boxes < hotFrom * most) return;
      const at = cell * 2 * this.#dimensions;
      this.#cut(cells, at);
      begin?.(boxes / most);
      sink.box(cells, at);
    });
  }

  /** A ray up to its hit, the box that it hits, and the normal there. */
  ray(sink: Sink, ray: readonly number[]): void {
    const dimensions = this.#dimensions;
    const origin = ray.slice(0, dimensions);
    const way = ray.slice(dimensions, 2 * dimensions);
    const [maxDistance = Infinity] = ray.slice(2 * dimensions);
    const asked = [...origin, ...way, { maxDistance }] as unknown as Parameters<BroadPhase<2>['rayCast']>;
    const hit = (this.#space as unknown as BroadPhase<2>).rayCast(...asked);
    const reach = this.#reach(origin);
    const distance = hit?.distance ?? (maxDistance < Infinity ? maxDistance : 2 * reach);
    const length = Math.hypot(...way) || 1; // a ray without a direction is a point
    const end = origin.map((value, axis) => value + (way[axis] / length) * distance);
    sink.line(origin, end);
    if (!hit) return;
    sink.line(
      end,
      end.map((value, axis) => value + hit.normal[axis] * normalShare * reach),
    );
    const box = this.#of(hit.id, this.#box);
    if (box) sink.box(box, 0);
  }

  /** The diameter of the finite bounds, enlarged by a point. */
  #reach(point: readonly number[]): number {
    const sides = point.map((value, axis) => Math.max(value, this.#high[axis]) - Math.min(value, this.#low[axis]));
    return Math.hypot(...sides);
  }

  #of(id: number, out: Float64Array): Float64Array | undefined {
    if (!this.#space.get(id, out)) return undefined;
    this.#cut(out, 0);
    return out;
  }

  #cut(numbers: Float64Array | Float32Array, at: number): void {
    for (let k = 0; k < 2 * this.#dimensions; k++) {
      const value = numbers[at + k];
      if (value === Infinity) numbers[at + k] = this.#high[k % this.#dimensions];
      else if (value === -Infinity) numbers[at + k] = this.#low[k % this.#dimensions];
    }
  }
}

function centre(box: Float64Array): Float64Array {
  const half = box.length / 2;
  return Float64Array.from({ length: half }, (_, axis) => box[axis] + (box[half + axis] - box[axis]) / 2);
}
