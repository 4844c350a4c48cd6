// node bench.mjs: milliseconds to apply the force once, and to place all labels of a map, on the same input, in turns.
// Results are checked: after the pushes no two rectangles overlap, and all place the same labels.
import { forceSimulation, forceX, forceY } from 'd3-force';
import { firstScales } from './first-scales.mjs';
import { forceCollideRect } from './force-collide-rect.mjs';
import * as rivals from './rivals.mjs';
import { placesOf, seeded } from './words.mjs';

const rounds = 7;
/** The least milliseconds of a round. */
const leastRound = 10;
const width = (node) => node.width;
const height = (node) => node.height;

/** The milliseconds of each in its fastest round, in turns. `prepare` runs before each call and is not timed. */
function race(contenders, prepare = () => {}) {
  const times = new Map(Object.keys(contenders).map((name) => [name, []]));
  for (let round = 0; round <= rounds; round++) {
    for (const [name, work] of Object.entries(contenders)) {
      let [total, count] = [0, 0];
      do {
        prepare();
        const started = performance.now();
        work();
        total += performance.now() - started;
        count++;
      } while (total < leastRound);
      if (round > 0) times.get(name).push(total / count); // the engine compiles in the first
    }
  }
  return new Map([...times].map(([name, taken]) => [name, taken.sort((a, b) => a - b)[0]]));
}

function print(title, times) {
  const [ours] = times.values();
  const cells = Array.from(times.values(), (taken) => `${taken.toPrecision(3)} (${(taken / ours).toFixed(1)}x)`);
  console.log(`| ${[title, ...cells].join(' | ')} |`);
}

/** Rectangles of mixed sizes, as after a few ticks: most of them have room. */
function rectangles(count) {
  const random = seeded(count);
  const side = 34 * Math.sqrt(count);
  return Array.from({ length: count }, () => ({
    x: side * random(),
    y: side * random(),
    width: 8 + 60 * random() ** 3,
    height: 8 + 40 * random() ** 3,
    vx: 0,
    vy: 0,
  }));
}

const makers = { broadphase: forceCollideRect, ...rivals.rectangles };
console.log(`| rectangles | ${Object.keys(makers).join(' | ')} |`);
for (const count of [100, 300, 1000, 5000, 20_000]) {
  const nodes = rectangles(count);
  const forces = Object.entries(makers).map(([name, make]) => {
    const force = make(width, height, 2);
    force.initialize(nodes, Math.random);
    return [name, force];
  });
  const rest = () => {
    for (const node of nodes) node.vx = node.vy = 0;
  };
  print(count, race(Object.fromEntries(forces), rest));
}

/** The overlaps that are left, and the space taken, when 300 rectangles are attracted to a point. */
console.log('\n300 rectangles drawn to a point, after 400 ticks: pairs that overlap by more than 0.5, mean distance');
for (const [name, make] of Object.entries(makers)) {
  const nodes = rectangles(300);
  const collide = make(width, height, 2);
  const thrice = () => {
    for (let turn = 0; turn < 3; turn++) collide();
  };
  thrice.initialize = collide.initialize;
  forceSimulation(nodes)
    .force('x', forceX(0).strength(0.05))
    .force('y', forceY(0).strength(0.05))
    .force('collide', thrice)
    .stop()
    .tick(400);
  let over = 0;
  for (const [k, a] of nodes.entries()) {
    for (const b of nodes.slice(k + 1)) {
      const alongX = (a.width + b.width) / 2 - Math.abs(a.x - b.x);
      over += Number(Math.min(alongX, (a.height + b.height) / 2 - Math.abs(a.y - b.y)) > 0.5);
    }
  }
  const distance = nodes.reduce((sum, { x, y }) => sum + Math.hypot(x, y), 0) / nodes.length;
  console.log(`${name}: ${over}, ${distance.toFixed(0)}`);
}

const finders = { broadphase: firstScales, ...rivals.labels };
console.log(`\n| labels, 13 scales | ${Object.keys(finders).join(' | ')} |`);
const scales = Array.from({ length: 13 }, (_, k) => 2 ** (k / 2));
for (const count of [1000, 5000, 20_000, 100_000]) {
  const labels = placesOf(count).map((place) => ({
    ...place,
    width: 6.5 * place.name.length,
    height: 1.3 * place.size,
  }));
  const { 'every shown': plain, ...fast } = finders;
  const contenders = count > 5000 ? fast : { ...fast, 'every shown': plain };
  const expected = firstScales(labels, scales).join();
  for (const [name, finder] of Object.entries(contenders)) {
    if (finder(labels, scales).join() !== expected) throw new Error(`${name} shows other labels`);
  }
  const works = Object.entries(contenders).map(([name, finder]) => [name, () => finder(labels, scales)]);
  print(count, race(Object.fromEntries(works)));
}
