// The class BroadPhase: a Map from id to box that knows which of its boxes overlap.
// Each method passes its arguments to the function of its topic. Its documentation is in api/, except where an editor
// would not find it there. Only `set` and its variants, which are called once for each box, are implemented here.
// biome-ignore-all lint/complexity/noArguments: a rest parameter would be an array per call
import type { Api } from './api/index.ts';
import { type Boxes, expose, hasBox, present, readBox, setAll } from './boxes.ts';
import { askMany, nothing } from './bulk-queries.ts';
import type {
  BoxOfId,
  BoxQuery,
  CentredBoxOfId,
  Dimensions,
  MovingBoxOfId,
  NearestQuery,
  Numbers,
  PointQuery,
  RayQuery,
  RoundQuery,
  SweepQuery,
} from './dimensions.ts';
import { areNumbers, badCentred, badSet, badSwept, badValue, checkId, isId, isSize } from './errors.ts';
import type { Technique as LeanTechnique } from './generated/kernel-lean.ts';
import type { KernelInstance } from './kernel/instance.ts';
import { type BroadPhaseOptions, type ConstructorOptions, open } from './options.ts';
import { began, eachPair, ended, eventsIn, pairCount, pairsIn, update } from './pairs.ts';
import { pairsWith } from './pairs-between.ts';
import * as places from './place-queries.ts';
import { queryPlanes } from './plane-queries.ts';
import * as ahead from './queries.ts';
import type {
  BoxOptions,
  IdsOptions,
  ManyAreaOptions,
  ManyBoxOptions,
  ManyFarOptions,
  ManyIds,
  ManyNearest,
  ManyNearestOfAll,
  ManyOptions,
  ManyRayHits,
  ManySweepHits,
  NearestOptions,
  PlanesOptions,
  RayAllOptions,
  RayHit,
  RayOptions,
  SweepHit,
  SweepOptions,
} from './query-options.ts';
import * as rules from './rules.ts';
import { restore, snapshot } from './snapshot.ts';
import { type Stats, statsOf } from './stats.ts';
import { builtNames, checkTechnique, type TechniqueName, techniques } from './techniques.ts';
import { structure, validate } from './validate.ts';
import { show, type Watcher, type World } from './watch.ts';

/**
 * The key of a space's instance, which has all that a space keeps. Private names would be slow where tools for older
 * engines make them weak maps, and the types of Vue and Immer, which list the members of what they hold, leave them out.
 * The property is not enumerable; Jest would compare that of a symbol nevertheless, and take no two spaces for equal.
 */
const inner = '#inner';

/** The instance, for a call: it is refused if it has too many arguments, undefined ones too, as `set` is. */
function given({ [inner]: instance }: { [inner]: KernelInstance }, where: string, got: number, most: number) {
  if (got <= most) return instance;
  throw new TypeError(`${where}: got ${got} arguments, expected at most ${most} in ${instance.dimensions}D`);
}

/**
 * For Node's console: becomes a method with the first space. If the class had a method with a computed name, bundlers
 * would keep the class where only `findPairs` is used.
 */
function inspected(this: BroadPhase, _depth: number, options: unknown, inspect: (...given: unknown[]) => string) {
  return `BroadPhase ${inspect(this.toJSON(), options)}`;
}

/**
 * Finds every overlapping pair among boxes that move. Reads like a Map from id to box.
 *
 * Boxes are closed: touching boxes overlap, unless `touching` is false. A box may have zero size, as a point has, and
 * infinite sides, as a half-plane has. Every technique finds exactly the pairs of the numbers given, doubles included.
 *
 * Rays and sweeps hit a box if their path leads into one of its faces; a path along a face or away from it is no hit.
 *
 * Queries (`queryBox` to `nearest`, `isColliding`, `collisionsOf`) see the boxes of the last update: changes since then
 * have no effect until the next, and before the first update there are no boxes. A large space that was never queried
 * keeps no copy of its boxes (above 16,384, or 4,096 written in place): its first query must come right after an
 * update, or it throws. Everything is decided in double precision. Options are read at each call; to make no garbage,
 * reuse the options object with an `out` in it, with roughly constant numbers of answers. All queries throw RangeError
 * for NaN, a minimum above its maximum, infinite points, motions and directions, negative distances, and masks and ids
 * out of range; TypeError for values other than numbers and for a wrong number of arguments, undefined ones included.
 * Any call throws RangeError if memory runs out.
 *
 * @example
 * const space = new BroadPhase();
 * space.set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
 * space.pairs; // → Uint32Array [7, 9]
 */
