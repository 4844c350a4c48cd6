// What people use instead, by the same rule as separate.mjs: a loop over all pairs, or a search for each node in rbush,
// flatbush or a quadtree, which is rebuilt in every iteration.
import { Quadtree, Rectangle } from '@timohausmann/quadtree-ts';
import Flatbush from 'flatbush';
import RBush from 'rbush';

/** A node and its padded box, which all of them work on. */
const bodyOf = (node, padding, fixed) => {
  const width = (node.measured?.width ?? node.width) + 2 * padding;
  const height = (node.measured?.height ?? node.height) + 2 * padding;
  const [x, y] = [node.position.x - padding, node.position.y - padding];
  return { node, x, y, width, height, minX: x, minY: y, maxX: x + width, maxY: y + height, fixed, moved: false };
};

const shift = (body, dx, dy) => {
  body.x += dx;
  body.minX += dx;
  body.maxX += dx;
  body.y += dy;
  body.minY += dy;
  body.maxY += dy;
  body.moved = true;
};

/** Pushes two nodes apart if they overlap; returns whether they did. */
function push(a, b, threshold) {
  const dx = a.x + a.width / 2 - b.x - b.width / 2;
  const dy = a.y + a.height / 2 - b.y - b.height / 2;
  const overX = (a.width + b.width) / 2 - Math.abs(dx);
  const overY = (a.height + b.height) / 2 - Math.abs(dy);
  if (!(overX > threshold && overY > threshold) || (a.fixed && b.fixed)) return false;
  const share = a.fixed ? 0 : b.fixed ? 1 : 0.5;
  const [byX, byY] = overX < overY ? [dx > 0 ? overX : -overX, 0] : [0, dy > 0 ? overY : -overY];
  if (!a.fixed) shift(a, share * byX, share * byY);
  if (!b.fixed) shift(b, (share - 1) * byX, (share - 1) * byY);
  return true;
}

/** A function with the options of `separate`, made from one that loops once over all bodies. */
const separateBy =
  (pushAll) =>
  (nodes, { padding = 0, threshold = 0.5, maxIterations = 50, fixed } = {}) => {
    const bodies = nodes.map((node) => bodyOf(node, padding, fixed?.(node) ?? false));
    let turns = 0;
    while (turns < maxIterations && pushAll(bodies, threshold)) turns++;
    if (turns === 0) return nodes;
    return bodies.map(({ node, x, y, moved }) =>
      moved ? { ...node, position: { x: x + padding, y: y + padding } } : node,
    );
  };

export const naive = separateBy((bodies, threshold) => {
  let pushed = false;
  for (let a = 0; a < bodies.length; a++) {
    for (let b = a + 1; b < bodies.length; b++) pushed = push(bodies[a], bodies[b], threshold) || pushed;
  }
  return pushed;
});

export const rbush = separateBy((bodies, threshold) => {
  const tree = new RBush().load(bodies);
  let pushed = false;
  for (const a of bodies) {
    for (const b of tree.search(a)) pushed = (a !== b && push(a, b, threshold)) || pushed;
  }
  return pushed;
});

export const flatbush = separateBy((bodies, threshold) => {
  const tree = new Flatbush(bodies.length);
  for (const { minX, minY, maxX, maxY } of bodies) tree.add(minX, minY, maxX, maxY);
  tree.finish();
  let pushed = false;
  for (const a of bodies) {
    for (const k of tree.search(a.minX, a.minY, a.maxX, a.maxY)) {
      pushed = (a !== bodies[k] && push(a, bodies[k], threshold)) || pushed;
    }
  }
  return pushed;
});

export const quadtree = separateBy((bodies, threshold) => {
  const [x, y] = [Math.min(...bodies.map(({ minX }) => minX)), Math.min(...bodies.map(({ minY }) => minY))];
  const width = Math.max(...bodies.map(({ maxX }) => maxX)) - x;
  const height = Math.max(...bodies.map(({ maxY }) => maxY)) - y;
  const tree = new Quadtree({ x, y, width, height });
  const rectangleOf = (body) =>
    new Rectangle({ x: body.x, y: body.y, width: body.width, height: body.height, data: body });
  for (const body of bodies) tree.insert(rectangleOf(body));
  let pushed = false;
  for (const a of bodies) {
    for (const { data: b } of tree.retrieve(rectangleOf(a))) pushed = (a !== b && push(a, b, threshold)) || pushed;
  }
  return pushed;
});
