/**
 * The bounds of a moving box as `setSwept` keeps them: of float32 numbers the sums where they are exact; elsewhere they
 * are rounded outward by 2^-49 of the numbers involved.
 */
export function pathOf(box: readonly number[], way: readonly number[]): number[] {
  const bounds = [...box];
  for (const [axis, by] of way.entries()) {
    const given = [by, box[axis]!, box[axis + way.length]!];
    const side = by < 0 ? axis : axis + way.length;
    const sum = box[side]! + by;
    const isExact = sum - box[side]! === by && sum - by === box[side]!;
    const sizes = given.map((x) => (Math.abs(x) === Infinity ? 0 : Math.abs(x) * 2 ** -49));
    const pad = isExact && given.every((x) => Math.fround(x) === x) ? 0 : sizes[0]! + sizes[1]! + sizes[2]!;
    bounds[side] = by < 0 ? sum - pad : by > 0 ? sum + pad : sum;
  }
  return bounds;
}
