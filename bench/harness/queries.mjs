// Queries between frames: seeded ones on a scene, and the exact answers. A frame has 1,000 queries. Answers are written
// like pairs, [id, count + number of the query, …], so that code that compares pairs compares answers. Queries have
// float32 numbers, like the boxes.
import { createRandom } from '../../build/bench/library.mjs';

const asked = 1000;
/** How wide a queried box is, among boxes 10 wide that fill a quarter of the world: about 20 answers. */
const width = { 2: 80, 3: 34 };
/** The share of the world that a large query box covers. */
const share = 0.01;
/** The number of nearest boxes to find. */
export const most = 10;
/** How far a ray reaches: nearly all meet something. */
export const reach = 200;

/** Numbers of a query: a box; a point; a point and a direction. */
const numbers = { queryBox: (d) => 2 * d, nearest: (d) => d, rayCast: (d) => 2 * d };

/**
 * The distance from all boxes at which rays begin: in the frames that are checked none begins in a box, and the first
 * box met is unique.
 */
const clear = 4;
/** Cells of the grid that finds such places. */
const cell = 5;

/** Seeded queries on a scene. */
export function makeQueries({ asks, query }, scene, seed) {
  const { dimensions, world } = scene;
  const isClear = query === 'rayCast' ? clearance(scene) : () => true;
  const random = createRandom(seed + 0x9e37);
  const stride = numbers[query](dimensions);
  const list = new Float32Array(stride * asked);
  const side = asks === 'queryLarge' ? world * share ** (1 / dimensions) : width[dimensions];
  for (let at = 0; at < list.length; at += stride) {
    do {
      for (let axis = 0; axis < dimensions; axis++) list[at + axis] = world * random();
    } while (!isClear(list, at));
    for (let axis = 0; axis < dimensions; axis++) {
      if (query === 'queryBox') list[at + dimensions + axis] = list[at + axis] + side;
      if (query === 'rayCast') list[at + dimensions + axis] = random() - 0.5;
    }
  }
  return list;
}

/** Turns a library that answers queries into a contender that finds pairs. `untimed`: only its answers are wanted. */
export function asking(asker, item, queries, { dimensions, count }) {
  const stride = numbers[item.query](dimensions);
  let known = false;
  return {
    update(boxes) {
      if (!item.still || !known) asker.update(boxes);
      known = true;
      let answers = 0;
      for (let at = 0; at < queries.length; at += stride) answers += asker[item.query](queries, at).length;
      return answers;
    },
    pairs() {
      const pairs = [];
      for (let at = 0, k = count; at < queries.length; at += stride, k++) {
        for (const id of asker[item.query](queries, at)) pairs.push(id, k);
      }
      return pairs;
    },
  };
}

export function overlap(boxes, box, q, at, dimensions) {
  for (let axis = 0; axis < dimensions; axis++) {
    if (boxes[box + axis] > q[at + axis + dimensions] || q[at + axis] > boxes[box + axis + dimensions]) return false;
  }
  return true;
}

export function squaredDistance(boxes, box, q, at, dimensions) {
  let sum = 0;
  for (let axis = 0; axis < dimensions; axis++) {
    const away = Math.max(boxes[box + axis] - q[at + axis], q[at + axis] - boxes[box + axis + dimensions], 0);
    sum += away * away;
  }
  return sum;
}

/** Where a ray enters a box that does not hold its origin, in lengths of its direction, which has no zeros; or NaN. */
export function rayEntry(boxes, box, q, at, dimensions) {
  let enter = -Infinity;
  let leave = Infinity;
  for (let axis = 0; axis < dimensions; axis++) {
    const way = q[at + axis + dimensions];
    const low = (boxes[box + axis] - q[at + axis]) / way;
    const high = (boxes[box + axis + dimensions] - q[at + axis]) / way;
    enter = Math.max(enter, Math.min(low, high));
    leave = Math.min(leave, Math.max(low, high));
  }
  return enter >= 0 && enter <= leave ? enter : Number.NaN;
}

export function lengthOf(q, at, dimensions) {
  let sum = 0;
  for (let k = at; k < at + dimensions; k++) sum += q[k] * q[k];
  return Math.sqrt(sum);
}

/** Tests whether a point is clear of all boxes, by a grid in which all cells near a box are marked. */
function clearance({ dimensions, boxes, count, world }) {
  const side = Math.ceil(world / cell) + 1;
  const taken = new Uint8Array(side ** dimensions);
  const cellOf = (x) => Math.min(side - 1, Math.max(0, Math.floor(x / cell)));
  const mark = (box, axis, before) => {
    if (axis === dimensions) {
      taken[before] = 1;
      return;
    }
    const last = cellOf(boxes[box + axis + dimensions] + clear);
    for (let at = cellOf(boxes[box + axis] - clear); at <= last; at++) mark(box, axis + 1, before * side + at);
  };
  for (let id = 0; id < count; id++) mark(2 * dimensions * id, 0, 0);
  return (q, at) => {
    let index = 0;
    for (let axis = 0; axis < dimensions; axis++) index = index * side + cellOf(q[at + axis]);
    return !taken[index];
  };
}
