// Swept tests for two moving boxes, so fast that they would pass each other between two frames. Seen from one, the
// other moves by the difference of their displacements. Along each axis they begin to overlap at one time and cease
// at another. They meet if the last beginning comes before the first end.

/**
 * The time at which two moving boxes meet, as a share of the frame from 0 to 1, and the axis along which they do (-1:
 * they overlap from the start). Undefined if they do not. Boxes are [minX, minY, maxX, maxY], ways [dx, dy].
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
