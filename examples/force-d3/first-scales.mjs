// Labels of a map by priority, at every zoom, without overlap and without flicker. One file, to copy.
import { BroadPhase, findPairs } from 'broadphase';

/** This many labels are placed first, then twice as many each time. Labels that those cover need not be compared. */
const firstGroup = 4096;

/**
 * Finds the scale from which on each label is shown. At each scale, from the smallest on, labels are added by priority,
 * unless they overlap a shown one. A label that is shown stays, since zooming in moves the others away from it. So at
 * any scale, show the labels whose number is at most that scale. Panning makes no difference.
 *
 * @param labels the most important first: { x, y } of the centre on the map, { width, height } in pixels of the screen
 * @param scales pixels of the screen per unit of the map, ascending
 * @returns for each label one of the scales, or Infinity
 */
export function firstScales(labels, scales) {
  const count = labels.length;
  const first = new Float64Array(count).fill(Number.POSITIVE_INFINITY);
  const until = new Float64Array(count); // below this scale, a hidden label overlaps a shown one
  const coveredAt = new Float64Array(count); // the last scale at which it was covered
  const places = new Float64Array(4 * count); // the centre of each label, then half its width and height
  for (let k = 0; k < count; k++) {
    const { x, y, width, height } = labels[k];
    places.set([x, y, width / 2, height / 2], 4 * k);
  }
  const space = new BroadPhase();
  const shown = [];
  for (const scale of scales) {
    const cover = (by, k) => {
      coveredAt[k] = scale;
      until[k] = Math.max(until[k], partingScale(places, 4 * by, 4 * k));
    };
    const waiting = [];
    for (let k = 0; k < count; k++) if (first[k] > scale && until[k] <= scale) waiting.push(k);
    for (let from = 0, size = firstGroup; from < waiting.length; from += size, size *= 2) {
      const group = waiting.slice(from, from + size);
      space.clear();
      space.setAll(boxesOf(places, [...shown, ...group], scale));
      for (let k = 0; k < group.length; k++) space.setStatic(shown.length + k); // no pairs among these
      const met = space.update().pairs;
      for (let k = 0; k < met.length; k += 2) cover(shown[met[k]], group[met[k + 1] - shown.length]);
      const free = group.filter((k) => coveredAt[k] !== scale);
      const pairs = findPairs(boxesOf(places, free, scale));
      const earlier = free.map(() => []);
      for (let k = 0; k < pairs.length; k += 2) earlier[pairs[k + 1]].push(free[pairs[k]]);
      for (let k = 0; k < free.length; k++) {
        for (const one of earlier[k]) if (first[one] === scale) cover(one, free[k]);
        if (coveredAt[free[k]] !== scale) first[free[k]] = scale;
      }
      for (const k of free) if (first[k] === scale) shown.push(k);
    }
  }
  space.dispose();
  return first;
}

/** The scale at which two labels no longer overlap, or just below. */
const partingScale = (places, a, b) =>
  (1 - 1e-12) *
  Math.min(
    (places[a + 2] + places[b + 2]) / Math.abs(places[a] - places[b]),
    (places[a + 3] + places[b + 3]) / Math.abs(places[a + 1] - places[b + 1]),
  );

function boxesOf(places, ids, scale) {
  const boxes = new Float64Array(4 * ids.length);
  for (let k = 0, at = 0; k < ids.length; k++) {
    const from = 4 * ids[k];
    const [x, y] = [scale * places[from], scale * places[from + 1]];
    boxes[at++] = x - places[from + 2];
    boxes[at++] = y - places[from + 3];
    boxes[at++] = x + places[from + 2];
    boxes[at++] = y + places[from + 3];
  }
  return boxes;
}
