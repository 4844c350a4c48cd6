// The worst cases known for techniques that cut the world up, each against a uniform scene of as many boxes and
// about as many pairs, in one process and in turns:
//   npm run bench:worst -- [boxes] [technique]
import { bundle } from '../../scripts/bundle.mjs';
import { median } from '../harness/statistics.mjs';

const { BroadPhase } = await import(await bundle('bench/library.ts', 'build/bench/library.mjs'));
const count = Number(process.argv[2] ?? 100_000);
const technique = process.argv[3] ?? 'strip-sweep';
const rounds = 15;
const size = 10;

let state = 1;
function random() {
  state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
  return state / 2 ** 32;
}

/** Boxes with given lower corners and sizes, per box and axis. */
function make(dimensions, corner, extent = () => size) {
  const boxes = new Float32Array(count * 2 * dimensions);
  for (let k = 0; k < count; k++) {
    for (let axis = 0; axis < dimensions; axis++) {
      const at = corner(k, axis);
      boxes[k * 2 * dimensions + axis] = at;
      boxes[k * 2 * dimensions + dimensions + axis] = at + extent(k, axis);
    }
  }
  return boxes;
}

/** The side of a world in which boxes of one size have this density. */
const side = (dimensions, density) => ((count * size ** dimensions) / density) ** (1 / dimensions);
const uniform = (dimensions, density, unit = 1) => {
  const world = side(dimensions, density);
  return make(
    dimensions,
    () => random() * (world - size) * unit,
    () => size * unit,
  );
};

const cases = {
  'tiny cluster, 0.1 % outliers': (d) =>
    make(d, (k) => (k % 1000 === 0 ? (random() - 0.5) * 1e9 : random() * side(d, 0.25))),
  'tiny cluster, 5 % outliers': (d) =>
    make(d, (k) => (k % 20 === 0 ? (random() - 0.5) * 1e6 : random() * side(d, 0.25))),
  '100 infinite boxes': (d) => {
    const boxes = uniform(d, 0.25);
    for (let k = 0; k < 100; k++) {
      const at = Math.floor((k * count) / 100) * 2 * d;
      boxes.fill(-Infinity, at, at + d).fill(Infinity, at + d, at + 2 * d);
    }
    return boxes;
  },
  denormals: (d) => uniform(d, 0.25, 1e-44),
  'all in one column': (d) => make(d, (_, axis) => random() * (axis === 1 ? count * 20 : 5)),
  'all in one exact column': (d) => make(d, (_, axis) => (axis === 1 ? random() * count * 20 : 0)),
};

function timed(space) {
  const start = performance.now();
  space.update();
  return performance.now() - start;
}

function prepared(dimensions, boxes) {
  const space = new BroadPhase({ dimensions, technique }).setAll(boxes).update();
  return { space, times: [] };
}

console.log(`${count} boxes, ${technique}: median ms of ${rounds} rounds\n`);
for (const dimensions of [2, 3]) {
  for (const [name, boxes] of Object.entries(cases)) {
    const worst = prepared(dimensions, boxes(dimensions));
    const pairs = worst.space.pairCount;
    // In a uniform scene of density d a box overlaps 2^dimensions * d others.
    const even = prepared(dimensions, uniform(dimensions, Math.max(1e-4, (2 * pairs) / count / 2 ** dimensions)));
    for (let round = 0; round < rounds; round++) {
      for (const { space, times } of [worst, even]) times.push(timed(space));
    }
    const [a, b] = [median(worst.times), median(even.times)];
    console.log(
      `${`${name} ${dimensions}D`.padEnd(34)}${a.toFixed(2).padStart(8)} against ${b.toFixed(2).padStart(8)}: ` +
        `${(a / b).toFixed(2)}x  (${pairs} and ${even.space.pairCount} pairs)`,
    );
  }
}
