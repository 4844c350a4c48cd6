// Arithmetic and geometry on plain numbers, for games on a grid.
import { checkFinite } from './checks.ts';
import type { Vector } from './vector.ts';

/**
 * The multiple of `multiple` that is nearest to `value`; halfway between two, the greater one.
 * @param multiple above 0, finite
 * @throws RangeError for another multiple
 *
 * @example
 * math.toNearest(37, 10); // → 40
 */
export function toNearest(value: number, multiple: number): number {
  checkFinite('ro.math: multiple', multiple);
  return Math.round(value / multiple) * multiple;
}

/**
 * Slides `point` along a direction until its x or its y is the multiple nearest to where it started, whichever takes
 * the shorter way: how a thing that came in at an angle is put back on the edge of a tile.
 * @param direction of any length but 0
 * @param multiple the size of a tile: above 0, finite
 * @throws RangeError for another multiple, and for a direction that is zero or not finite
 *
 * @example
 * math.toNearestAlong({ x: 12, y: 5 }, { x: 1, y: 1 }, 10); // → { x: 10, y: 3 }
 */
export function toNearestAlong(point: Vector, direction: Vector, multiple: number): Vector {
  const alongX = (toNearest(point.x, multiple) - point.x) / direction.x;
  const alongY = (toNearest(point.y, multiple) - point.y) / direction.y;
  // A direction without an x never reaches another x: that distance is not finite, and does not count.
  const ways = [alongX, alongY].filter(Number.isFinite);
  if (ways.length === 0) {
    throw new RangeError(
      `ro.math.toNearestAlong: the direction is { x: ${direction.x}, y: ${direction.y} } ` +
        `from { x: ${point.x}, y: ${point.y} }; expected finite numbers and a direction that is not zero`,
    );
  }
  const way = ways.reduce((a, b) => (Math.abs(b) < Math.abs(a) ? b : a));
  return { x: point.x + way * direction.x, y: point.y + way * direction.y };
}

/**
 * The turn in radians, -PI to PI, that takes the vector (x1, y1) to where (x2, y2) points; above 0 is from the x axis
 * towards the y axis. With one vector: the turn from the x axis to it.
 *
 * @example
 * math.angleTo(1, 0, 0, 2); // → Math.PI / 2
 */
export function angleTo(x1: number, y1: number, x2?: number, y2?: number): number {
  if (x2 === undefined || y2 === undefined) return Math.atan2(y1, x1);
  return Math.atan2(x1 * y2 - y1 * x2, x1 * x2 + y1 * y2);
}

/**
 * Where the endless line through points 1 and 2 meets the one through points 3 and 4, rounded. It holds where
 * coordinates differ by 0 or by 1e-50 to 1e50: beyond, products may overflow or vanish, and the result is wrong or null.
 * @param target filled and returned, if given
 * @returns the point, or null when the lines are parallel
 *
 * @example
 * math.intersectLineLine(0, 0, 4, 4, 0, 4, 4, 0); // → { x: 2, y: 2 }
 */
export function intersectLineLine(
  x1: number,
  y1: number,
  x2: number,
  y2: number,
  x3: number,
  y3: number,
  x4: number,
  y4: number,
  target: Vector = { x: 0, y: 0 },
): Vector | null {
  const cross = (x2 - x1) * (y4 - y3) - (y2 - y1) * (x4 - x3);
  if (cross === 0) return null;
  const way = ((x3 - x1) * (y4 - y3) - (y3 - y1) * (x4 - x3)) / cross;
  target.x = x1 + way * (x2 - x1);
  target.y = y1 + way * (y2 - y1);
  return target;
}
