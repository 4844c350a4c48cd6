// Makes every query at random places, and compares the answers with a loop over all boxes.
import type { BroadPhase, RayHit } from 'broadphase';
import { expect } from 'vitest';
import { type Asked, ahead, type Entries, inBox, inCircle, inPlanes, near, type Ranked } from './query-reference.ts';

export type Loose = Record<string, (...given: unknown[]) => unknown>;

export const ascending = (ids: readonly number[]) => ids.toSorted((a, b) => a - b);

/** A hit as a ray cast or a sweep reports it. */
const hitOf = (name: string, { id, rank, normal }: Ranked) =>
  name === 'sweep' ? { id, time: rank, normal } : { id, distance: rank, normal };

/** Makes all kinds of queries to a space, at random places, and compares. */
export class Asker {
  readonly #space: BroadPhase<2 | 3>;
  readonly #ask: Loose;
  readonly #random: () => number;
  readonly #world: number;

  constructor(space: BroadPhase<2 | 3>, random: () => number, world: number) {
    this.#space = space;
    this.#ask = space as unknown as Loose;
    this.#random = random;
    this.#world = world;
  }

  #pick<T>(...from: readonly T[]): T {
    return from[Math.floor(this.#random() * from.length)];
  }

  /** Mostly whole numbers, some far outside, a few too large for float32. */
  #place(): number {
    const at = this.#random() * this.#world;
    if (this.#random() < 0.02) return this.#pick(1e-40, 1e35, 1e300) * (at - this.#world / 2);
    return this.#pick(Math.floor(at), Math.floor(at), at, at, Math.floor(at) + 0.1, 1e9 * (at - this.#world / 2));
  }

  #point(): number[] {
    return Array.from({ length: this.#space.dimensions }, () => this.#place());
  }

  #box(): number[] {
    const from = this.#point();
    const size = this.#pick(0, 1, this.#world / 8, this.#world * 4);
    const box = [...from, ...from.map((x) => x + Math.floor(size * this.#random()))];
    if (this.#random() < 0.1) box[this.#pick(...from.keys())] = -Infinity;
    if (this.#random() < 0.1) box[from.length + this.#pick(...from.keys())] = Infinity;
    return box;
  }

  /** Mostly whole numbers, often along an axis, sometimes 0. */
  #way(): number[] {
    let reach = this.#pick(1, this.#world, this.#world * 10, 0.3);
    if (this.#random() < 0.1) reach = this.#pick(1e-45, 1e-35, 1e25, 1e35);
    return this.#point().map(() => this.#pick(0, 0, 1, -1, this.#random() - 0.5) * reach);
  }

  #options(): Asked {
    return {
      ...(this.#random() < 0.3 && { mask: this.#pick(1, 2, 6, 0xffffffff, 0, 0x80000000) }),
      ...(this.#random() < 0.3 && { ignore: this.#ignored() }),
    };
  }

  #ignored(): number | number[] {
    const any = () => Math.floor(this.#random() * 80);
    return this.#random() < 0.5 ? any() : Array.from({ length: this.#pick(0, 1, 2, 12) }, any);
  }

  #ids(name: string, given: readonly number[], options: Asked, expected: readonly number[]): void {
    const found = this.#ask[name](...given, options) as number[];
    expect(ascending(found), `${name}(${given.join(', ')}, ${JSON.stringify(options)})`).toEqual(expected);
    const out = [1, 2, 3];
    expect(this.#ask[name](...given, { ...options, out })).toBe(out);
    expect(ascending(out)).toEqual(expected);
    const visited: number[] = [];
    const stop = this.#pick(1, 70, Infinity);
    const visit = (id: number) => visited.push(id) < stop;
    expect(this.#ask[name](...given, { ...options, visit })).toEqual([]);
    expect(visited).toHaveLength(Math.min(stop, found.length));
    const once = new Set(visited);
    expect(expected.filter((id) => once.has(id))).toEqual(ascending(visited));
  }

  #visits(name: string, given: readonly number[], options: Asked, expected: readonly Ranked[]): void {
    const visited: { id: number; rank: number }[] = [];
    const stop = this.#pick(1, 70, Infinity);
    const visit = (id: number, rank: number, hit?: object) => {
      if (name === 'nearest') expect(hit).toBeUndefined();
      else expect(hit).toEqual(hitOf(name, expected[visited.length]!));
      return visited.push({ id, rank }) < stop;
    };
    this.#ask[name](...given, { ...options, visit });
    expect(visited).toEqual(expected.slice(0, stop).map(({ id, rank }) => ({ id, rank })));
  }

  /** Checks `accept`: if it refuses some hits, the answer is the next one. */
  #accepts(name: string, given: readonly number[], options: Asked, expected: readonly Ranked[]): void {
    const rest = this.#pick(0, 1, 3, 20, 100);
    const asked: number[] = [];
    const accept = (id: number, hit: object) => {
      expect(hit).toEqual(hitOf(name, expected[asked.length]!));
      return asked.push(id) > rest;
    };
    const first = expected[rest] && hitOf(name, expected[rest]!);
    expect(this.#ask[name](...given, { ...options, accept })).toEqual(first);
    expect(asked).toEqual(expected.slice(0, rest + 1).map(({ id }) => id));
    const out = { id: 0, [name === 'sweep' ? 'time' : 'distance']: 0, normal: [] };
    expect(this.#ask[name](...given, { ...options, accept: () => true, out })).toBe(
      expected.length > 0 ? out : undefined,
    );
    if (expected.length > 0) expect(out).toEqual(hitOf(name, expected[0]!));
  }

  everything(entries: Entries): void {
    const { dimensions } = this.#space;
    const box = this.#box();
    let options: Asked = { ...this.#options(), ...(this.#random() < 0.5 && { within: this.#random() < 0.7 }) };
    this.#ids('queryBox', box, options, inBox(entries, box, options));
    const point = this.#point();
    options = this.#options();
    this.#ids('queryPoint', point, options, inBox(entries, [...point, ...point], options));
    const radius = this.#pick(0, 1, 5, this.#world / 4, this.#world * 3, 1e9, Infinity);
    options = this.#options();
    const round = dimensions === 2 ? 'queryCircle' : 'querySphere';
    this.#ids(round, [...point, radius], options, inCircle(entries, point, radius, options));
    this.planes(entries);
    this.nearest(entries);
    this.ray(entries);
    this.sweep(entries);
  }

  /** Some along an axis, some through whole numbers, so that boxes touch them; a pair often bounds a slab. */
  #planes(): number[][] {
    const planes: number[][] = [];
    const count = this.#pick(0, 1, 2, 6, 8, 8);
    while (planes.length < count) {
      const normal = this.#way();
      const [place] = [this.#point()];
      planes.push([...normal, -normal.reduce((sum, n, axis) => sum + n * place[axis], 0)].map((x) => x + 0));
      const width = this.#world * this.#pick(0, 0.2, 1);
      if (planes.length < count && this.#random() < 0.5)
        planes.push(planes.at(-1)!.map((x, k) => (k < normal.length ? -x : -x + width)));
    }
    return planes;
  }

  planes(entries: Entries): void {
    const given = this.#planes().flat();
    const flat = this.#pick<Float32Array | Float64Array | number[]>(
      Float32Array.from(given),
      Float64Array.from(given),
      given,
    );
    const width = this.#space.dimensions + 1;
    const planes = Array.from({ length: flat.length / width }, (_, k) => [...flat.slice(k * width, (k + 1) * width)]);
    if (!planes.flat().every(Number.isFinite)) return; // beyond float32
    const options = this.#options();
    const expected = inPlanes(entries, planes, options);
    const ids = expected.map(({ id }) => id);
    const found = this.#ask.queryPlanes(flat, options) as number[];
    expect(ascending(found), `queryPlanes([${flat.join(', ')}], ${JSON.stringify(options)})`).toEqual(ids);
    const out = [1, 2, 3];
    expect(this.#ask.queryPlanes(flat, { ...options, out })).toBe(out);
    expect(out).toEqual(found);
    const visited: { id: number; inside: boolean }[] = [];
    const stop = this.#pick(1, 70, Infinity);
    const visit = (id: number, inside: boolean) => visited.push({ id, inside }) < stop;
    expect(this.#ask.queryPlanes(flat, { ...options, visit })).toEqual([]);
    expect(visited.map(({ id }) => id)).toEqual(found.slice(0, stop));
    for (const each of visited) expect(each).toEqual(expected.find(({ id }) => id === each.id));
  }

  nearest(entries: Entries): void {
    const point = this.#point();
    const k = this.#pick(1, 3, 10, 100, 1e6, Number.MAX_VALUE, Infinity);
    const options = { ...this.#options(), ...(this.#random() < 0.3 && { maxDistance: this.#pick(0, 5, 20) }) };
    const expected = near(entries, point, k, options);
    const ids = expected.map(({ id }) => id);
    expect(this.#ask.nearest(...point, k, options), `nearest(${point.join(', ')}, ${k})`).toEqual(ids);
    const out = [1, 2, 3];
    expect(this.#ask.nearest(...point, k, { ...options, out })).toBe(out);
    expect(out).toEqual(ids);
    const distances = [1, 2, 3];
    this.#ask.nearest(...point, k, { ...options, distances });
    expect(distances).toEqual(expected.map(({ rank }) => rank));
    this.#visits('nearest', [...point, k], options, expected);
  }

  ray(entries: Entries): void {
    const point = this.#point();
    const way = this.#way();
    const most = Math.max(...way.map(Math.abs));
    const length = most && most * Math.sqrt(way.reduce((sum, x) => sum + (x / most) ** 2, 0));
    const reach = this.#pick(Infinity, Infinity, 5, this.#world / 2, 0);
    const options = { ...this.#options(), ...(reach < Infinity && { maxDistance: reach }) };
    const expected = ahead(entries, [...point, ...point], way, reach, options, length);
    const hits = expected.map(({ id, rank, normal }) => ({ id, distance: rank, normal }));
    const given = [...point, ...way];
    expect(this.#ask.rayCastAll(...given, options), `rayCastAll(${given.join(', ')})`).toEqual(hits);
    const out: RayHit[] = [{ id: 0, distance: 0, normal: [] }];
    const [kept] = out;
    expect(this.#ask.rayCastAll(...given, { ...options, out })).toBe(out);
    expect(out).toEqual(hits);
    if (hits.length > 0) expect(out[0]).toBe(kept);
    expect(this.#ask.rayCast(...given, options)).toEqual(hits[0]);
    expect(this.#ask.rayCast(...given, { ...options, out: kept })).toBe(hits.length > 0 ? kept : undefined);
    this.#visits('rayCastAll', given, options, expected);
    this.#accepts('rayCast', given, options, expected);
  }

  sweep(entries: Entries): void {
    const given = [...this.#box(), ...this.#way()];
    const options = this.#options();
    const { dimensions } = this.#space;
    const expected = ahead(entries, given.slice(0, 2 * dimensions), given.slice(2 * dimensions), 1, options);
    const [first] = expected;
    const hit = first && { id: first.id, time: first.rank, normal: first.normal };
    expect(this.#ask.sweep(...given, options), `sweep(${given.join(', ')})`).toEqual(hit);
    const out = { id: 0, time: 0, normal: [] };
    expect(this.#ask.sweep(...given, { ...options, out })).toBe(hit && out);
    if (hit) expect(out).toEqual(hit);
    this.#visits('sweep', given, options, expected);
    this.#accepts('sweep', given, options, expected);
  }
}

export const copyOf = (entries: Entries): Entries => new Map([...entries].map(([id, entry]) => [id, { ...entry }]));
