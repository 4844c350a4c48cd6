// Convex polygons and circles, by SAT.js: two convex shapes are apart exactly if some axis separates them. The result
// has the depth of their overlap, and the direction that separates them.
import SAT from 'sat';

const response = new SAT.Response();

/** A convex polygon around its place, with corners [x, y] counter-clockwise. `pos` moves it, `setAngle` turns it. */
export function polygon(corners) {
  return new SAT.Polygon(
    new SAT.Vector(),
    corners.map(([x, y]) => new SAT.Vector(x, y)),
  );
}

export const circle = (radius) => new SAT.Circle(new SAT.Vector(), radius);

/** The box of a shape, as `space.set` takes it; `out` is filled and returned. */
export function boundsOf(shape, out = [0, 0, 0, 0]) {
  const { x, y } = shape.pos;
  if (shape instanceof SAT.Circle) {
    out[0] = x - shape.r;
    out[1] = y - shape.r;
    out[2] = x + shape.r;
    out[3] = y + shape.r;
    return out;
  }
  out[0] = out[1] = Infinity;
  out[2] = out[3] = -Infinity;
  for (const corner of shape.calcPoints) {
    out[0] = Math.min(out[0], x + corner.x);
    out[1] = Math.min(out[1], y + corner.y);
    out[2] = Math.max(out[2], x + corner.x);
    out[3] = Math.max(out[3], y + corner.y);
  }
  return out;
}

/**
 * The contact of two shapes, or undefined if they are apart. Its negated `overlapV` is how `a` has to move to be
 * apart. It is the same object each time.
 */
export function contactOf(a, b) {
  response.clear();
  const round = Number(a instanceof SAT.Circle) + 2 * Number(b instanceof SAT.Circle);
  const test = [SAT.testPolygonPolygon, SAT.testCirclePolygon, SAT.testPolygonCircle, SAT.testCircleCircle][round];
  return test(a, b, response) ? response : undefined;
}
