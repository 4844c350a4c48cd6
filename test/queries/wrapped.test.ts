// Queries in worlds that wrap around. What is in a box is compared with whole numbers without a limit; the others with
// a look at copies of every box, moved by whole worlds. SEED=… runs a failure again, RUNS=… runs more.
import { BroadPhase } from 'broadphase';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { copyOf, type Loose } from '../support/asker.ts';
import { type Entry, Modelled } from '../support/model.ts';
import { distance, type Entries, meeting } from '../support/query-reference.ts';
import { runs, seed } from '../support/runs.ts';
import { aBox, aWorld } from '../support/wrapped-boxes.ts';
import { worldsOf, wrappedOverlap, wrappedWithin } from '../support/wrapped-reference.ts';

const ascending = (ids: Iterable<number>) => [...ids].sort((a, b) => a - b);

describe(`what is in a box, in a world that wraps around (SEED=${seed})`, () => {
  test.each([2, 3] as const)('in %iD', (dimensions) => {
    const scene = aWorld.chain((world) => {
      const wrap = world.slice(0, dimensions);
      const boxes = fc.array(aBox(wrap), { minLength: 1, maxLength: 40, size: 'max' });
      return fc.record({ wrap: fc.constant(wrap), boxes, asked: fc.array(aBox(wrap), { maxLength: 8, size: 'max' }) });
    });
    const property = fc.property(scene, ({ wrap, boxes, asked }) => {
      const space = new BroadPhase({ dimensions, wrap } as never).setAll(boxes.flat()).update();
      const ask = space as unknown as Loose;
      for (const box of [...asked, ...boxes.slice(0, 3)]) {
        const expected = [...boxes.keys()].filter((id) => wrappedOverlap(boxes[id], box, wrap));
        expect(ascending(ask.queryBox(...box) as number[])).toEqual(expected);
        const visited: number[] = [];
        ask.queryBox(...box, { visit: (id: number) => visited.push(id) });
        expect(ascending(visited)).toEqual(expected);
        const held = [...boxes.keys()].filter((id) => wrappedWithin(boxes[id], box, wrap));
        expect(ascending(ask.queryBox(...box, { within: true }) as number[])).toEqual(held);
        const point = box.slice(0, dimensions);
        if (!point.every(Number.isFinite)) continue;
        const there = [...boxes.keys()].filter((id) => wrappedOverlap(boxes[id], [...point, ...point], wrap));
        expect(ascending(ask.queryPoint(...point) as number[])).toEqual(there);
      }
    });
    fc.assert(property, { seed, numRuns: runs(60) });
  });
});

/** How far a box is away from the nearest of some copies. */
function apart(box: readonly number[], copies: readonly number[][]): number {
  const d = box.length / 2;
  const distances = copies.map((copy) => {
    const away = Array.from({ length: d }, (_, a) => Math.max(0, copy[a]! - box[a + d]!, box[a]! - copy[a + d]!));
    return Math.sqrt(away.reduce((sum, x) => sum + x * x, 0));
  });
  return Math.min(...distances);
}

interface Met {
  id: number;
  rank: number;
  corner: boolean;
  /** Of one copy; of several that are met at once each. */
  normals: number[][];
}

/** A space, its model, and what copies of its boxes answer. */
class Copied extends Modelled {
  readonly wrap: readonly number[];
  readonly #whole: boolean;
  /** Of the world along each axis, from 0 on: where boxes begin. */
  readonly #part: number;
  /** What the last update saw. */
  seen: Entries = new Map();

  constructor(wrap: readonly number[], seed: number, whole: boolean, part: number) {
    super({ dimensions: wrap.length, wrap } as never, seed);
    this.wrap = wrap;
    this.#whole = whole;
    this.#part = part;
  }

  update(): void {
    this.space.update();
    this.seen = copyOf(this.entries);
  }

