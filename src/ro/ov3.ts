// Vector operations on any object with an x and a y.
//
// Every operation that makes a vector writes it into `target` and returns that. Left out, target is the first
// argument: `add(pos, step)` moves pos itself, and nothing is allocated. Pass `{ x: 0, y: 0 }` to keep the arguments.
import * as math from './math.ts';
import type { Vector } from './vector.ts';

/**
 * The sum of two vectors.
 * @param target where it is written; left out: `a` itself
 *
 * @example
 * ov3.add({ x: 1, y: 2 }, { x: 3, y: 4 }); // → { x: 4, y: 6 }
 */
export function add<T extends Vector = Vector>(a: Vector, b: Vector, target: T = a as T): T {
  target.x = a.x + b.x;
  target.y = a.y + b.y;
  return target;
}

/**
 * The difference of two vectors, a - b.
 * @param target where it is written; left out: `a` itself
 *
 * @example
 * ov3.sub({ x: 3, y: 4 }, { x: 1, y: 2 }); // → { x: 2, y: 2 }
 */
export function sub<T extends Vector = Vector>(a: Vector, b: Vector, target: T = a as T): T {
  target.x = a.x - b.x;
  target.y = a.y - b.y;
  return target;
}

/**
 * Multiplies x with x and y with y.
 * @param target where it is written; left out: `a` itself
 *
 * @example
 * ov3.mult({ x: 1, y: 2 }, { x: 3, y: 4 }); // → { x: 3, y: 8 }
 */
export function mult<T extends Vector = Vector>(a: Vector, b: Vector, target: T = a as T): T {
  target.x = a.x * b.x;
  target.y = a.y * b.y;
  return target;
}

/**
 * A vector times a number.
 * @param target where it is written; left out: `a` itself
 *
 * @example
 * ov3.scale({ x: 1, y: 2 }, 3); // → { x: 3, y: 6 }
 */
export function scale<T extends Vector = Vector>(a: Vector, factor: number, target: T = a as T): T {
  target.x = a.x * factor;
  target.y = a.y * factor;
  return target;
}

/**
 * The vector of length 1 that points the same way; a zero vector stays zero.
 * @param target where it is written; left out: `a` itself
 *
 * @example
 * ov3.normalize({ x: 0, y: -2 }); // → { x: 0, y: -1 }
 */
export function normalize<T extends Vector = Vector>(a: Vector, target: T = a as T): T {
  const l = length(a) || 1;
  target.x = a.x / l;
  target.y = a.y / l;
  return target;
}

/**
 * How long a vector is.
 *
 * @example
 * ov3.length({ x: 3, y: 4 }); // → 5
 */
export function length(a: Vector): number {
  return Math.hypot(a.x, a.y);
}

/**
 * How far two points are apart.
 *
 * @example
 * ov3.distance({ x: 1, y: 1 }, { x: 4, y: 5 }); // → 5
 */
export function distance(a: Vector, b: Vector): number {
  return Math.hypot(a.x - b.x, a.y - b.y);
}

/**
 * The dot product: 0 for vectors at right angles, below 0 for those that point apart.
 *
 * @example
 * ov3.dot({ x: 1, y: 2 }, { x: 3, y: 4 }); // → 11
 */
export function dot(a: Vector, b: Vector): number {
  return a.x * b.x + a.y * b.y;
}

/**
 * The vector of length 1 that points from a to b; zero when they are the same point.
 * @param target where it is written; left out: `a` itself
 *
 * @example
 * ov3.direction({ x: 1, y: 1 }, { x: 5, y: 1 }); // → { x: 1, y: 0 }
 */
export function direction<T extends Vector = Vector>(a: Vector, b: Vector, target: T = a as T): T {
  return normalize(sub(b, a, target), target);
}

/**
 * The vector that points the other way.
 * @param target where it is written; left out: `a` itself
 *
 * @example
 * ov3.negate({ x: 1, y: -2 }); // → { x: -1, y: 2 }
 */
export function negate<T extends Vector = Vector>(a: Vector, target: T = a as T): T {
  return scale(a, -1, target);
}

/**
 * Turns a vector about the origin, from the x axis towards the y axis (clockwise on a screen), by radians.
 * @param target where it is written; left out: `a` itself
 *
 * @example
 * Math.round(ov3.rotateZ({ x: 1, y: 0 }, Math.PI / 2).y); // → 1
 */
export function rotateZ<T extends Vector = Vector>(a: Vector, radians: number, target: T = a as T): T {
  const { x, y } = a;
  const cos = Math.cos(radians);
  const sin = Math.sin(radians);
  target.x = cos * x - sin * y;
  target.y = sin * x + cos * y;
  return target;
}

/**
 * The turn in radians, -PI to PI, from where a points to where b points; with one vector, from the x axis to it.
 *
 * @example
 * ov3.angleTo({ x: 0, y: 1 }); // → Math.PI / 2
 */
export function angleTo(a: Vector, b?: Vector): number {
  return math.angleTo(a.x, a.y, b?.x, b?.y);
}

/**
 * Where the line through a and b meets the line through c and d, or null when they are parallel.
 * @param target filled and returned, if given
 *
 * @example
 * ov3.intersect({ x: 0, y: 0 }, { x: 1, y: 0 }, { x: 0, y: 1 }, { x: 1, y: 1 }); // → null
 */
export function intersect(a: Vector, b: Vector, c: Vector, d: Vector, target?: Vector): Vector | null {
  return math.intersectLineLine(a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y, target);
}

/**
 * [x, y], in `target` when there is one.
 *
 * @example
 * ov3.asArray({ x: 1, y: 2 }); // → [1, 2]
 */
export function asArray(a: Vector, target: number[] = []): number[] {
  target[0] = a.x;
  target[1] = a.y;
  return target;
}

/**
 * The vector of the first two numbers of an array, in `target` when there is one.
 *
 * @example
 * ov3.fromArray([1, 2, 3]); // → { x: 1, y: 2 }
 */
export function fromArray(array: ArrayLike<number>, target: Vector = { x: 0, y: 0 }): Vector {
  target.x = array[0];
  target.y = array[1];
  return target;
}

/**
 * The vector for people to read.
 *
 * @example
 * ov3.str({ x: 1, y: 2 }); // → '{ x: 1, y: 2 }'
 */
export function str(a: Vector): string {
  return `{ x: ${shown(a.x)}, y: ${shown(a.y)} }`;
}

/** Text stands in quotes, so that it does not look like a number. */
const shown = (value: unknown) => (typeof value === 'string' ? `"${value}"` : value);
