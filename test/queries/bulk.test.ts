// Many queries in one call: each is answered as by a look at every box, whatever the order inside.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';
import type { Entry } from '../support/model.ts';
import { type Asked, ahead, inBox, inCircle, near, nearBox, type Ranked } from '../support/query-reference.ts';

type Many = {
  ids: Uint32Array;
  offsets: Uint32Array;
  distances?: Float64Array;
  times?: Float64Array;
  normals?: Int8Array;
  of?: Uint32Array;
};
type Call = (...given: unknown[]) => Many;

const ascending = (ids: Iterable<number>) => [...ids].sort((a, b) => a - b);
const idsOf = ({ ids, offsets }: Many, k: number) => [...ids.subarray(offsets[k], offsets[k + 1])];

/** The hits of a query, as the reference has them. */
function hitsOf(answer: Many, k: number, dimensions: number): Ranked[] {
  const ranks = answer.distances ?? answer.times!;
  return idsOf(answer, k).map((id, n) => {
    const at = answer.offsets[k]! + n;
    const normal = answer.normals?.subarray(at * dimensions, (at + 1) * dimensions) ?? [];
    return { id, rank: ranks[at]!, normal: [...normal] };
  });
}

class Scene {
  readonly space: BroadPhase<2 | 3>;
  readonly entries = new Map<number, Entry>();
  readonly random: () => number;
  readonly #d: number;
  readonly #single: boolean;

  constructor(dimensions: 2 | 3, single: boolean, seed: number) {
    this.space = new BroadPhase<2 | 3>({ dimensions } as never);
    this.random = createRandom(seed);
    this.#d = dimensions;
    this.#single = single;
  }

