// Boxes that move so fast that they would pass each other between two frames: swept tests, for two that both move.
// Seen from the one the other moves by the difference of their ways; along each axis there is a time when they begin
// and one when they cease to overlap, and they meet where the last beginning comes before the first end.

/**
 * The share of the frame, 0 to 1, that is over when two moving boxes meet, with the axis along which they do (-1: they
 * overlap from the start); undefined where they do not. Boxes are [minX, minY, maxX, maxY], ways [dx, dy].
 */
export function meeting(a, wayA, b, wayB) {
  let begin = 0;
  let end = 1;
  let axis = -1;
  for (let k = 0; k < 2; k++) {
    const way = wayA[k] - wayB[k];
    const [ahead, behind] = [b[k] - a[k + 2], b[k + 2] - a[k]]; // to the first and the last touch
    if (way === 0) {
      if (ahead > 0 || behind < 0) return undefined;
      continue;
    }
    const first = (way > 0 ? ahead : behind) / way;
    end = Math.min(end, (way > 0 ? behind : ahead) / way);
    if (first > begin) {
      begin = first;
      axis = k;
    }
  }
  return begin <= end ? { time: begin, axis } : undefined;
}
