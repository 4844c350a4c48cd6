// node bench.mjs [src/lib/datasets.ts of xyflow/node-collision-algorithms]: a table of milliseconds per call, on the
// same nodes, in turns. Every result is checked: no two nodes overlap by more than the threshold.
import { readFileSync } from 'node:fs';
import { findPairs } from 'broadphase';
import { makeNodes, toNode } from './datasets.mjs';
import * as rivals from './rivals.mjs';
import { separate } from './separate.mjs';

const options = { maxIterations: Number.POSITIVE_INFINITY, threshold: 0.5 };
/** A heap of 20,000 takes minutes to come to rest. With more nodes than this, only a few iterations are timed. */
const [most, atMost] = [1500, 3];
const rounds = 5;
/** The least milliseconds of a round, in which a few nodes are separated many times. */
const leastRound = 15;

/** The data sets of xyflow/node-collision-algorithms by name. Only numbers are read from its src/lib/datasets.ts. */
function readDatasets(file) {
  const sets = new Map();
  let nodes = [];
  for (const line of readFileSync(file, 'utf8').split('\n')) {
    const name = /^\s*'(\w+ \d+)': \[/.exec(line)?.[1];
    if (name) {
      nodes = [];
      sets.set(name, nodes);
    }
    if (sets.size > 0 && line.startsWith('}')) break;
    const number = (key) => /-?[\d.]+(e-?\d+)?/.exec(line.split(`${key}: `)[1] ?? '')?.[0];
    if (!number('x')) continue;
    const given = ['x', 'y', 'width', 'height'].flatMap((key) => (number(key) ? [[key, Number(number(key))]] : []));
    nodes.push(toNode(Object.fromEntries(given), nodes.length));
  }
  return sets;
}

/** How many pairs of nodes overlap by more than the threshold along both axes. */
function overlaps(nodes, threshold = options.threshold) {
  const boxes = nodes.flatMap(({ position: { x, y }, width, height }) => [x, y, x + width, y + height]);
  const pairs = findPairs(boxes);
  let count = 0;
  for (let k = 0; k < pairs.length; k += 2) {
    const [a, b] = [4 * pairs[k], 4 * pairs[k + 1]];
    const over = (axis) =>
      Math.min(boxes[a + axis + 2], boxes[b + axis + 2]) - Math.max(boxes[a + axis], boxes[b + axis]);
    count += Number(Math.min(over(0), over(1)) > threshold + 1e-9);
  }
  return count;
}

/** The milliseconds of a call in the fastest round of each, by name. */
function race(nodes, contenders) {
  const entries = Object.entries(contenders);
  const given = nodes.length > most ? { ...options, maxIterations: atMost } : options;
  const times = new Map(entries.map(([name]) => [name, []]));
  for (const [name, contender] of entries) {
    const left = overlaps(contender(nodes, given));
    if (left > 0 && nodes.length <= most)
      throw new Error(`${name} leaves ${left} pairs of ${nodes.length} nodes overlapping`);
  }
  for (let round = 0; round <= rounds; round++) {
    for (const [name, contender] of entries) {
      let calls = 0;
      const started = performance.now();
      do {
        contender(nodes, given);
        calls++;
      } while (performance.now() - started < leastRound);
      if (round > 0) times.get(name).push((performance.now() - started) / calls); // the engine compiles in the first
    }
  }
  return new Map(entries.map(([name]) => [name, times.get(name).sort((a, b) => a - b)[0]]));
}

const [, , file] = process.argv;
const sets = file ? readDatasets(file) : new Map();
for (const kind of ['packed', 'separated', 'clustered']) {
  for (const count of file ? [20_000] : [15, 100, 500, 1500, 20_000])
    if (kind !== 'packed' || count !== 1500) sets.set(`${kind} ${count}`, makeNodes(kind, count)); // which takes minutes
}
console.log(`| nodes | broadphase | ${Object.keys(rivals).join(' | ')} | fastest of these |`);
for (const [name, nodes] of sets) {
  const { naive, quadtree, ...trees } = rivals;
  const contenders = nodes.length > most ? trees : rivals;
  const times = race(nodes, { broadphase: separate, ...contenders });
  const fastest = Math.min(...Object.keys(contenders).map((key) => times.get(key)));
  const cell = (key) => times.get(key)?.toPrecision(3) ?? '–';
  const ratio = (fastest / times.get('broadphase')).toFixed(1);
  console.log(`| ${[name, cell('broadphase'), ...Object.keys(rivals).map(cell)].join(' | ')} | ${ratio}x |`);
}
