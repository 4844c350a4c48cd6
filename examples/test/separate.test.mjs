// Nodes end up apart, as by a loop over all pairs, and fixed nodes do not move.
import { describe, expect, test } from 'vitest';
import { makeNodes } from '../nodes-xyflow/datasets.mjs';
import { separate } from '../nodes-xyflow/separate.mjs';

/** How many pairs of nodes overlap by more than `threshold` along both axes, by a loop over all pairs. */
function overlapping(nodes, threshold, padding = 0) {
  let count = 0;
  for (const [k, a] of nodes.entries()) {
    for (const b of nodes.slice(k + 1)) {
      const over = (axis, size) =>
        Math.min(a.position[axis] + a[size], b.position[axis] + b[size]) -
        Math.max(a.position[axis], b.position[axis]) +
        2 * padding;
      count += Number(Math.min(over('x', 'width'), over('y', 'height')) > threshold + 1e-9);
    }
  }
  return count;
}
const whole = { maxIterations: Number.POSITIVE_INFINITY };

describe.each(['packed', 'separated', 'clustered'])('%s nodes', (kind) => {
  test.each([1, 2, 15, 48, 49, 300])('%i of them end up apart', (count) => {
    const nodes = makeNodes(kind, count);
    const before = structuredClone(nodes);
    const apart = separate(nodes, whole);
    expect(nodes).toEqual(before);
    expect(overlapping(apart, 0.5)).toBe(0);
    expect(separate(apart, whole)).toBe(apart);
    expect(apart.map(({ id }) => id)).toEqual(nodes.map(({ id }) => id));
    if (overlapping(nodes, 0.5) === 0) expect(apart).toBe(nodes);
    for (const [k, node] of apart.entries())
      expect(node === nodes[k]).toBe(
        node.position.x === nodes[k].position.x && node.position.y === nodes[k].position.y,
      );
  });
});

test('sizes are mixed, there is padding, and other calls in between make no difference', () => {
  const nodes = makeNodes('packed', 200).map((node, k) => ({
    ...node,
    width: 20 + ((k * 37) % 140),
    height: 16 + ((k * 53) % 60),
  }));
  const apart = separate(nodes, { ...whole, padding: 7 });
  expect(overlapping(apart, 0.5, 7)).toBe(0);
  expect(overlapping(apart, 0.5, 8)).toBeGreaterThan(0);
  let step = nodes;
  for (let turn = 0; turn < 20_000; turn++) {
    const next = separate(step, { maxIterations: 1, padding: 7 });
    if (next === step) break;
    step = next;
    if (turn % 10 === 0) separate(makeNodes('packed', 60));
  }
  expect(overlapping(step, 0.5, 7)).toBe(0);
});

test('two nodes share the way, and a fixed one leaves it to the other', () => {
  const node = (id, x, y) => ({ id, position: { x, y }, measured: { width: 10, height: 10 } });
  const nodes = [node('a', 0, 0), node('b', 6, 1)];
  const places = (options) => separate(nodes, options).map(({ position }) => position);
  expect(places()).toEqual([
    { x: -2, y: 0 },
    { x: 8, y: 1 },
  ]);
  expect(places({ fixed: ({ id }) => id === 'a' })).toEqual([
    { x: 0, y: 0 },
    { x: 10, y: 1 },
  ]);
  expect(separate(nodes, { fixed: () => true })).toBe(nodes);
  const crowded = [node('a', 0, 0), node('b', 6, 1), node('c', -5, -2), node('d', 1, 7)];
  const around = separate(crowded, { ...whole, fixed: ({ id }) => id === 'a' });
  expect(around[0]).toBe(crowded[0]);
  expect(
    overlapping(
      around.map(({ position }) => ({ position, width: 10, height: 10 })),
      0.5,
    ),
  ).toBe(0);
  expect(separate(nodes, { threshold: 4 })).toBe(nodes);
});

test.each([10, 100])('among %i nodes, hidden ones and those in a parent stay', (count) => {
  const nodes = makeNodes('packed', count).map((node, k) =>
    k % 4 === 1 ? { ...node, hidden: true } : k % 4 === 2 ? { ...node, parentId: 'n0' } : node,
  );
  const apart = separate(nodes, whole);
  const still = ({ hidden, parentId }) => hidden || parentId;
  expect(apart.filter(still)).toEqual(nodes.filter(still));
  expect(
    overlapping(
      apart.filter((node) => !still(node)),
      0.5,
    ),
  ).toBe(0);
});