export class BroadPhase<D extends Dimensions = 2> implements Api<D> {
  /**
   * The names of the available techniques, in order: with `import 'broadphase'` the few that games need; with `import
   * 'broadphase/all'`, or after `init` with `broadphase/kernel.wasm`, all of them.
   *
   * @example
   * BroadPhase.techniques.includes('auto'); // → true
   */
  static get techniques(): readonly LeanTechnique[] {
    return builtNames() as LeanTechnique[];
  }

  /** How many axes the boxes have: an option of the constructor. */
  readonly dimensions: D;
  /** @internal */
  declare readonly [inner]: KernelInstance;
  /** @internal Its ring. By a key in a variable, `set` would be too long for V8 to inline it three times. */
  declare readonly '#ring': KernelInstance['ring'];

  /**
   * An empty space, ready at once: there is nothing to await.
   *
   * @throws RangeError or TypeError that names the option; RangeError if a page holds too many spaces, about 100
   * @throws Error if WebAssembly with SIMD is missing or forbidden
   *
   * @example
   * new BroadPhase({ dimensions: 3, events: true }).dimensions; // → 3
   * new BroadPhase({ capacity: -1 }); // throws RangeError: capacity: got -1, expected an integer from 0 to 16777216
   */
  constructor(...options: ConstructorOptions<D>);
  constructor(options?: BroadPhaseOptions<D>) {
    const instance = open(options);
    Object.defineProperties(this, { [inner]: { value: instance }, '#ring': { value: instance.ring } });
    const printed = Symbol.for('nodejs.util.inspect.custom');
    if (!(printed in this)) Reflect.defineProperty(BroadPhase.prototype, printed, { value: inspected });
    this.dimensions = instance.dimensions as D;
    given(this, 'new BroadPhase', arguments.length, 1);
  }

  /** Frameworks that wrap objects in proxies, such as Vue, leave objects alone whose name here is not `Object`. */
  get [Symbol.toStringTag](): string {
    return 'BroadPhase';
  }

  get size(): number {
    return this[inner].size;
  }

  set(...box: BoxOfId<D>): this;
  set(id: number, a: number, b: number, c: number, d: number, e?: number, f?: number): this {
    // Short enough for V8 to inline three times into one function; otherwise each call would allocate its doubles on the
    // heap: docs/decisions/0003-ring.md. `arguments` may be passed on by `apply` alone, or each call would allocate it; and
    // Firefox does so unless its length is read by these very words.
    const ring = this['#ring'];
    const length = arguments.length;
    if (
      length !== ring.step ||
      typeof id !== 'number' ||
      typeof a !== 'number' ||
      typeof b !== 'number' ||
      typeof c !== 'number' ||
      typeof d !== 'number' ||
      id >>> 0 !== id || // `settle` looks whether it is too large
      !(length === 5 ? a <= c && b <= d : typeof e === 'number' && typeof f === 'number' && a <= d && b <= e && c <= f)
    ) {
      badSet.apply(this, arguments as unknown as unknown[]);
    }
    const { numbers } = ring;
    const next = (ring.next << 12) >>> 12; // no other number, but engines know that its sums cannot overflow
    numbers[next] = id;
    numbers[next + 1] = a;
    numbers[next + 2] = b;
    numbers[next + 3] = c;
    numbers[next + 4] = d;
    if (e !== undefined) {
      numbers[next + 5] = e;
      numbers[next + 6] = f!;
    }
    if (id >= ring.limit || next >= ring.last) ring.settle(id);
    else ring.next = next + length;
    return this;
  }

