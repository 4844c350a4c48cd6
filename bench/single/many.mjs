// Queries asked many at a time, and the pairs of two spaces, in turns and in one run: many in a call against one by one,
// `nearests` against kdbush and flatbush, `pairsWith` against one space with a level that is static.
//   node bench/single/many.mjs [--count 100000]
// Milliseconds are medians; read the ratios. What a camera sees is in examples/culling-three/bench.mjs.
import { parseArgs } from 'node:util';
import Flatbush from 'flatbush';
import KDBush from 'kdbush';
import { bundle } from '../../scripts/bundle.mjs';

const { values } = parseArgs({ options: { count: { type: 'string' } } });
const counts = values.count ? values.count.split(',').map(Number) : [10_000, 100_000];
const { BroadPhase, createRandom, createScene } = await import(
  await bundle('bench/library.ts', 'build/bench/library.mjs')
);

const asked = 10_000;
const median = (times) => times.sort((a, b) => a - b)[times.length >> 1];

/** Times contenders in turns; returns the median of each. Each returns a number, to detect differences. */
function race(contenders, prepare = () => {}, warmUp = 5, timed = 15) {
  const times = contenders.map(() => []);
  for (let turn = 0; turn < warmUp + timed; turn++) {
    prepare(turn);
    const answers = contenders.map((contender, k) => {
      const started = performance.now();
      const answer = contender(turn);
      if (turn >= warmUp) times[k].push(performance.now() - started);
      return answer;
    });
    if (new Set(answers).size > 1) throw new Error(`answers differ: ${answers}`);
  }
  return times.map(median);
}

const cells = (times) => times.map((time) => `${time.toPrecision(3)} (${(times[0] / time).toFixed(2)}x)`).join(' | ');
const spaceOf = (scene) => new BroadPhase({ dimensions: scene.dimensions }).setAll(scene.boxes).update();

/** Seeded numbers of many queries; `make` gives those of one. */
function queries(scene, seed, make) {
  const random = createRandom(seed);
  return Float64Array.from(Array.from({ length: asked }, () => make(() => scene.world * random(), random)).flat());
}

function bulk(count) {
  console.log(`\n## ${asked} queries in a call against one by one, ${count} boxes at rest`);
  console.log('| query | one by one | in a call |\n| --- | --- | --- |');
  for (const dimensions of [2, 3]) {
    const scene = createScene(`uniform${dimensions}d`, count);
    const space = spaceOf(scene);
    const axes = Array.from({ length: dimensions });
    const side = dimensions === 2 ? 80 : 34;
    const boxes = queries(scene, 1, (place) => {
      const at = axes.map(place);
      return [...at, ...at.map((x) => x + side)];
    });
    const rays = queries(scene, 2, (place, random) => [...axes.map(place), ...axes.map(() => random() - 0.5)]);
    const points = queries(scene, 3, (place) => axes.map(place));
    const ids = { out: [] };
    const ray = { maxDistance: 200, out: { id: 0, distance: 0, normal: [] } };
    const many = { boxes: {}, rays: { maxDistance: 200 }, near: {} };
    const each = (numbers, width, ask) => {
      let sum = 0;
      for (let at = 0; at < numbers.length; at += width) sum += ask(numbers, at);
      return sum;
    };
    const flat = dimensions === 2;
    const contenders = {
      'boxes, 20 answers': [
        () =>
          each(boxes, 2 * dimensions, (q, at) =>
            flat
              ? space.queryBox(q[at], q[at + 1], q[at + 2], q[at + 3], ids).length
              : space.queryBox(q[at], q[at + 1], q[at + 2], q[at + 3], q[at + 4], q[at + 5], ids).length,
          ),
        () => {
          many.boxes.out = space.queryBoxes(boxes, many.boxes);
          return many.boxes.out.offsets[asked];
        },
      ],
      'rays of 200': [
        () =>
          each(rays, 2 * dimensions, (q, at) =>
            flat
              ? Number(space.rayCast(q[at], q[at + 1], q[at + 2], q[at + 3], ray) !== undefined)
              : Number(space.rayCast(q[at], q[at + 1], q[at + 2], q[at + 3], q[at + 4], q[at + 5], ray) !== undefined),
          ),
        () => {
          many.rays.out = space.rayCasts(rays, many.rays);
          return many.rays.out.offsets[asked];
        },
      ],
      '10 nearest': [
        () =>
          each(points, dimensions, (q, at) =>
            flat
              ? space.nearest(q[at], q[at + 1], 10, ids).length
              : space.nearest(q[at], q[at + 1], q[at + 2], 10, ids).length,
          ),
        () => {
          many.near.out = space.nearests(points, 10, many.near);
          return many.near.out.offsets[asked];
        },
      ],
    };
    for (const [name, pair] of Object.entries(contenders))
      console.log(`| ${dimensions}D ${name} | ${cells(race(pair))} |`);
  }
}

/** Points in kdbush: circles that double until they contain enough points, which are then sorted. */
function nearestByKdbush(index, xs, ys, x, y, k, first) {
  for (let radius = first; ; radius *= 2) {
    const found = index.within(x, y, radius);
    if (found.length < k) continue;
    found.sort((a, b) => (xs[a] - x) ** 2 + (ys[a] - y) ** 2 - (xs[b] - x) ** 2 - (ys[b] - y) ** 2);
    found.length = k;
    return found;
  }
}

