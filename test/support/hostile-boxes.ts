// Sets of boxes that break broad phases: all in one place, all far apart, without size, infinite, and with numbers at
// the limits of float32 and beyond. Each set is made, and its exact pairs found, only once.
import { createRandom } from '../../src/scenes/random.ts';
import { type Numbers, referencePairs } from './reference.ts';

export interface Case {
  readonly name: string;
  readonly boxes: () => number[];
  /** The reference's pairs of `boxes`, as sorted keys. */
  readonly expected: () => Float64Array;
  /** The same boxes rounded to float32, which changes some of them. */
  readonly floats: () => Float32Array;
  readonly expectedOfFloats: () => Float64Array;
}

type Box = readonly (readonly [min: number, max: number])[];

const everything = [-Infinity, Infinity] as const;

/** The hostile sets for 2 or 3 dimensions. */
export function hostileCases(dimensions: 2 | 3): Case[] {
  const axes = Array.from({ length: dimensions }, (_, axis) => axis);
  const cases: Case[] = [];

  function add(name: string, make: (random: () => number) => Iterable<Box>) {
    const seed = cases.length;
    const boxes = once(() =>
      [...make(createRandom(seed))].flatMap((box) => [...box.map(([min]) => min), ...box.map(([, max]) => max)]),
    );
    const floats = once(() => Float32Array.from(boxes()));
    const answer = (of: () => Numbers) => once(() => referencePairs(of(), dimensions));
    cases.push({ name, boxes, expected: answer(boxes), floats, expectedOfFloats: answer(floats) });
  }

  /** The same extent along every axis. */
  const cube = (min: number, max: number): Box => axes.map(() => [min, max]);
  const many = <T>(count: number, make: (index: number) => T): T[] => Array.from({ length: count }, (_, k) => make(k));
  /** `count` boxes of size up to `size` anywhere between `low` and `high`. */
  const spread = (random: () => number, count: number, low: number, high: number, size: number) =>
    many(count, () =>
      axes.map(() => {
        const min = low + random() * (high - low);
        return [min, min + random() * size] as const;
      }),
    );
  /** The cells of a grid with `side` cells along each axis, cut at the given places. */
  const cells = (side: number, cut: (k: number) => number) =>
    many(side ** dimensions, (k) =>
      axes.map((axis) => {
        const place = Math.floor(k / side ** axis) % side;
        return [cut(place), cut(place + 1)] as const;
      }),
    );
  const side = dimensions === 2 ? 30 : 9;

  add('no box', () => []);
  add('one box', () => [cube(1, 2)]);
  add('one box of no size', () => [cube(0, 0)]);
  add('two boxes that overlap', () => [cube(0, 2), cube(1, 3)]);
  add('two boxes apart', () => [cube(0, 1), cube(2, 3)]);
  add('two boxes that overlap on all axes but one', () => [cube(0, 2), axes.map((a) => (a === 0 ? [0, 2] : [3, 4]))]);
  add('all boxes identical', () => many(300, () => cube(1, 2)));
  add('all boxes the same point', () => many(150, () => cube(0, 0)));
  add('boxes nested in one another', () => many(150, (k) => cube(-k, k)));

  for (const line of axes) {
    add(`all in one line along axis ${line}`, (random) =>
      many(1500, () => axes.map((axis) => (axis === line ? extent(random() * 1000, 1) : [5, 6]))),
    );
    add(`all in one column across axis ${line}`, (random) =>
      many(1500, () => axes.map((axis) => (axis === line ? [5, 6] : extent(random() * 100, 1)))),
    );
    add(`long bars that cross those along axis ${line}`, (random) =>
      many(300, (k) => {
        const along = k % 2 ? line : (line + 1) % dimensions;
        return axes.map((axis) => (axis === along ? [0, 1000] : extent(random() * 1000, 1)));
      }),
    );
  }
  add('needles along all axes, some of no end, and outliers', (random) => [
    ...many(600, (k) =>
      axes.map((axis) => {
        const min = integer(random, 120);
        return axis === k % dimensions ? extent(min - 200, 250) : extent(min, 0.5);
      }),
    ),
    ...many(9, (k) => axes.map((axis) => (axis === k % dimensions ? everything : extent(integer(random, 120), 2)))),
    cube(1e9, 1e9 + 1),
    cube(-1e9, -1e9 + 1),
  ]);
  add('one box over everything', (random) => [...spread(random, 1500, 0, 500, 10), cube(-1, 511)]);
  add('one small box among boxes in descending order', () => [
    cube(7.5, 7.6),
    ...many(500, (k) => cube(500 - k, 500.5 - k)),
  ]);

  add('cells that touch at edges and corners', () => cells(side, (k) => k));
  add('cells that touch at tenths, which are no binary fractions', () => cells(side, (k) => k * 0.1));
  add('cells that touch around zero, from the side of minus zero', () => [
    cube(-1, -0),
    cube(0, 1),
    cube(-0, -0),
    cube(0, 0),
  ]);
  add('cells that miss each other by 1e-12', () =>
    cells(side, (k) => k * 0.1).map((box, k) => (k % 2 ? box : box.map(([min, max]) => [min, max - 1e-12] as const))),
  );
  add('points on a lattice, some many times, among boxes', (random) => [
    ...many(800, () => axes.map(() => extent(Math.floor(random() * 12), 0))),
    ...many(100, () => axes.map(() => extent(Math.floor(random() * 12), 2))),
  ]);

  add('half spaces, slabs, whole spaces and boxes', (random) => [
    ...spread(random, 700, -100, 100, 5),
    ...many(30, (k) => axes.map((axis) => (axis === k % dimensions ? [100 - k * 7, Infinity] : everything)) as Box),
    ...many(30, (k) => axes.map((axis) => (axis === k % dimensions ? [-Infinity, k * 7 - 100] : everything)) as Box),
    ...many(30, (k) => axes.map((axis) => (axis === k % dimensions ? [k - 2, k + 2] : everything)) as Box),
    ...many(10, () => axes.map(() => everything)),
  ]);
  add('nothing but whole spaces', () => many(100, () => axes.map(() => everything)));
  add('places at infinity itself', () => [
    cube(Infinity, Infinity),
    cube(-Infinity, -Infinity),
    cube(0, Infinity),
    cube(-Infinity, 0),
    cube(Infinity, Infinity),
    cube(1e308, 1.5e308),
    cube(3, 4),
  ]);

  add('coordinates of 1e9', (random) => spread(random, 1000, 1e9, 1e9 + 200, 10));
  add('coordinates of -1e9', (random) => spread(random, 1000, -1e9 - 200, -1e9, 10));
  add('coordinates of 1e-30', (random) => spread(random, 1000, 0, 2e-28, 1e-29));
  add('coordinates of 1e9 and of 1e-30', (random) => [
    ...spread(random, 400, -1e-28, 1e-28, 1e-29),
    ...spread(random, 400, 1e9 - 200, 1e9, 10),
    ...spread(random, 50, -1e9, 1e9, 1e8),
    cube(0, 1e9),
    cube(-1e9, 1e-30),
  ]);
  add('denormals of float32', (random) =>
    many(600, () => axes.map(() => extent(integer(random, 80) * 2 ** -149, 3 * 2 ** -149))),
  );
  add('denormals of double', (random) =>
    many(600, () => axes.map(() => extent(integer(random, 80) * 5e-324, 15e-324))),
  );
  add('sizes and places over 200 powers of two', (random) =>
    many(800, () => {
      const scale = 2 ** (200 * random() - 100);
      return axes.map(() => extent((random() - 0.5) * scale, random() * scale));
    }),
  );
  add('the largest numbers of float32, and larger ones', () => [
    cube(3.4028234663852886e38, 3.4028234663852886e38),
    cube(3.4028234663852886e38, 1e39),
    cube(3.41e38, 3.42e38),
    cube(3.43e38, 1e300),
    cube(1e300, 1e300),
    cube(1.1e300, Number.MAX_VALUE),
    cube(-Number.MAX_VALUE, -1e39),
    cube(-1e39, -3.4028234663852886e38),
    cube(0, Infinity),
    cube(Number.MAX_VALUE, Infinity),
  ]);

  add('a tiny cluster and outliers', (random) => [
    ...spread(random, 1000, 0, 1e-3, 4e-5),
    ...many(10, (k) => cube((k - 5) * 1e9, (k - 5) * 1e9 + 1)),
  ]);
  add('two clusters far apart', (random) => [
    ...spread(random, 500, 0, 20, 1),
    ...spread(random, 500, 1e6, 1e6 + 20, 1),
  ]);
  add('doubles that float32 cannot tell apart', (random) =>
    many(500, () => axes.map(() => extent(1 + integer(random, 40) * 2 ** -50, integer(random, 12) * 2 ** -50))),
  );
  add('doubles that float32 cannot hold among floats', (random) =>
    many(1000, (k) =>
      axes.map(() => {
        const nudge = k % 2 ? 0 : 1e-12;
        const min = integer(random, 60) + nudge * integer(random, 2);
        return [min, Math.max(min, Math.round(min) + integer(random, 4) + nudge * integer(random, 2))] as const;
      }),
    ),
  );
  return cases;
}

const extent = (min: number, size: number): readonly [number, number] => [min, min + size];

const integer = (random: () => number, below: number) => Math.floor(random() * below);

function once<T>(make: () => T): () => T {
  let made: T | undefined;
  return () => {
    made ??= make();
    return made;
  };
}