  setSwept(...box: MovingBoxOfId<D>): this;
  setSwept(
    id: number,
    a: number,
    b: number,
    c: number,
    d: number,
    e: number,
    f: number,
    g?: number,
    h?: number,
    i?: number,
  ): this {
    const flat = this.dimensions === 2;
    if (
      arguments.length !== (flat ? 7 : 10) ||
      !isId(id) ||
      !(areNumbers(a, b, c, d, e, f) && (flat || areNumbers(g, h, i))) ||
      !(flat ? a <= c && b <= d : a <= d && b <= e && c <= f) ||
      (flat ? e - e + (f - f) : g! - g! + (h! - h!) + (i! - i!)) !== 0 // x - x is NaN if x is infinite
    ) {
      badSwept.apply(this, arguments as unknown as unknown[]);
    }
    const ring = this['#ring'];
    const { way } = ring;
    way[0] = flat ? e : g!;
    way[1] = flat ? f : h!;
    way[2] = flat ? 0 : i!;
    ring.put(id, a, b, c, d, e, f, true);
    return this;
  }

  setCentred(...box: CentredBoxOfId<D>): this;
  setCentred(id: number, a: number, b: number, c: number, d: number, e?: number, f?: number): this {
    const ring = this['#ring'];
    const flat = ring.step === 5;
    if (
      arguments.length !== ring.step ||
      !isId(id) ||
      !(Number.isFinite(a) && Number.isFinite(b) && (flat || Number.isFinite(c))) ||
      !(flat ? isSize(c) && isSize(d) : isSize(d) && isSize(e) && isSize(f))
    ) {
      badCentred.apply(this, arguments as unknown as unknown[]);
    }
    if (flat) ring.put(id, a - c, b - d, a + c, b + d);
    else ring.put(id, a - d, b - e!, c - f!, a + d, b + e!, c + f!);
    return this;
  }

  setAll(boxes: Boxes, count?: number): this {
    setAll(given(this, 'setAll', arguments.length, 2), boxes, count);
    return this;
  }
  boxes(count: number): Float32Array {
    return expose(given(this, 'boxes', arguments.length, 1), count);
  }

  delete(id: number): boolean {
    checkId('delete', id);
    return this[inner].remove(id);
  }
  clear(): void {
    this[inner].clear();
  }
  has(id: number): boolean {
    checkId('has', id);
    return hasBox(this[inner], id);
  }

  /**
   * The numbers that box `id` was given, or `undefined` if there is no such box.
   * @param id an integer from 0 to 2^24 - 1
   * @throws RangeError or TypeError for a bad id
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 0, 0, 10, 10).get(7); // → Float64Array [0, 0, 10, 10]
   */
  get(id: number): Float64Array | undefined;
  /**
   * The same without garbage.
   * @param id an integer from 0 to 2^24 - 1
   * @param out filled with 4 numbers (3D: 6) and returned
   * @throws TypeError if it is not an array, or a typed array that is too short
   *
   * @example
   * const space = new BroadPhase();
   * const box = [0, 0, 0, 0];
   * space.set(7, 0, 0, 10, 10).get(7, box); // → [0, 0, 10, 10]
   */
  get<Out extends Float32Array | Float64Array | number[]>(id: number, out: Out): Out | undefined;
  get(id: number, out: Float32Array | Float64Array | number[] = new Float64Array(2 * this.dimensions)) {
    checkId('get', id);
    return readBox(this[inner], id, out) ? out : undefined;
  }
  keys(): IterableIterator<number> {
    return present(this[inner]);
  }

  /**
   * Each box, `[id, numbers]`, in the order of `keys`: `for (const [id, box] of space)`. Makes garbage for each; `get` with
   * an `out` makes none.
   *
   * @example
   * const space = new BroadPhase().set(9, 0, 0, 1, 2).set(7, 0, 0, 3, 3);
   * const large: number[] = [];
   * for (const [id, [minX, , maxX]] of space) if (maxX - minX > 2) large.push(id);
   * large; // → [7]
   */
  *[Symbol.iterator](): IterableIterator<[id: number, box: Float64Array]> {
    for (const id of this.keys()) yield [id, this.get(id)!];
  }

