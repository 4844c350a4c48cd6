// Nodes of React Flow or Svelte Flow that overlap push each other apart. One file, to copy.
import { BroadPhase } from 'broadphase';

/** Up to this many nodes, a loop over all pairs is faster than a search. */
const few = 48;
/** Nodes at most this many pixels apart are tested too, since a push may bring them together. */
const near = 2;
/** Retained between calls. Created once there are more than a few nodes. */
let space;
let place = new Float64Array(4 * few); // for each node: the centre of its box, then half its width and height
let state = new Uint8Array(few); // for each node: 0 if it is fixed, 2 if it has been pushed, otherwise 1

/**
 * Pushes overlapping nodes apart, each by half of the overlap, along the axis of least overlap, until no two overlap.
 * Hidden nodes and those inside a parent are left alone.
 *
 * @param nodes as in React Flow. They are not changed
 * @param padding pixels of free space around each node, so two are at least twice that apart
 * @param threshold pixels of overlap that may remain, along one axis
 * @param maxIterations how often to loop over all nodes: 1 per frame animates
 * @param fixed returns whether a node must not move, such as one that is being dragged
 * @returns the nodes in their order, with copies of those that moved; the same array if none did
 */
export function separate(nodes, { padding = 0, threshold = 0.5, maxIterations = 50, fixed } = {}) {
  const apart = nodes.filter((node) => !node.hidden && !node.parentId);
  const count = apart.length;
  if (count > state.length) [place, state] = [new Float64Array(4 * count), new Uint8Array(count)];
  for (const [k, node] of apart.entries()) {
    const halfWidth = (node.measured?.width ?? node.width ?? 0) / 2;
    const halfHeight = (node.measured?.height ?? node.height ?? 0) / 2;
    place[4 * k] = node.position.x + halfWidth;
    place[4 * k + 1] = node.position.y + halfHeight;
    place[4 * k + 2] = halfWidth + padding;
    place[4 * k + 3] = halfHeight + padding;
    state[k] = fixed?.(node) ? 0 : 1;
  }
  let turns = 0;
  while (turns < maxIterations && pushAll(count, threshold)) turns++;
  if (turns === 0) return nodes;
  let next = 0;
  return nodes.map((node) => {
    const k = node === apart[next] ? next++ : -1;
    if (state[k] !== 2) return node;
    const x = place[4 * k] - place[4 * k + 2] + padding;
    return { ...node, position: { x, y: place[4 * k + 1] - place[4 * k + 3] + padding } };
  });
}

function pushAll(count, threshold) {
  let pushed = false;
  for (let a = 0; count <= few && a < count; a++) {
    for (let b = a + 1; b < count; b++) pushed = push(a, b, threshold) || pushed;
  }
  if (count <= few) return pushed;
  const boxes = new Float64Array(4 * count);
  for (let k = 0; k < boxes.length; k++) boxes[k] = place[k & ~2] + (k & 2 ? 1 : -1) * (place[k | 2] + near); // minima, maxima
  space ??= new BroadPhase();
  const { pairs } = space.setAll(boxes).update();
  for (let k = 0; k < pairs.length; k += 2) pushed = push(pairs[k], pairs[k + 1], threshold) || pushed;
  for (let k = pairs.length - 2; pushed && k >= 0; k -= 2) push(pairs[k + 1], pairs[k], threshold);
  return pushed;
}

/** Pushes two nodes apart if they overlap; returns whether they did. */
function push(a, b, threshold) {
  const dx = place[4 * a] - place[4 * b];
  const dy = place[4 * a + 1] - place[4 * b + 1];
  const overX = place[4 * a + 2] + place[4 * b + 2] - Math.abs(dx);
  const overY = place[4 * a + 3] + place[4 * b + 3] - Math.abs(dy);
  if (!(overX > threshold && overY > threshold) || !(state[a] || state[b])) return false;
  const share = state[a] ? (state[b] ? 0.5 : 1) : 0;
  const axis = overX < overY ? 0 : 1; // the axis of least overlap
  const way = axis ? (dy > 0 ? overY : -overY) : dx > 0 ? overX : -overX;
  place[4 * a + axis] += share * way;
  place[4 * b + axis] -= (1 - share) * way;
  state[a] &&= 2;
  state[b] &&= 2;
  return true;
}
