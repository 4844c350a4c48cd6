// Hundreds of rays and moving boxes in one call go down the index in batches: each finds exactly what it finds alone,
// however they are mixed, in worlds that are dense here and empty there.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';

type Call = (...given: unknown[]) => never;
type Hit = { id: number; distance?: number; time?: number; normal: number[] };

const seed = Number(process.env.SEED ?? Math.floor(Math.random() * 2 ** 31));

class World {
  readonly space: BroadPhase<2 | 3>;
  readonly random: () => number;
  readonly #d: number;
  readonly #single: boolean;

  constructor(dimensions: 2 | 3, single: boolean) {
    this.space = new BroadPhase<2 | 3>({ dimensions } as never);
    this.random = createRandom(seed);
    this.#d = dimensions;
    this.#single = single;
    for (let id = 0; id < 3000; id++) this.#set(id);
    for (let id = 0; id < 3000; id += 37) this.space.delete(id);
    this.space.update();
  }

  below(n: number): number {
    return Math.floor(this.random() * n);
  }
  #round(x: number): number {
    return this.#single ? Math.fround(x) : x;
  }

  /** In a third of all cases on a lattice, where sides touch and hits have the same rank. */
  point(): number[] {
    const kind = this.below(3);
    return Array.from({ length: this.#d }, () =>
      this.#round(kind === 0 ? this.below(40) : kind === 1 ? 40 * this.random() : 3000 * this.random()),
    );
  }

  #set(id: number): void {
    const from = this.point();
    const size = this.random() < 0.02 ? 2000 : this.random() < 0.2 ? 0 : 1 + this.below(2);
    const to = from.map((x) => this.#round(x + size));
    const axis = this.below(100);
    if (axis < this.#d) to[axis] = Infinity;
    if (id % 500 === 3) from[0] = -1e35;
    (this.space.set as Call)(id, ...from, ...to);
    if (id % 3 === 0) this.space.setFilter(id, 2, 0xffffffff);
  }

  /** A direction or a path: along an axis, none at all, or too large for float32. */
  way(): number[] {
    const kind = this.below(20);
    const length = [1, 30, 4000][this.below(3)]! * (kind === 0 ? 1e32 : kind === 1 ? 1e-35 : 1);
    const axis = kind < 8 ? this.below(this.#d) : -1;
    return Array.from({ length: this.#d }, (_, a) =>
      kind === 2 || (axis >= 0 && axis !== a) ? [0, -0][this.below(2)]! : length * (this.random() - 0.5),
    );
  }
}

const cases = [2, 3].flatMap((d) => [true, false].map((single) => [d, single] as [2 | 3, boolean]));

describe.each(cases)(`in %iD, of float32 (%s), seed ${seed}`, (dimensions, single) => {
  const world = new World(dimensions, single);
  const space = world.space as unknown as Record<string, Call>;
  const count = 1500;
  const ignoreEach = Uint32Array.from({ length: count }, () => world.below(3000));

  /** Compares a call with single ones. */
  function compare(name: 'rayCast' | 'sweep', queries: number[][], options: object): void {
    const many = space[`${name}s`]!(queries.flat() as never, { ...options, ignoreEach } as never) as {
      ids: Uint32Array;
      offsets: Uint32Array;
      distances?: Float64Array;
      times?: Float64Array;
      normals: Int8Array;
    };
    let hits = 0;
    queries.forEach((query, k) => {
      const hit = space[name]!(...(query as never[]), { ...options, ignore: ignoreEach[k] } as never) as
        | Hit
        | undefined;
      const at = many.offsets[k]!;
      expect(many.offsets[k + 1]! - at, `query ${k}: ${query}`).toBe(hit ? 1 : 0);
      if (!hit) return;
      hits++;
      expect(many.ids[at], `query ${k}: ${query}`).toBe(hit.id);
      expect((many.distances ?? many.times)![at], `query ${k}: ${query}`).toBe(hit.distance ?? hit.time);
      expect([...many.normals.subarray(at * dimensions, (at + 1) * dimensions)]).toEqual(hit.normal.map((x) => x + 0));
    });
    expect(hits).toBeGreaterThan(count / 50);
  }

  test.each([{}, { mask: 2 }, { maxDistance: 3 }, { maxDistance: 500 }])('rays, %j', (options) => {
    compare(
      'rayCast',
      Array.from({ length: count }, () => [...world.point(), ...world.way()]),
      options,
    );
  });

  test.each([{}, { mask: 2 }])('moving boxes, %j', (options) => {
    const box = () => {
      const from = world.point();
      return [...from, ...from.map((x) => x + world.below(3))];
    };
    compare(
      'sweep',
      Array.from({ length: count }, () => [...box(), ...world.way()]),
      options,
    );
  });
});