  override box(): number[] {
    return this.asked(this.#part * this.pick(0, 0.05, 0.1, 0.1, 0.4, 0.9, 1.2), this.#part);
  }

  isFull(box: readonly number[], axis: number): boolean {
    return !(box[axis + this.wrap.length]! - box[axis]! < this.wrap[axis]!);
  }

  /** A query or a box that is as long as the world has no end. */
  around(box: readonly number[]): number[] {
    const d = this.wrap.length;
    return box.map((x, k) => (this.isFull(box, k % d) ? (k < d ? -Infinity : Infinity) : x));
  }

  /** The copies of a box near a place, up to `away` worlds away along each axis. */
  copies(given: readonly number[], place: readonly number[], away: readonly number[]): number[][] {
    const d = this.wrap.length;
    let copies = [this.around(given)];
    for (let a = 0; a < d; a++) {
      if (this.isFull(given, a) || !Number.isFinite(place[a])) continue;
      const size = this.wrap[a]!;
      const first = Math.round((place[a]! - given[a]!) / size);
      const steps = Array.from({ length: 2 * away[a]! + 1 }, (_, k) => first + k - away[a]!);
      copies = copies.flatMap((box) =>
        steps.map((step) => box.map((x, k) => (k % d === a ? given[k]! + step * size : x))),
      );
    }
    return copies;
  }

  wanted(ignored?: number): [number, Entry][] {
    return [...this.seen].filter(([id, { isOff }]) => !isOff && id !== ignored);
  }

  near(point: readonly number[]): { id: number; rank: number }[] {
    const away = point.map(() => 3);
    return this.wanted()
      .map(([id, entry]) => {
        const ranks = this.copies(entry.box, point, away).map((box) => distance(point, { ...entry, box }));
        return { id, rank: Math.min(...ranks) };
      })
      .sort((a, b) => a.rank - b.rank || a.id - b.id);
  }

  /** Up to four planes: some along an axis, some through places in whole steps. */
  planes(): number[][] {
    const size = this.wrap[0]!;
    const offset = () => (this.#whole ? this.integer(96) / 32 - 1 : 3 * this.random() - 1) * size;
    const normal = () => this.wrap.map(() => this.pick(0, 1, -1, this.random() - 0.5));
    return Array.from({ length: this.integer(5) }, () => [...normal(), offset()]);
  }

  /** The boxes of which a copy is behind no plane, and whether one is inside: those in the world and one world away. */
  inView(planes: readonly number[][], touching: boolean): Map<number, boolean> {
    const d = this.wrap.length;
    const isFront = (sum: number) => (touching ? sum >= 0 : sum > 0);
    /** Of the foremost corner of a box, or of its hindmost. */
    const sumOf = (box: readonly number[], plane: readonly number[], foremost: boolean) => {
      let sum = 0;
      for (let a = 0; a < d; a++) {
        if (plane[a] !== 0) sum += plane[a]! * box[plane[a]! > 0 === foremost ? a + d : a]!;
      }
      return sum + plane[d]!;
    };
    const seen = new Map<number, boolean>();
    for (const [id, { box }] of this.wanted()) {
      let copies = [this.around(box)];
      for (let a = 0; a < d; a++) {
        if (this.isFull(box, a)) continue;
        const size = this.wrap[a]!;
        const moves = [-1, 0, 1].map((step) => (step - worldsOf(box[a]!, size)) * size);
        copies = copies.flatMap((copy) => moves.map((move) => copy.map((x, k) => (k % d === a ? box[k]! + move : x))));
      }
      const all = (copy: readonly number[], foremost: boolean) =>
        planes.every((plane) => isFront(sumOf(copy, plane, foremost)));
      const inFront = copies.filter((copy) => all(copy, true));
      if (inFront.length > 0)
        seen.set(
          id,
          inFront.some((copy) => all(copy, false)),
        );
    }
    return seen;
  }

  view(): void {
    const ask = this.space as unknown as Loose;
    const planes = this.planes();
    for (const touching of [true, false]) {
      const seen = new Map<number, boolean>();
      const visit = (id: number, inside: boolean) => {
        expect(seen.has(id), `box ${id} again`).toBe(false);
        seen.set(id, inside);
      };
      ask.queryPlanes(planes.flat(), { touching, visit });
      const what = `queryPlanes(${JSON.stringify(planes)}) in ${this.wrap}, touching: ${touching}`;
      const ordered = (of: Map<number, boolean>) => [...of].sort(([a], [b]) => a - b);
      expect(ordered(seen), what).toEqual(ordered(this.inView(planes, touching)));
    }
  }

  ahead(given: readonly number[], along: readonly number[], limit: number, length?: number): Met[] {
    const d = this.wrap.length;
    const box = this.around(given);
    const way = along.map((x, a) => (this.isFull(given, a) ? 0 : x));
    const share = length === undefined ? 1 : length > 0 ? limit / length : 0;
    const away = way.map((x, a) => 3 + Math.ceil(Math.abs(x * share) / this.wrap[a]!));
    const all: Met[] = [];
    for (const [id, entry] of this.wanted()) {
      let best: Met | undefined;
      for (const copy of this.copies(entry.box, box.slice(0, d), away)) {
        const met = meeting(box, way, copy, length === undefined);
        if (!met) continue;
        const rank = met.time * (length ?? 1);
        if (rank > limit) continue;
        const order = best ? rank - best.rank || Number(met.corner) - Number(best.corner) : -1;
        if (order < 0) best = { id, rank, corner: met.corner, normals: [met.normal] };
        else if (order === 0) best!.normals.push(met.normal);
      }
      if (best) all.push(best);
    }
    return all.sort((a, b) => a.rank - b.rank || Number(a.corner) - Number(b.corner) || a.id - b.id);
  }

  pick<T>(...from: readonly T[]): T {
    return from[this.integer(from.length)]!;
  }

  /** Anywhere in this part of the world, at times some worlds away, often in whole steps. */
  point(part = 1): number[] {
    const steps = 32;
    return this.wrap.map((size) => {
      const at = this.#whole ? (this.integer(steps * part) * size) / steps : this.random() * size * part;
      return at + this.pick(0, 0, 0, 0, size, -size, -3 * size, 1000 * size);
    });
  }
  way(): number[] {
    const reach = this.pick(0.2, 1, 1, 2.6);
    return this.wrap.map((size) => this.pick(0, 1, -1, this.random() - 0.5, 2 * this.random() - 1) * reach * size);
  }
  asked(size = this.pick(0, 0.1, 0.4, 0.9, 1.2), part = 1): number[] {
    const point = this.point(part);
    const box = [...point, ...point.map((x, a) => x + size * (this.#whole ? 1 : this.random()) * this.wrap[a]!)];
    if (this.random() < 0.03) box[this.integer(box.length)] = Number.NaN;
    return box.map((x, k) => (Number.isNaN(x) ? (k < point.length ? -Infinity : Infinity) : x));
  }

  expectHits(
    found: { id: number; distance?: number; time?: number; normal: number[] }[],
    expected: readonly Met[],
  ): void {
    expect(found.map(({ id, distance, time }) => ({ id, rank: distance ?? time }))).toEqual(
      expected.map(({ id, rank }) => ({ id, rank })),
    );
    for (const [k, { normal }] of found.entries()) expect(expected[k]!.normals).toContainEqual(normal);
  }

  query(): void {
    const ask = this.space as unknown as Loose;
    const d = this.wrap.length;
    const point = this.point();
    const radius = this.random() * this.pick(0.1, 0.5, 1, 3) * Math.min(...this.wrap);
    const near = this.near(point);
    const round = d === 2 ? 'queryCircle' : 'querySphere';
    const inside = near.filter(({ rank }) => rank * rank <= radius * radius).map(({ id }) => id);
    expect(ascending(ask[round](...point, radius) as number[])).toEqual(ascending(inside));
    const k = this.pick(1, 3, 100, Infinity);
    const distances: number[] = [];
    expect(ask.nearest(...point, k, { distances })).toEqual(near.slice(0, k).map(({ id }) => id));
    expect(distances).toEqual(near.slice(0, k).map(({ rank }) => rank));

    const way = this.way();
    const most = Math.max(...way.map(Math.abs));
    const length = most && most * Math.sqrt(way.reduce((sum, x) => sum + (x / most) ** 2, 0));
    const maxDistance = this.pick(Infinity, length, length * 0.3, 0);
    const limit =
      maxDistance === Infinity && length > 0
        ? length * Math.min(...way.map((x, a) => this.wrap[a]! / Math.abs(x)))
        : maxDistance;
    const rays = this.ahead([...point, ...point], way, limit, length);
    const what = `rayCastAll(${[...point, ...way]}, ${maxDistance}) in ${this.wrap}`;
    const hits = ask.rayCastAll(...point, ...way, { maxDistance }) as never[];
    expect(hits.length, what).toBe(rays.length);
    this.expectHits(hits, rays);
    const first = ask.rayCast(...point, ...way, { maxDistance });
    this.expectHits(first ? [first as never] : [], rays.slice(0, 1));

    this.view();
    const box = this.asked();
    const sweeps = this.ahead(box, way, 1);
    const met = ask.sweep(...box, ...way);
    this.expectHits(met ? [met as never] : [], sweeps.slice(0, 1));
    const visited: never[] = [];
    ask.sweep(...box, ...way, {
      visit: (_: number, __: number, hit: object) =>
        visited.push({ ...hit, normal: [...(hit as { normal: number[] }).normal] } as never),
    });
    this.expectHits(visited, sweeps);
  }

  /** Many in one call answer as one by one. */
  many(): void {
    const ask = this.space as unknown as Loose;
    type Many = { ids: Uint32Array; offsets: Uint32Array; distances: Float64Array };
    const of = ({ ids, offsets }: Many, k: number) => [...ids.subarray(offsets[k], offsets[k + 1])];
    const boxes = [this.asked(), this.asked(), this.asked()];
    const points = boxes.map(() => this.point());
    const ways = boxes.map(() => this.way());
    const inBoxes = ask.queryBoxes(boxes.flat()) as Many;
    const near = ask.nearests(points.flat(), 3) as Many;
    const rays = ask.rayCasts(points.flatMap((point, k) => [...point, ...ways[k]!])) as Many;
    const sweeps = ask.sweeps(boxes.flatMap((box, k) => [...box, ...ways[k]!])) as Many;
    boxes.forEach((box, k) => {
      expect(of(inBoxes, k)).toEqual(ask.queryBox(...box));
      expect(of(near, k)).toEqual(ask.nearest(...points[k]!, 3));
      const ray = ask.rayCast(...points[k]!, ...ways[k]!) as { id: number } | undefined;
      expect(of(rays, k)).toEqual(ray ? [ray.id] : []);
      const met = ask.sweep(...box, ...ways[k]!) as { id: number } | undefined;
      expect(of(sweeps, k)).toEqual(met ? [met.id] : []);
    });
    const all = ask.nearestsOfAll(1) as Many & { of: Uint32Array };
    for (const [id, { box }] of this.wanted()) {
      const [other] = of(all, all.of.indexOf(id));
      const expected = this.wanted(id).map(([, entry]) =>
        apart(
          this.around(box),
          this.copies(
            entry.box,
            box,
            box.map(() => 3),
          ),
        ),
      );
      if (expected.length === 0) expect(other).toBeUndefined();
      else expect(all.distances[all.offsets[all.of.indexOf(id)]!]).toBe(Math.min(...expected));
    }
  }
}

const worlds = [
  [60, 45, 50],
  [0.1, 0.3, 0.7],
  [16, 8, 32],
];
const cases = worlds.flatMap((world) =>
  [2, 3].flatMap((d) =>
    ([true, false] as const).flatMap((whole) => [1, 0.25].map((part) => [world.slice(0, d), whole, part] as const)),
  ),
);

describe(`what is near and ahead, in a world that wraps around (SEED=${seed})`, () => {
  test.each(cases)('of %j, in whole steps: %s, boxes in %d of it', { tags: 'long' }, (wrap, whole, part) => {
    const scene = new Copied(wrap, seed, whole, part);
    for (let round = 0; round < runs(12); round++) {
      for (let n = scene.pick(3, 40); n > 0; n--) scene.step();
      scene.update();
      for (let n = 0; n < 12; n++) scene.query();
      scene.many();
      for (let n = 0; n < 3; n++) scene.step();
      for (let n = 0; n < 3; n++) scene.query();
    }
  });
});

test.each([2, 3] as const)('the outermost boxes of a world that is mostly empty are found, in %iD', (dimensions) => {
  const wrap = [64, 32, 128].slice(0, dimensions);
  const aSpan = fc.tuple(
    ...wrap.map((size) => fc.tuple(fc.nat(size), fc.nat(size / 8), fc.integer({ min: -2, max: 2 }))),
  );
  const property = fc.property(fc.array(aSpan, { minLength: 1, maxLength: 12 }), (spans) => {
    const boxes = spans.map((axes) => [...axes.map(([at]) => at), ...axes.map(([at, long]) => at + long)]);
    const space = new BroadPhase({ dimensions, wrap } as never).setAll(boxes.flat()).update();
    const ask = space as unknown as Loose;
    for (const [id, box] of boxes.entries()) {
      for (const corner of [0, 1]) {
        const worlds = spans[id]!.map(([, , away], a) => away * wrap[a]!);
        const at = worlds.map((away, a) => away + box[a + corner * dimensions]!);
        const aside = (far: number) => [at[0]! + (corner ? far : -far), ...at.slice(1)];
        const back = wrap.map((_, a) => (a > 0 ? 0 : corner ? -3 : 3));
        const ids = (answer: unknown) => (answer as { id: number }[]).map((hit) => hit.id);
        expect(ask.queryPoint(...at)).toContain(id);
        expect(ask.queryBox(...at, ...at)).toContain(id);
        expect(ask[dimensions === 2 ? 'queryCircle' : 'querySphere'](...aside(3), 3)).toContain(id);
        expect(ids(ask.rayCastAll(...at, ...back.map((x) => -x)))).toContain(id);
        expect(ids(ask.rayCastAll(...aside(3), ...back, { maxDistance: 3 }))).toContain(id);
        const met: number[] = [];
        ask.sweep(...aside(3), ...aside(3), ...back, { visit: (other: number) => met.push(other) });
        expect(met).toContain(id);
      }
    }
  });
  fc.assert(property, { seed, numRuns: runs(60) });
});

test.each([2, 3] as const)('a view of many boxes comes in parts, each box once, in %iD', (dimensions) => {
  const wrap = Array.from({ length: dimensions }, () => 100);
  const count = 5000;
  const space = new BroadPhase({ dimensions, wrap } as never);
  const box = (k: number) => {
    const at = wrap.map((size, a) => (k * (7 + 4 * a)) % size);
    return [...at, ...at.map((x) => x + 3)];
  };
  space.setAll(Float32Array.from(Array.from({ length: count }, (_, k) => box(k)).flat())).update();
  const all = Array.from({ length: count }, (_, id) => id);
  for (const planes of [[], [...wrap.map(() => 1), 300]]) {
    expect(ascending(space.queryPlanes(planes))).toEqual(all);
    const visited: number[] = [];
    space.queryPlanes(planes, { visit: (id) => visited.push(id) });
    expect(ascending(visited)).toEqual(all);
  }
});

test.each([2, 3] as const)('a ray or a sweep from however far away ends, in %iD', (dimensions) => {
  const wrap = Array.from({ length: dimensions }, () => 100);
  const ask = new BroadPhase({ dimensions, wrap } as never)
    .setAll(Array(2 * dimensions).fill(5))
    .update() as never as Loose;
  for (const far of [1e15, 1e25, 1e300, -1e300]) {
    const at = wrap.map(() => far);
    const along = wrap.map(() => 50);
    // So far away, numbers are too coarse to say what is met.
    for (const hit of ask.rayCastAll(...at, ...along) as { id: number }[]) expect(hit.id).toBe(0);
    ask.sweep(...at, ...at, ...along, { visit: (id: number) => expect(id).toBe(0) });
  }
});