function neighbours(count) {
  console.log(`\n## The k nearest of ${asked} points among ${count} points`);
  console.log('| k | moved | nearests | one by one | kdbush | flatbush |\n| --- | --- | --- | --- | --- | --- |');
  for (const k of [1, 10, 50]) {
    for (const moved of [false, true]) {
      const random = createRandom(7);
      const world = Math.sqrt(count);
      const xs = Float64Array.from({ length: count }, () => Math.fround(world * random()));
      const ys = Float64Array.from({ length: count }, () => Math.fround(world * random()));
      const points = Float64Array.from({ length: 2 * asked }, () => world * random());
      const boxes = new Float32Array(4 * count);
      const space = new BroadPhase();
      const ids = { out: [] };
      const many = {};
      let index;
      let packed;
      const build = {
        space() {
          for (let id = 0; id < count; id++) {
            boxes[4 * id] = boxes[4 * id + 2] = xs[id];
            boxes[4 * id + 1] = boxes[4 * id + 3] = ys[id];
          }
          space.setAll(boxes).update();
        },
        kdbush() {
          index = new KDBush(count);
          for (let id = 0; id < count; id++) index.add(xs[id], ys[id]);
          index.finish();
        },
        flatbush() {
          packed = new Flatbush(count, 16, Float32Array);
          for (let id = 0; id < count; id++) packed.add(xs[id], ys[id], xs[id], ys[id]);
          packed.finish();
        },
      };
      for (const each of Object.values(build)) each();
      const first = 1.3 * Math.sqrt(k / Math.PI);
      const times = race(
        [
          () => {
            if (moved) build.space();
            many.out = space.nearests(points, k, many);
            return many.out.offsets[asked];
          },
          () => {
            if (moved) build.space();
            let sum = 0;
            for (let at = 0; at < 2 * asked; at += 2) sum += space.nearest(points[at], points[at + 1], k, ids).length;
            return sum;
          },
          () => {
            if (moved) build.kdbush();
            let sum = 0;
            for (let at = 0; at < 2 * asked; at += 2)
              sum += nearestByKdbush(index, xs, ys, points[at], points[at + 1], k, first).length;
            return sum;
          },
          () => {
            if (moved) build.flatbush();
            let sum = 0;
            for (let at = 0; at < 2 * asked; at += 2) sum += packed.neighbors(points[at], points[at + 1], k).length;
            return sum;
          },
        ],
        () => {
          for (let id = 0; moved && id < count; id++)
            xs[id] = Math.fround(Math.min(world, Math.max(0, xs[id] + random() - 0.5)));
        },
      );
      console.log(`| ${k} | ${moved ? 'all' : 'none'} | ${cells(times)} |`);
    }
  }
}

function between(count) {
  console.log(`\n## A level of ${count} boxes at rest, and movers: frames`);
  console.log(
    '| movers | one space, level static | two spaces | two, movers all set at once |\n| --- | --- | --- | --- |',
  );
  for (const movers of [100, 1000, 10_000]) {
    const scene = createScene('uniform2d', count);
    const { boxes, world } = scene;
    const random = createRandom(3);
    const at = Float64Array.from({ length: 2 * movers }, () => Math.fround(world * random()));
    const numbers = new Float64Array(4 * movers);
    const level = new BroadPhase().setAll(boxes).update();
    const [others, atOnce] = [new BroadPhase(), new BroadPhase()];
    const merged = new BroadPhase().setAll(boxes);
    for (let id = 0; id < count; id++) merged.setStatic(id);
    const setEach = (space, first) => {
      for (let k = 0; k < movers; k++) {
        space.set(first + k, numbers[4 * k], numbers[4 * k + 1], numbers[4 * k + 2], numbers[4 * k + 3]);
      }
    };
    const within = (pairs) => {
      let inside = 0;
      for (let k = 0; k < pairs.length; k += 2) inside += Number(pairs[k] >= count);
      return pairs.length / 2 - inside;
    };
    let found = 0;
    const times = race(
      [
        () => {
          setEach(merged, count);
          found = merged.update().pairs;
          return 0;
        },
        () => {
          setEach(others, 0);
          return 0 * others.update().pairsWith(level).length;
        },
        () => 0 * atOnce.setAll(numbers).update().pairsWith(level).length,
      ],
      () => {
        for (let k = 0; k < 2 * movers; k++) at[k] = Math.fround(at[k] + random() - 0.5);
        for (let k = 0; k < movers; k++)
          numbers.set([at[2 * k], at[2 * k + 1], at[2 * k] + 10, at[2 * k + 1] + 10], 4 * k);
      },
      300, // a frame takes microseconds: fewer frames are spent before the engine has compiled all of it
      100,
    );
    const pairs = others.pairsWith(level).length / 2;
    if (within(found) !== pairs) throw new Error(`pairs differ: ${within(found)} and ${pairs}`);
    console.log(`| ${movers} | ${cells(times)} |`);
  }
}

for (const count of counts) {
  bulk(count);
  neighbours(count);
}
between(100_000);