  setFilter(id: number, layer: number, mask: number): this {
    rules.setFilter(given(this, 'setFilter', arguments.length, 3), id, layer, mask);
    return this;
  }
  filterOf(id: number): rules.Filter | undefined {
    return rules.filterOf(this[inner], id);
  }
  setStatic(id: number, ...given: [] | [isStatic: boolean]): this;
  setStatic(id: number, isStatic?: boolean): this {
    rules.setStatic(given(this, 'setStatic', arguments.length, 2), id, arguments.length < 2 || isStatic!);
    return this;
  }
  isStatic(id: number): boolean {
    return rules.isStatic(this[inner], id);
  }
  setEnabled(id: number, enabled: boolean): this {
    rules.setEnabled(given(this, 'setEnabled', arguments.length, 2), id, enabled);
    return this;
  }
  isEnabled(id: number): boolean {
    return rules.isEnabled(this[inner], id);
  }
  setGroup(id: number, group: number): this {
    rules.setGroup(given(this, 'setGroup', arguments.length, 2), id, group);
    return this;
  }
  groupOf(id: number): number | undefined {
    return rules.groupOf(this[inner], id);
  }
  setReach(id: number, distance: number): this {
    rules.setReach(given(this, 'setReach', arguments.length, 2), id, distance);
    return this;
  }
  reachOf(id: number): number | undefined {
    return rules.reachOf(this[inner], id);
  }

  update(): this {
    update(this[inner]);
    show(this[inner]);
    return this;
  }
  get pairs(): Uint32Array {
    return pairsIn(this[inner]);
  }
  eachPair(): IterableIterator<[a: number, b: number]> {
    return eachPair(this.pairs.slice());
  }
  get pairCount(): number {
    return pairCount(this[inner]);
  }
  get began(): Uint32Array {
    return eventsIn(this[inner], began);
  }
  get ended(): Uint32Array {
    return eventsIn(this[inner], ended);
  }
  isColliding(a: number, b: number): boolean {
    return places.isColliding(given(this, 'isColliding', arguments.length, 2), a, b);
  }
  collisionsOf(id: number, out?: number[]): number[] {
    return places.collisionsOf(given(this, 'collisionsOf', arguments.length, 2), id, out);
  }
  pairsWith(other: BroadPhase<D>): Uint32Array {
    if (!(other instanceof BroadPhase)) badValue('pairsWith', other, 'another BroadPhase, of the same import', true);
    return pairsWith(this[inner], other[inner]);
  }

  queryBox(...query: BoxQuery<D, BoxOptions>): number[];
  queryBox(a: number, b: number, c: number, d: number, e?: unknown, f?: unknown, options?: BoxOptions): number[] {
    const instance = given(this, 'queryBox', arguments.length, 1 + 2 * this.dimensions);
    return places.queryBox(instance, a, b, c, d, e, f, options);
  }
  queryPoint(...query: PointQuery<D, IdsOptions>): number[];
  queryPoint(x: number, y: number, z?: unknown, options?: IdsOptions): number[] {
    return places.queryPoint(given(this, 'queryPoint', arguments.length, 1 + this.dimensions), x, y, z, options);
  }
  queryCircle(...query: D extends 2 ? RoundQuery<2, IdsOptions> : never): number[];
  queryCircle(x: number, y: number, radius: number, options?: IdsOptions): number[] {
    return places.queryCircle(given(this, 'queryCircle', arguments.length, 2 + this.dimensions), x, y, radius, options);
  }
  querySphere(...query: D extends 3 ? RoundQuery<3, IdsOptions> : never): number[];
  querySphere(x: number, y: number, z: number, radius: number, options?: IdsOptions): number[] {
    return places.querySphere(given(this, 'querySphere', arguments.length, 5), x, y, z, radius, options);
  }
  queryPlanes(planes: Numbers, options?: PlanesOptions): number[] {
    return queryPlanes(given(this, 'queryPlanes', arguments.length, 2), planes, options);
  }
  rayCast(...query: RayQuery<D, RayOptions>): RayHit | undefined;
  rayCast(a: number, b: number, c: number, d: number, e?: unknown, f?: unknown, options?: RayOptions) {
    return ahead.rayCast(given(this, 'rayCast', arguments.length, 1 + 2 * this.dimensions), a, b, c, d, e, f, options);
  }
  rayCastAll(...query: RayQuery<D, RayAllOptions>): RayHit[];
  rayCastAll(a: number, b: number, c: number, d: number, e?: unknown, f?: unknown, options?: RayAllOptions): RayHit[] {
    const instance = given(this, 'rayCastAll', arguments.length, 1 + 2 * this.dimensions);
    return ahead.rayCastAll(instance, a, b, c, d, e, f, options);
  }
  sweep(...query: SweepQuery<D, SweepOptions>): SweepHit | undefined;
  sweep(
    a: number,
    b: number,
    c: number,
    d: number,
    e: number,
    f: number,
    g?: unknown,
    h?: unknown,
    i?: unknown,
    options?: SweepOptions,
  ) {
    const instance = given(this, 'sweep', arguments.length, 1 + 3 * this.dimensions);
    return ahead.sweep(instance, a, b, c, d, e, f, g, h, i, options);
  }
  nearest(...query: NearestQuery<D, NearestOptions>): number[];
  nearest(x: number, y: number, z: number, k?: unknown, options?: NearestOptions): number[] {
    return ahead.nearest(given(this, 'nearest', arguments.length, 2 + this.dimensions), x, y, z, k, options);
  }
  queryBoxes(boxes: Boxes, options?: ManyBoxOptions): ManyIds {
    return askMany(given(this, 'queryBoxes', arguments.length, 2), 'queryBoxes', boxes, options, 1);
  }
  queryPoints(points: Numbers, options?: ManyAreaOptions): ManyIds {
    return askMany(given(this, 'queryPoints', arguments.length, 2), 'queryPoints', points, options, 1);
  }
  queryCircles(circles: Numbers, options?: ManyAreaOptions): ManyIds {
    return askMany(given(this, 'queryCircles', arguments.length, 2), 'queryCircles', circles, options, 1);
  }
  rayCasts(rays: Numbers, options?: ManyFarOptions<ManyRayHits>): ManyRayHits {
    return askMany(given(this, 'rayCasts', arguments.length, 2), 'rayCasts', rays, options, 1) as ManyRayHits;
  }
  sweeps(boxes: Numbers, options?: ManyOptions<ManySweepHits>): ManySweepHits {
    return askMany(given(this, 'sweeps', arguments.length, 2), 'sweeps', boxes, options, 1) as ManySweepHits;
  }
  nearests(points: Numbers, k: number, options?: ManyFarOptions<ManyNearest>): ManyNearest {
    return askMany(given(this, 'nearests', arguments.length, 3), 'nearests', points, options, k) as ManyNearest;
  }
  nearestsOfAll(k: number, options?: Omit<ManyFarOptions<ManyNearestOfAll>, 'ignoreEach'>): ManyNearestOfAll {
    const instance = given(this, 'nearestsOfAll', arguments.length, 2);
    return askMany(instance, 'nearestsOfAll', nothing, options, k) as ManyNearestOfAll;
  }