  below(n: number): number {
    return Math.floor(this.random() * n);
  }
  place(): number {
    const x = this.random() < 0.5 ? this.below(40) : this.random() * 40;
    return this.#single ? Math.fround(x) : x;
  }
  point(): number[] {
    return Array.from({ length: this.#d }, () => this.place());
  }
  box(): number[] {
    const [a, b] = [this.point(), this.point()];
    const reach = this.random() < 0.1 ? 1 : 0.1;
    const round = this.#single ? Math.fround : (x: number) => x;
    return [...a, ...a.map((x, k) => round(x + b[k]! * reach))];
  }

  change(): void {
    for (let k = this.below(100); k >= 0; k--) {
      const id = this.below(300);
      if (this.random() < 0.2) {
        this.space.delete(id);
        this.entries.delete(id);
        continue;
      }
      const box = this.box();
      const layer = 1 + this.below(3);
      (this.space.set as (...box: number[]) => unknown).call(this.space, id, ...box);
      this.space.setFilter(id, layer, 0xffffffff);
      this.entries.set(id, { box, layer, mask: 0xffffffff } as Entry);
    }
    this.space.update();
  }
}

const cases = [2, 3].flatMap((d) => [true, false].map((single) => [d as 2 | 3, single] as const));
describe.each(cases)('in %iD, of float32 (%s)', (dimensions, single) => {
  test('each query is answered as by a look at every box', { tags: 'long' }, () => {
    const seed = Number(process.env.SEED ?? 41);
    console.info(`seed ${seed}`);
    const scene = new Scene(dimensions, single, seed);
    const call = scene.space as unknown as Record<string, Call>;
    const kept: Record<string, Many> = {};
    const ask = (name: string, queries: number[][], options: object, k?: number) => {
      const numbers = queries.flat();
      const given = scene.random() < 0.5 ? numbers : new Float64Array(numbers);
      const rest = k === undefined ? [] : [k];
      const fresh = call[name]!(given, ...rest, options);
      kept[name] = call[name]!(given, ...rest, { ...options, out: kept[name] });
      expect(kept[name].offsets.subarray(0, queries.length + 1), name).toEqual(fresh.offsets);
      expect(kept[name].ids.subarray(0, fresh.ids.length), name).toEqual(fresh.ids);
      expect(fresh.offsets.length).toBe(queries.length + 1);
      expect(fresh.offsets.at(-1)).toBe(fresh.ids.length);
      return fresh;
    };
    for (let round = 0; round < 12; round++) {
      if (round > 0) scene.change();
      const { entries } = scene;
      const count = scene.below(40);
      const many = <T>(one: () => T): T[] => Array.from({ length: count }, one);
      const mask = scene.random() < 0.5 ? 1 + scene.below(3) : undefined;
      const ignoreEach = scene.random() < 0.5 ? many(() => scene.below(300)) : undefined;
      const common = { mask, ...(ignoreEach && { ignoreEach }) };
      const asked = (k: number): Asked => ({
        ...(mask !== undefined && { mask }),
        ...(ignoreEach && { ignore: ignoreEach[k]! }),
      });
      const boxes = many(() => scene.box());
      const points = many(() => scene.point());

      const within = scene.random() < 0.3;
      const inBoxes = ask('queryBoxes', boxes, { ...common, within });
      const atPoints = ask('queryPoints', points, common);
      const circles = points.map((point) => [...point, scene.random() < 0.1 ? Infinity : scene.below(10)]);
      const inCircles = ask('queryCircles', circles, common);
      const maxDistance = scene.random() < 0.5 ? scene.below(30) : Infinity;
      const rays = points.map((point) => [...point, ...scene.point().map((x) => x - 20)]);
      const hits = ask('rayCasts', rays, { ...common, maxDistance });
      const moving = boxes.map((box) => [...box, ...scene.point().map((x) => Math.floor(x) - 20)]);
      const met = ask('sweeps', moving, common);
      const most = scene.random() < 0.1 ? Infinity : 1 + scene.below(30);
      const nearest = ask('nearests', points, { ...common, maxDistance }, most);
      for (let k = 0; k < count; k++) {
        const one = asked(k);
        expect(ascending(idsOf(inBoxes, k))).toEqual(inBox(entries, boxes[k]!, { ...one, within }));
        expect(ascending(idsOf(atPoints, k))).toEqual(inBox(entries, [...points[k]!, ...points[k]!], one));
        expect(ascending(idsOf(inCircles, k))).toEqual(inCircle(entries, points[k]!, circles[k]!.at(-1)!, one));
        const way = rays[k]!.slice(dimensions);
        const longest = Math.max(...way.map(Math.abs));
        const length = longest && longest * Math.sqrt(way.reduce((sum, x) => sum + (x / longest) ** 2, 0));
        const from = [...points[k]!, ...points[k]!];
        const first = ahead(entries, from, way, maxDistance, one, length).slice(0, 1);
        expect(hitsOf(hits, k, dimensions)).toEqual(first);
        const way2 = moving[k]!.slice(2 * dimensions);
        expect(hitsOf(met, k, dimensions)).toEqual(ahead(entries, boxes[k]!, way2, 1, one).slice(0, 1));
        expect(hitsOf(nearest, k, dimensions)).toEqual(near(entries, points[k]!, most, { ...one, maxDistance }));
      }

      const join = call.nearestsOfAll!(most, { mask, maxDistance });
      expect(ascending(join.of!)).toEqual(ascending(entries.keys()));
      for (const [n, id] of join.of!.entries()) {
        const asked = { ...(mask !== undefined && { mask }), maxDistance, ignore: id };
        const expected = nearBox(entries, entries.get(id)!.box, most, asked);
        expect(hitsOf(join, n, dimensions)).toEqual(expected);
      }
    }
  });
});

test.each(cases)(
  'in %iD, of float32 (%s), hundreds of boxes find among thousands what each finds alone, in the same order',
  (dimensions, single) => {
    const scene = new Scene(dimensions, single, 42);
    const at = () => 40 * scene.place();
    const small = () => {
      const from = Array.from({ length: dimensions }, at);
      return [...from, ...from.map((x) => x + scene.below(30))];
    };
    for (let id = 0; id < 5000; id++) {
      (scene.space.set as (...box: number[]) => unknown).call(scene.space, id, ...small());
      if (id % 3 === 0) scene.space.setFilter(id, 2, 0xffffffff);
    }
    for (let id = 0; id < 5000; id += 40) scene.space.delete(id);
    scene.space.update();
    const boxes = Array.from({ length: 300 }, (_, k) =>
      k % 50 === 7 ? [...Array(dimensions).fill(-Infinity), ...Array(dimensions).fill(Infinity)] : small(),
    );
    const call = scene.space as unknown as Record<string, Call>;
    const one = scene.space.queryBox as (...given: unknown[]) => number[];
    for (const options of [{}, { touching: false }, { mask: 2 }]) {
      const { ids, offsets } = call.queryBoxes!(boxes.flat(), options);
      boxes.forEach((box, k) => {
        expect([...ids.subarray(offsets[k], offsets[k + 1])]).toEqual(one.call(scene.space, ...box, options));
      });
    }
  },
);

test('infinite boxes that meet have distance 0', () => {
  const space = new BroadPhase();
  space.set(0, Infinity, 0, Infinity, 1).set(1, 5, 0, Infinity, 1).set(2, -Infinity, 3, 0, 4).update();
  const { of, ids, offsets, distances } = space.nearestsOfAll(1);
  expect([...of]).toEqual([0, 1, 2]);
  expect([...offsets]).toEqual([0, 1, 2, 3]);
  expect([...ids]).toEqual([1, 0, 1]);
  expect([...distances]).toEqual([0, 0, Math.sqrt(29)]);
});

test('a box that is off has no neighbours and is not one', () => {
  const space = new BroadPhase();
  for (let id = 0; id < 4; id++) space.set(id, 10 * id, 0, 10 * id + 1, 1);
  space.setEnabled(1, false).update();
  const { of, ids, offsets } = space.nearestsOfAll(1);
  expect([...of]).toEqual([0, 1, 2, 3]);
  expect([...offsets]).toEqual([0, 1, 1, 2, 3]);
  expect([...ids]).toEqual([2, 3, 2]);
});

test('more neighbours than memory holds are refused at once, and the space still answers', { tags: 'long' }, () => {
  const space = new BroadPhase();
  const side = 150;
  space.setAll(
    Float64Array.from({ length: 4 * side * side }, (_, k) => [k >> 2, (k >> 2) / side][k % 2]! + (k % 4 > 1 ? 1 : 0)),
  );
  space.update();
  expect(() => space.nearestsOfAll(Number.POSITIVE_INFINITY)).toThrow(/^nearestsOfAll: out of memory: \d+ more bytes/);
  expect(space.nearestsOfAll(Number.POSITIVE_INFINITY, { mask: 0 }).ids).toHaveLength(0);
  const all = space.nearests([0, 0, 9, 9], Number.POSITIVE_INFINITY);
  expect([...all.offsets]).toEqual([0, side * side, 2 * side * side]);
});

describe('what is refused', () => {
  const space = new BroadPhase();
  space.set(7, 0, 0, 10, 10).update();
  const out = space.queryBoxes([0, 0, 1, 1]);
  const memory = new ArrayBuffer(32);
  const shared = { distances: new Float64Array(memory), normals: new Int8Array(memory, 24) };
  const bad: [string, () => unknown, string][] = [
    [
      'a length',
      () => space.queryBoxes([1, 2, 3]),
      'queryBoxes: length: got 3, expected a multiple of 4: minX, minY, maxX, maxY',
    ],
    [
      'no array',
      () => space.queryPoints(7 as never),
      'queryPoints: got 7, expected a Float32Array, a Float64Array or an array of numbers',
    ],
    [
      'NaN',
      () => space.queryBoxes([0, 0, 1, 1, 0, Number.NaN, 1, 1], { out }),
      'queryBoxes: query 1: minY: got NaN, expected a number',
    ],
    [
      'a string',
      () => space.queryPoints([0, 0, 1, '2' as never]),
      'queryPoints: query 1: y: got "2", expected a number',
    ],
    [
      'a box inside out',
      () => space.queryBoxes([2, 0, 1, 1]),
      'queryBoxes: query 0: minX: got 2, expected no more than maxX, which is 1',
    ],
    [
      'an infinite point',
      () => space.nearests([0, Infinity], 1),
      'nearests: query 0: y: got Infinity, expected a finite number',
    ],
    [
      'a radius',
      () => space.queryCircles([0, 0, -1]),
      'queryCircles: query 0: radius: got -1, expected a number, at least 0',
    ],
    ['a centre', () => space.queryCircles([0, Number.NaN, 1]), 'queryCircles: query 0: y: got NaN, expected a number'],
    ['k', () => space.nearests([0, 0], 0), 'nearests: k: got 0, expected an integer from 1 on, or Infinity'],
    [
      'too few to ignore',
      () => space.rayCasts([0, 0, 1, 0], { ignoreEach: [] }),
      'rayCasts: ignoreEach: length: got 0, expected 1, one id for each query',
    ],
    [
      'a bad id',
      () => space.rayCasts([0, 0, 1, 0], { ignoreEach: [-1] }),
      'rayCasts: ignoreEach[0]: the id is -1, expected an integer from 0 to 16777215',
    ],
    [
      'another answer',
      () => space.rayCasts([0, 0, 1, 0], { out: out as never }),
      'rayCasts: out.distances: got undefined, expected a Float64Array',
    ],
    [
      'one array twice',
      () => space.queryBoxes([0, 0, 1, 1], { out: { ids: out.ids, offsets: out.ids } }),
      'queryBoxes: out.offsets: got [object Uint32Array], expected a Uint32Array with memory of its own',
    ],
    [
      'two parts of one memory that overlap',
      () => space.rayCasts([0, 0, 1, 0], { out: { ...out, ...shared } }),
      'rayCasts: out.normals: got [object Int8Array], expected an Int8Array with memory of its own',
    ],
    [
      'an array in the memory of the space',
      () => space.queryBoxes([0, 0, 1, 1], { out: { ...out, ids: space.pairs } }),
      'queryBoxes: out.ids: got [object Uint32Array], expected a Uint32Array with memory of its own',
    ],
    ['an option', () => space.sweeps([], { maxDistance: 1 } as never), 'sweeps: there is no option "maxDistance"'],
    [
      'a way',
      () => space.sweeps([0, 0, 1, 1, Infinity, 0]),
      'sweeps: query 0: dx: got Infinity, expected a finite number',
    ],
  ];
  test.each(bad)('%s', (_, call, message) => {
    expect(call).toThrow(message);
    expect(space.queryBoxes([0, 0, 1, 1])).toEqual(out);
  });
});
