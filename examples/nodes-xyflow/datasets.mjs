// Seeded random nodes to push apart, in the three arrangements of the benchmark of xyflow/node-collision-algorithms.

const size = 50;

/** Pseudorandom numbers from 0 to 1, the same for the same seed. */
export function seeded(seed) {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

export const toNode = ({ x, y, width = size, height = size }, k) => ({
  id: `n${k}`,
  position: { x, y },
  width,
  height,
  data: { label: String(k + 1) },
});

const kinds = {
  /** One heap: each node overlaps about four others. */
  packed(count, random) {
    const side = 0.8 * size * Math.sqrt(count);
    return { x: side * random(), y: side * random() };
  },
  /** None overlap. */
  separated(count, random, k) {
    const columns = Math.ceil(Math.sqrt(count));
    const step = 1.6 * size;
    const jitter = () => 0.5 * size * random();
    return { x: step * (k % columns) + jitter(), y: step * Math.floor(k / columns) + jitter() };
  },
  /** Groups of about eight overlapping nodes, far from each other. */
  clustered(count, random, k) {
    const groups = Math.ceil(count / 8);
    const columns = Math.ceil(Math.sqrt(groups));
    const group = k % groups;
    const near = () => size * random() * 1.6;
    return { x: 5 * size * (group % columns) + near(), y: 5 * size * Math.floor(group / columns) + near() };
  },
};

/** Nodes of one kind: 'packed', 'separated' or 'clustered'. */
export function makeNodes(kind, count, seed = 1) {
  const random = seeded(seed);
  return Array.from({ length: count }, (_, k) => toNode(kinds[kind](count, random, k), k));
}