  get stats(): Readonly<Stats> {
    return statsOf(this[inner]);
  }
  get technique(): TechniqueName {
    return techniques[this[inner].technique]!;
  }
  set technique(name: LeanTechnique) {
    this[inner].setTechnique(checkTechnique(name, this[inner].exports.techniques())); // `init` changes later spaces
  }
  structure(): Float32Array {
    return structure(this[inner]);
  }
  snapshot(): Uint8Array<ArrayBuffer> {
    return snapshot(this[inner]);
  }
  restore(bytes: Uint8Array | ArrayBuffer): this {
    restore(this[inner], bytes);
    return this;
  }

  /**
   * How a space is printed, and serialized to JSON: without its boxes, which `snapshot` saves.
   *
   * @example
   * const space = new BroadPhase().set(7, 0, 0, 1, 1);
   * JSON.stringify(space); // → '{"dimensions":2,"technique":"auto","size":1,"pairs":0}'
   */
  toJSON():
    | {
        /** The dimensions of the space. */
        dimensions: 2 | 3;
        /** The technique of the space. */
        technique: TechniqueName;
        /** How many boxes there are. */
        size: number;
        /** How many pairs the last update found. */
        pairs: number;
      }
    | {
        /** The only property after `dispose`. */
        disposed: true;
      } {
    if (this[inner].isDisposed) return { disposed: true };
    return { dimensions: this.dimensions, technique: this.technique, size: this.size, pairs: this.pairCount };
  }
  validate(): this {
    validate(this[inner]);
    return this;
  }
  dispose(): void {
    this[inner].dispose();
  }

  /**
   * For broadphase/trace: from now on calls `watcher`, if any, after each update; null leaves that as it is. Returns the
   * options that concern pairs.
   * @internal
   */
  '#watch'(watcher?: Watcher | null): World {
    const instance = this[inner];
    if (watcher && instance.watcher) throw new Error('this BroadPhase is being recorded already');
    if (watcher !== null) instance.watcher = watcher;
    return { wrap: instance.wrap, touching: instance.touching };
  }
}
