// The class BroadPhase: a Map from id to box that knows which of its boxes overlap.
// All state lives in the kernel's memory (kernel/space/); this file checks what comes in, passes it on, and
// gives views of what comes out. Nothing here runs once per box or per pair of an update.
import type { BoxOfId, Dimensions, MovingBoxOfId } from './dimensions.ts';
import {
  badBox,
  badCount,
  badId,
  badQuestion,
  badValue,
  checkBits,
  checkNumberArray,
  checkOptions,
  checkWrap,
  isId,
  maxId,
  noBox,
  sweep2,
  sweep3,
} from './errors.ts';
import type { Technique as LeanTechnique } from './generated/kernel-lean.ts';
import { builtDimensions, builtTechniques } from './kernel.ts';
import { Pairing } from './pairing.ts';
import { badSnapshot, headerBytes, snapshotBytes } from './snapshot.ts';
import { isFloat32Array } from './values.ts';
import { type Watcher, type World, watch } from './watch.ts';

/** Options of {@link BroadPhase}, all optional. */
export interface BroadPhaseOptions<D extends Dimensions = 2, Technique extends TechniqueName = LeanTechnique> {
  /** 2 or 3. Default 2; in `broadphase/3d` 3. */
  dimensions?: D;
  /** One of {@link BroadPhase.techniques}. Default `'auto'`. */
  technique?: Technique;
  /**
   * For grids, which are in `broadphase/all`: the side of a cell, or one number per axis, above 0. `auto` has no
   * grid, and does not look at it. One so small that boxes would stand in very many cells is doubled until they do
   * not. Left out: chosen from the boxes.
   */
  cellSize?: number | readonly number[];
  /** For `spatial-grid`, in `broadphase/all`: the world that is cut into cells, minima then maxima. Boxes outside are found all the same. */
  bounds?: readonly number[];
  /**
   * The size of a world that wraps around, along each axis: what leaves it on one side comes in on the other, as in
   * Asteroids. Boxes may be given anywhere; two are a pair where they overlap once both are moved by whole worlds. A
   * box as long as the world, or without an end, reaches all around. The numbers stay as they were given. Questions see
   * a copy of each box in every world, and answer each once: see the guide to queries. Numbers above 0, up to 1e300. Left out: the world has no end.
   */
  wrap?: readonly number[];
  /**
   * Whether boxes that only touch overlap: in pairs, events, and, unless they say otherwise, questions about places.
   * Default true. Where false, a box without size overlaps only what it is inside of.
   */
  touching?: boolean;
  /** Whether every update finds out which pairs began and ended, for `began`. Default false. */
  events?: boolean;
  /** For `aabb-tree`, in `broadphase/all`: how far a box may move before the tree changes, above 0. Left out: from the motion seen. */
  margin?: number;
  /** A hint: how many boxes there will be, 0 … 2^24. Saves growing while they are added. */
  capacity?: number;
}

/** The names of all options. */
export const optionNames: readonly (keyof BroadPhaseOptions)[] = [
  'dimensions',
  'technique',
  'cellSize',
  'bounds',
  'wrap',
  'touching',
  'events',
  'margin',
  'capacity',
];

/** All that there are, in the order of the kernel's numbers, which stand in snapshots: new ones go before 'auto'. */
const techniques = [
  'brute-force',
  'spatial-grid',
  'retained-grid',
  'home-cell-grid',
  'hierarchical-grid',
  'sweep-and-prune',
  'strip-sweep',
  'quadtree',
  'bsp-tree',
  'r-tree',
  'aabb-tree',
  'incremental',
  'auto',
] as const;

/** The name of a technique. */
export type TechniqueName = (typeof techniques)[number];

/** The arguments of `new BroadPhase`: a space of other than two dimensions has to say so. */
export type ConstructorOptions<D extends Dimensions, Technique extends TechniqueName = LeanTechnique> = 2 extends D
  ? [options?: BroadPhaseOptions<D, Technique>]
  : [options: BroadPhaseOptions<D, Technique> & DimensionsSaid<D>];

/** What a space of other than two dimensions has to be given. */
export interface DimensionsSaid<D extends Dimensions> {
  /** The number of dimensions: it has to be said where it is not 2. */
  dimensions: NoInfer<D>;
}

const reasons = [
  'asked for',
  'a handful of boxes',
  'what was found is kept: boxes rest or move little',
  'all is found anew: how boxes move is being watched',
  'all is found anew: boxes move too far, or there are few',
  'all is found anew: after a snapshot, no update before may show in the order of pairs',
] as const;

/** Why a technique ran. */
export type Reason = (typeof reasons)[number];

/** Counters of the last update. */
export interface Stats {
  /** The technique that ran: what `auto` chose. */
  technique: TechniqueName;
  /** Why it ran: where `auto` chose it, what it saw. */
  reason: Reason;
  /** Boxes tested against boxes. */
  tests: number;
  /** Pairs found in float32, before the exact test in double precision and the last of the filters. */
  candidates: number;
  /** Pairs reported. */
  pairs: number;
  /** Cells, strips or nodes in use. */
  cells: number;
  /** Places of boxes in them: more than there are boxes where a box stands in several. */
  entries: number;
  /** Bytes of memory in use by the space. */
  bytes: number;
}

/** Boxes for {@link BroadPhase.setAll}: interleaved, minima then maxima, box after box. */
export type Boxes = Float32Array | Float64Array | readonly number[];

const broken = [
  '',
  'ids and slots do not name each other, at id',
  'a box has a NaN or a minimum above its maximum, id',
  'a box is not what its numbers are rounded to, id',
  '',
  'a pair is not in order, number',
];

/**
 * For find-pairs.ts: boxes 0 … red - 1 become red, the others blue; only pairs of both colours are reported.
 * @internal
 */
export let splitColours: (space: BroadPhase<Dimensions>, red: number) => void;

/**
 * For find-pairs.ts: `setAll`, by the name of another function in errors.
 * @internal
 */
export let fill: <Space extends BroadPhase<Dimensions>>(
  space: Space,
  boxes: Boxes,
  count: number | undefined,
  where: string,
) => Space;

/**
 * For find-pairs.ts: makes a space that has its first options as new. Returns how many bytes it has used at most.
 * @internal
 */
export let beginAnew: (space: BroadPhase<Dimensions>) => number;

/**
 * Finds every overlapping pair among boxes that move. Reads like a Map from id to box.
 *
 * Boxes are closed: touching boxes overlap, unless `touching` is false. Boxes of zero size are points, infinite ones are half planes; both
 * are legal. The pairs are exactly those of the numbers given, doubles included, whatever the technique.
 *
 * Rays and sweeps meet a box where their way leads into a face of it: along a face or away from it is no hit.
 *
 * Questions (`queryBox` to `nearest`, `isColliding`, `collisionsOf`) are answered by what the last update saw: boxes
 * that were set, moved or deleted since then make no difference until the next, and before the first update there is
 * nothing. A large space that has not been asked keeps no copy of its boxes (above 16,384, and 4,096 written in
 * place): its first question is to follow an update, or throws. All is decided in double precision. The options are read at each
 * call; to make no garbage, keep and reuse them with an `out` in them, whose answers stay about as many. All questions
 * throw RangeError for NaN, a minimum above its maximum, infinite points, ways and directions, negative distances, and
 * masks and ids out of range; TypeError for other than numbers and for a wrong number of them.
 *
 * @example
 * const space = new BroadPhase();
 * space.set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
 * space.pairs; // → Uint32Array [7, 9]
 */
export class BroadPhase<D extends Dimensions = 2> extends Pairing<D> {
  /**
   * The names of the techniques there are, in order: with `import 'broadphase'` the few that games need, with
   * `import 'broadphase/all'`, or after `init` with `broadphase/kernel.wasm`, every one.
   *
   * @example
   * BroadPhase.techniques.includes('auto'); // → true
   */
  static get techniques(): readonly TechniqueName[] {
    return techniques.filter((_, k) => isBuilt(k));
  }

  #statsView = new Float64Array();
  readonly #stagedViews: (Float32Array | Float64Array)[] = [];
  readonly #stats: Stats = {
    technique: 'auto',
    reason: 'asked for',
    tests: 0,
    candidates: 0,
    pairs: 0,
    cells: 0,
    entries: 0,
    bytes: 0,
  };
  readonly #pairViews: Uint32Array[] = [];
  readonly #beganViews: Uint32Array[] = [];
  readonly #endedViews: Uint32Array[] = [];
  readonly #events: boolean;
  #technique: TechniqueName;
  /** What `boxes()` gave last, while it is in use. */
  #view: Float32Array | undefined;
  /** Whether it may have been written since the last update: then growing memory must not cut it off unnoticed. */
  #viewIsOpen = false;
  #watcher: Watcher | undefined;

  /**
   * An empty space. Ready at once: nothing has to be awaited.
   *
   * @throws RangeError or TypeError that names the option
   * @throws Error where WebAssembly with SIMD is missing or forbidden
   *
   * @example
   * new BroadPhase({ dimensions: 3, events: true }).dimensions; // → 3
   * new BroadPhase({ capacity: -1 }); // throws RangeError: capacity: got -1, expected an integer from 0 to 16777216
   */
  constructor(...options: ConstructorOptions<D>);
  constructor(options: BroadPhaseOptions<D> = {}) {
    checkOptions('new BroadPhase', options, optionNames);
    const {
      dimensions = builtDimensions[0] as D,
      technique = 'auto',
      cellSize,
      bounds,
      margin,
      wrap,
      touching = true,
      events = false,
      capacity = 0,
    } = options;
    checkDimensions(dimensions);
    checkTechnique(technique);
    checkBoolean('events', events);
    checkBoolean('touching', touching);
    checkBoxCount('capacity', capacity);
    const cells = cellSize === undefined ? undefined : checkCellSize(cellSize, dimensions);
    if (bounds !== undefined) checkBounds(bounds, dimensions);
    if (margin !== undefined) checkMargin(margin);
    checkHeeded({ cellSize, bounds, margin });
    if (wrap !== undefined) checkWrap(wrap, dimensions);

    super(dimensions, wrap?.slice(), touching);
    this.#technique = technique;
    this.kernel.set_technique(techniques.indexOf(technique));
    this.#events = events;
    if (events) this.kernel.set_events();
    if (!touching) this.kernel.set_touching(0);
    const io = this.io();
    if (cells) {
      io.set(cells);
      this.kernel.set_cell_size();
    }
    if (margin !== undefined) this.kernel.set_margin(margin);
    if (wrap) {
      io.set(wrap);
      this.kernel.set_wrap();
    }
    if (bounds) {
      io.set(bounds);
      this.kernel.set_bounds();
    }
    try {
      this.kernel.reserve(capacity);
    } catch (error) {
      this.recover(error, 'capacity');
    }
  }

  /**
   * Adds box `id`, or moves it: 2D `set(id, minX, minY, maxX, maxY)`, 3D `set(id, minX, minY, minZ, maxX, maxY, maxZ)`.
   * Chainable.
   *
   * @param box an id, which is an integer from 0 to 2^24 - 1: ids near 0 without gaps are best; the least coordinates, in
   *   the units of your world: any numbers but NaN, infinite ones too; then the largest ones, not below the least
   * @throws RangeError for a bad id, for NaN, and for a minimum above its maximum; TypeError for other than
   *   numbers and for a wrong number of them. The space is as before.
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 0, 0, 10, 10).set(7, 1, 0, 11, 10);
   * space.size; // → 1
   * space.set(7, Number.NaN, 0, 1, 1); // throws RangeError: set: minX of box 7 is NaN, expected a number
   *
   * @example
   * const space = new BroadPhase({ dimensions: 3 });
   * space.set(7, 0, 0, 0, 1, 1, 1).get(7); // → Float64Array [0, 0, 0, 1, 1, 1]
   */
  set(...box: BoxOfId<D>): this;
  set(id: number, a: number, b: number, c: number, d: number, e?: number, f?: number): this {
    // Short enough for engines to inline, since a call boxes its doubles, and boxes are garbage: V8 does it up to 460
    // bytes of its code, those of what is inlined in here included. `arguments` itself must not leave, or it is made in
    // every call.
    const { width } = this;
    if (
      // biome-ignore lint/complexity/noArguments: a rest parameter would be an array per call
      arguments.length !== width + 1 ||
      typeof id !== 'number' ||
      typeof a !== 'number' ||
      typeof b !== 'number' ||
      typeof c !== 'number' ||
      typeof d !== 'number' ||
      id >>> 0 !== id ||
      id > maxId ||
      !(width === 4 ? a <= c && b <= d : typeof e === 'number' && typeof f === 'number' && a <= d && b <= e && c <= f)
    ) {
      // biome-ignore lint/complexity/noArguments: the same
      badSet(arguments.length, id, a, b, c, d, e, f, this.dimensions);
    }
    const waits = id < this.dense || this.mayWait(id);
    let k = this.next;
    if (!waits || k >= this.ring.length) k = this.drain(); // one that cannot wait comes alone
    const { ring } = this;
    ring[k] = id;
    ring[k + 1] = a;
    ring[k + 2] = b;
    ring[k + 3] = c;
    ring[k + 4] = d;
    if (width === 6) {
      ring[k + 5] = e!;
      ring[k + 6] = f!;
    }
    this.next = k + width + 1;
    if (!waits) this.takeNow();
    return this;
  }

  /**
   * Adds or moves box `id` for swept tests: for what moves so fast that it would pass others between two frames. The
   * box is given as it stands, and how far it moves until the next frame; it is kept as the bounds of the whole way, so
   * that its pairs are all it may meet. Which it does meet, when and on which side, `sweep` with the same numbers tells.
   * 2D `setSwept(id, minX, minY, maxX, maxY, dx, dy)`, 3D `setSwept(id, minX, minY, minZ, maxX, maxY, maxZ, dx, dy, dz)`.
   *
   * @param box an id; where the box stands now, as for `set`; how far it moves along each axis: finite numbers
   * @throws as `set` does. The space is as before.
   *
   * @example
   * const space = new BroadPhase();
   * const bullet = 1, wall = 7;
   * space.set(wall, 21, -5, 22, 5);
   * space.setSwept(bullet, 0, 0, 1, 1, 40, 0).update(); // it moves 40 to the right
   * space.pairs; // → Uint32Array [1, 7]
   * space.sweep(0, 0, 1, 1, 40, 0, { ignore: bullet })?.time; // → 0.5
   *
   * @example
   * const space = new BroadPhase({ dimensions: 3 });
   * space.setSwept(1, 0, 0, 0, 1, 1, 1, 0, 0, 40).get(1); // → Float64Array [0, 0, 0, 1, 1, 41]
   */
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
    const flat = this.width === 4;
    if (
      // biome-ignore lint/complexity/noArguments: a rest parameter would be an array per call
      arguments.length !== (flat ? 7 : 10) ||
      !isId(id) ||
      !(areNumbers(a, b, c, d, e, f) && (flat || areNumbers(g, h, i))) ||
      !(flat ? a <= c && b <= d : a <= d && b <= e && c <= f) ||
      // What is infinite is NaN without itself.
      (flat ? e - e + (f - f) : g! - g! + (h! - h!) + (i! - i!)) !== 0
    ) {
      badSwept(id, [a, b, c, d, e, f, g, h, i], this.dimensions);
    }
    const waits = id < this.dense || this.mayWait(id);
    let k = this.next;
    if (!waits || k >= this.ring.length) k = this.drain(); // one that cannot wait comes alone
    const { ring } = this;
    ring[k] = id;
    if (flat) {
      ring[k + 1] = a + Math.min(e, 0);
      ring[k + 2] = b + Math.min(f, 0);
      ring[k + 3] = c + Math.max(e, 0);
      ring[k + 4] = d + Math.max(f, 0);
    } else {
      ring[k + 1] = a + Math.min(g!, 0);
      ring[k + 2] = b + Math.min(h!, 0);
      ring[k + 3] = c + Math.min(i!, 0);
      ring[k + 4] = d + Math.max(g!, 0);
      ring[k + 5] = e + Math.max(h!, 0);
      ring[k + 6] = f + Math.max(i!, 0);
    }
    this.next = k + this.width + 1;
    if (!waits) this.takeNow();
    return this;
  }

  /**
   * Replaces all boxes, by ids 0 … count - 1.
   *
   * @param boxes 4 (2D) or 6 (3D) numbers for each box, as `set` takes them, one box after the other
   * @param count how many boxes to take; default: all there are
   * @throws RangeError that names the first bad id and its value, or a length that does not fit; TypeError for
   *   other than an array of numbers. The space is as before.
   *
   * @example
   * const space = new BroadPhase();
   * space.setAll([0, 0, 10, 10, 5, 5, 15, 15]).update();
   * space.pairs; // → Uint32Array [0, 1]
   */
  setAll(boxes: Boxes, count?: number): this;
  setAll(boxes: Boxes, count?: number, where = 'setAll'): this {
    const width = this.width;
    const single = isFloat32Array(boxes);
    checkNumberArray(where, boxes);
    if (count === undefined) count = countBoxes(where, boxes, this.dimensions);
    const { length } = boxes;
    // Told apart before the text is made: a string in each call would be garbage.
    if (!isBoxCount(count)) checkBoxCount(`${where}: count`, count);
    if (count * width > length) {
      badValue(`${where}: count`, count, `at most ${Math.floor(length / width)}, as ${length} numbers were given`);
    }
    if (Array.isArray(boxes)) checkNumbers(where, boxes, count, this.dimensions); // typed arrays hold nothing else
    try {
      const kernel = this.kernel;
      const at = (single ? kernel.stage(count) : kernel.stage_exact(count)) >>> 0;
      const view = this.#stagedView(at, count * width, single);
      if (length === view.length) view.set(boxes);
      else
        view.set(Array.isArray(boxes) ? boxes.slice(0, view.length) : (boxes as Float64Array).subarray(0, view.length));
      this.forget();
      const bad = kernel.replace(count, single ? 0 : 1);
      if (bad >= 0) badBox(where, bad, view.slice(bad * width, (bad + 1) * width), this.dimensions);
    } catch (error) {
      this.recover(error, where);
    }
    this.#view = undefined;
    return this;
  }

  /**
   * The fastest way in: an array over the kernel's own memory for the boxes of ids 0 … count - 1, to be written
   * in place, as float32, before `update()`. Ids from count on are removed; new ones are points at the origin. This call
   * makes every box float32, rounded to the nearest: boxes that only nearly touched as doubles may be pairs then.
   *
   * Ask for the array before each time it is written: it costs next to nothing and makes no garbage. Until `setAll`,
   * `clear` or `restore` it shows what `set` does at once, and what is written to it afterwards counts instead, in place
   * of doubles too. A double that `set` has given stays one until its box is written otherwise than it is shown. After
   * `delete`, and after `update`, ask again: its rows may stand for other boxes then, or memory has grown and cut it
   * off. `update()` checks what was written, and throws where the array was cut off and not asked for again since.
   *
   * @param count how many boxes, 0 … 2^24
   * @throws RangeError for a bad count
   *
   * @example
   * const space = new BroadPhase();
   * const boxes = space.boxes(1000);
   * for (let id = 0; id < 1000; id++) {
   *   boxes[4 * id] = id; // minX
   *   boxes[4 * id + 1] = 0; // minY
   *   boxes[4 * id + 2] = id + 1; // maxX: it touches the next one
   *   boxes[4 * id + 3] = 1; // maxY
   * }
   * space.update().pairCount; // → 999
   */
  boxes(count: number): Float32Array {
    checkBoxCount('boxes: count', count);
    try {
      const { kernel } = this;
      this.forget();
      const at = kernel.expose(count) >>> 0;
      const length = count * this.width;
      let view = this.#view;
      if (view?.byteOffset !== at || view.length !== length) {
        view = new Float32Array(kernel.memory.buffer, at, length);
        this.#view = view;
      }
      this.#viewIsOpen = true;
      return view;
    } catch (error) {
      this.recover(error, 'boxes');
    }
  }

  /**
   * Takes box `id` away, with its filter.
   * @param id an integer from 0 to 2^24 - 1, of a box or not
   * @returns whether there was one
   * @throws RangeError for a bad id
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 0, 0, 1, 1);
   * space.delete(7); // → true
   * space.delete(7); // → false
   */
  delete(id: number): boolean {
    if (!isId(id)) badId('delete', id);
    if (!this.#viewIsOpen) this.#view = undefined;
    try {
      const { kernel } = this;
      this.forget();
      return kernel.remove(id) === 1;
    } catch (error) {
      this.recover(error, 'delete');
    }
  }

  /**
   * Whether there is a box `id`.
   * @param id an integer from 0 to 2^24 - 1
   * @throws RangeError for a bad id
   *
   * @example
   * new BroadPhase().has(7); // → false
   */
  has(id: number): boolean {
    if (!isId(id)) badId('has', id);
    return this.knows(id);
  }

  /**
   * The numbers box `id` was given with, or `undefined` where there is none.
   * @param id an integer from 0 to 2^24 - 1
   * @throws RangeError for a bad id
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
   * @throws TypeError where it is no array, or one of fixed length that is too short
   *
   * @example
   * const space = new BroadPhase();
   * const box = [0, 0, 0, 0];
   * space.set(7, 0, 0, 10, 10).get(7, box); // → [0, 0, 10, 10]
   */
  get<Out extends Float32Array | Float64Array | number[]>(id: number, out: Out): Out | undefined;
  get(id: number, out: Float32Array | Float64Array | number[] = new Float64Array(this.width)) {
    if (!isId(id)) badId('get', id);
    const fixed = ArrayBuffer.isView(out);
    if (!(fixed || Array.isArray(out)) || (fixed && !(out.length >= this.width))) {
      badValue('get: out', out, `an array, or a typed array of ${this.width} numbers`, true);
    }
    if (this.kernel.get(id) === 0) return undefined;
    const io = this.io();
    for (let k = 0; k < this.width; k++) out[k] = io[k]!;
    return out;
  }

  /**
   * Says whom box `id` meets: a pair is reported where each one's layer has a bit in the other's mask, so that a box
   * of layer 0 is in none. Both are 32 bits; without a filter both have all bits set, so that a box meets all but those
   * that want to meet nobody. Applied before and inside the search: boxes that ignore each other cost little, boxes
   * that can meet nobody cost nothing. The filter belongs to the id: it stays when the box moves, by whatever call,
   * and goes with `delete` and `clear`.
   *
   * @param id an integer from 0 to 2^24 - 1, of a box that is there
   * @param layer what the box is: an integer from 0 to 2^32 - 1, most often one bit
   * @param mask whom it meets: the same, most often some bits. Write `~bits >>> 0` for all but some
   * @throws RangeError for a bad id or one that has no box, and for other than 32 bits; TypeError for other than numbers
   *
   * @example
   * const space = new BroadPhase();
   * const player = 1, enemy = 2, bullet = 4;
   * for (const id of [0, 1, 2]) space.set(id, 0, 0, 1, 1);
   * space.setFilter(0, player, enemy);
   * space.setFilter(1, enemy, player | bullet);
   * space.setFilter(2, bullet, enemy); // bullets meet enemies, but neither players nor bullets
   * space.update().pairs; // → Uint32Array [0, 1, 1, 2]
   */
  setFilter(id: number, layer: number, mask: number): this {
    if (!isId(id)) badId('setFilter', id);
    checkBits('setFilter: layer', layer);
    checkBits('setFilter: mask', mask);
    try {
      if (this.kernel.set_filter(id, layer, mask) === 0) noBox('setFilter', id);
    } catch (error) {
      this.recover(error, 'setFilter');
    }
    return this;
  }

  /**
   * Says whether box `id` is static: two static boxes are never a pair. Static boxes may be moved like others. Belongs
   * to the id, as filters do.
   *
   * @param id an integer from 0 to 2^24 - 1, of a box that is there
   * @param isStatic true unless told
   * @throws RangeError for a bad id or one that has no box; TypeError for other than a boolean
   *
   * @example
   * const space = new BroadPhase();
   * space.set(0, 0, 0, 9, 1).setStatic(0).set(1, 8, 0, 9, 9).setStatic(1); // two walls
   * space.set(2, 8, 0, 9, 1); // and a ball
   * space.update().pairCount; // → 2
   */
  setStatic(id: number, isStatic = true): this {
    if (!isId(id)) badId('setStatic', id);
    checkBoolean('setStatic: isStatic', isStatic);
    try {
      if (this.kernel.set_static(id, isStatic ? 1 : 0) === 0) noBox('setStatic', id);
    } catch (error) {
      this.recover(error, 'setStatic');
    }
    return this;
  }

  /**
   * Switches box `id` off, or on again. A box that is off keeps its numbers and its filter, and can be set, moved and
   * deleted; it is in no pair and in no answer from the next update on, which ends its pairs. Belongs to the id, as
   * filters do. While some box is off, an update looks at all boxes and pairs, also where little changes.
   *
   * @param id an integer from 0 to 2^24 - 1, of a box that is there
   * @param enabled whether it takes part
   * @throws RangeError for a bad id or one that has no box; TypeError for other than a boolean
   *
   * @example
   * const space = new BroadPhase();
   * space.set(0, 0, 0, 9, 9).set(1, 1, 1, 2, 2).setEnabled(1, false);
   * space.update().pairCount; // → 0
   * space.setEnabled(1, true).update().pairCount; // → 1
   */
  setEnabled(id: number, enabled: boolean): this {
    if (!isId(id)) badId('setEnabled', id);
    checkBoolean('setEnabled: enabled', enabled);
    try {
      if (this.kernel.set_enabled(id, enabled ? 1 : 0) === 0) noBox('setEnabled', id);
    } catch (error) {
      this.recover(error, 'setEnabled');
    }
    return this;
  }

  /**
   * Takes all boxes away, with their filters.
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 0, 0, 1, 1).clear();
   * space.size; // → 0
   */
  clear(): void {
    this.kernel.clear();
    this.forget();
    this.#view = undefined;
  }

  /**
   * Brings the pairs up to date with the boxes. Chainable.
   * @throws RangeError that names the first bad box written through `boxes()`; the pairs stay as they were
   * @throws Error where the array that `boxes()` gave has been cut off by growing memory and not been asked for again
   * @throws RangeError where memory ends: the pairs are empty, and the space works again once there are fewer
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15);
   * space.pairCount; // → 0
   * space.update().pairCount; // → 1
   */
  update(): this {
    if (this.#view?.byteOffset === 0) {
      // Only views that were cut off stand there.
      throw new Error(
        'update: the array of boxes() was detached when memory grew, so what was written to it since is lost: ' +
          'call boxes(count) again before you write',
      );
    }
    let bad = -1;
    try {
      bad = this.kernel.update();
    } catch (error) {
      try {
        this.recover(error, 'update');
      } finally {
        this.#readStats();
      }
    }
    if (bad >= 0) this.#badInPlace('update', bad);
    this.#viewIsOpen = false;
    this.#readStats();
    if (this.#watcher !== undefined) this.#show(this.#watcher);
    return this;
  }

  /**
   * Each overlapping pair of ids once, `[a0, b0, a1, b1, …]` with a < b, as of the last update: boxes that were deleted
   * since are still named. The order
   * depends only on the calls made. A view of the kernel's memory: valid until the next `update()`, or until adding
   * many boxes at once makes memory grow; then its length is 0. There is room for some boxes, and for all questions.
   *
   * @example
   * const space = new BroadPhase();
   * const { pairs } = space.setAll([0, 0, 10, 10, 5, 5, 15, 15]).update();
   * for (let k = 0; k < pairs.length; k += 2) console.assert(pairs[k] < pairs[k + 1]);
   * pairs; // → Uint32Array [0, 1]
   */
  get pairs(): Uint32Array {
    return this.pairView(this.#pairViews, this.kernel.pairs_address(), this.kernel.pair_count());
  }

  /**
   * Each pair of `pairs`, `[a, b]`: to write `for (const [a, b] of space.eachPair())`. Several times as slow as a loop over
   * `pairs`, and makes garbage for each. Walks a copy: boxes may be changed, and updated, meanwhile.
   *
   * @example
   * const space = new BroadPhase().setAll([0, 0, 10, 10, 5, 5, 15, 15]).update();
   * [...space.eachPair()]; // → [[0, 1]]
   */
  eachPair(): IterableIterator<[a: number, b: number]> {
    return each(this.pairs.slice());
  }

  /**
   * The number of pairs as of the last update: half the length of `pairs`.
   *
   * @example
   * new BroadPhase().setAll([0, 0, 10, 10, 5, 5, 15, 15]).update().pairCount; // → 1
   */
  get pairCount(): number {
    return this.kernel.pair_count();
  }

  /**
   * The pairs that the last update found and the one before did not, as in `pairs` and in their order: with `events:
   * true` only. A view of the kernel's memory: valid as long as `pairs`.
   *
   * A pair whose box was deleted has ended with the next update, and has begun with it too where the id was set again
   * and overlaps again: it is another box. Boxes that `setAll`, `boxes` and `clear` take away were deleted.
   *
   * @throws Error without `events: true`
   *
   * @example
   * const space = new BroadPhase({ events: true });
   * space.set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15);
   * space.update().began; // → Uint32Array [7, 9]
   * space.update().began; // → Uint32Array []
   */
  get began(): Uint32Array {
    if (!this.#events) noEvents('began');
    return this.pairView(this.#beganViews, this.kernel.began_address(), this.kernel.began_count());
  }

  /**
   * The pairs that the update before the last found and the last did not, or whose boxes were deleted in between: see
   * {@link BroadPhase.began}. In the order that they had in `pairs`.
   *
   * @throws Error without `events: true`
   *
   * @example
   * const space = new BroadPhase({ events: true });
   * space.set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
   * space.delete(9);
   * space.update().ended; // → Uint32Array [7, 9]
   */
  get ended(): Uint32Array {
    if (!this.#events) noEvents('ended');
    return this.pairView(this.#endedViews, this.kernel.ended_address(), this.kernel.ended_count());
  }

  /**
   * Counters of the last update: the same object every time.
   *
   * @example
   * const { stats } = new BroadPhase().setAll([0, 0, 10, 10, 5, 5, 15, 15]).update();
   * stats.technique; // → 'brute-force'
   * stats.reason; // → 'a handful of boxes'
   */
  get stats(): Readonly<Stats> {
    return this.#stats;
  }

  /**
   * The technique, which may be changed at any time: the pairs stay the same.
   *
   * @throws RangeError or TypeError for what is not the name of one that this build has
   *
   * @example
   * const space = new BroadPhase();
   * space.technique = 'strip-sweep';
   * space.update().stats.technique; // → 'strip-sweep'
   */
  get technique(): TechniqueName {
    return this.#technique;
  }
  /** Takes effect with the next update. */
  set technique(name: LeanTechnique) {
    checkTechnique(name);
    this.#technique = name;
    this.kernel.set_technique(techniques.indexOf(name));
  }

  /**
   * The boxes of the cells, strips or nodes that the last update used, to draw: 4 numbers (3D: 6) each, as `setAll`'s. A
   * view of the kernel's memory: valid until the next call.
   *
   * @example
   * const space = new BroadPhase({ technique: 'strip-sweep' });
   * const cells = space.setAll([0, 0, 10, 10, 5, 5, 15, 15]).update().structure();
   * cells.length % 4; // → 0
   */
  structure(): Float32Array {
    try {
      const at = this.kernel.structure();
      return new Float32Array(this.kernel.memory.buffer, at, this.kernel.structure_count() * this.width);
    } catch (error) {
      this.recover(error, 'structure');
    }
  }

  /**
   * What stands in the space, as bytes to go back to with `restore`, or to save: boxes as they were given, ids, their order,
   * filters, groups, reaches, which boxes are static, the technique, and with `events: true` the pairs of the last update, and those
   * that began and ended with it. Options of the constructor are not in it. A box takes 16 bytes in 2D and 24 in 3D, twice that where some box is not a
   * float32, 4 more where ids have gaps, and 4 where a box was deleted before another, up to 9 more with filters, 4 with groups, 8 with reaches; a pair 8.
   *
   * From the first call on, and from `restore` on, the order of the pairs depends on what stands in the space alone,
   * so that a restored space gives them in the very order of the one that went on. `auto` then keeps nothing from
   * update to update, and `incremental` sorts its pairs.
   *
   * @throws RangeError that names the first bad box written through `boxes()`
   *
   * @example
   * const space = new BroadPhase();
   * const saved = space.set(7, 0, 0, 10, 10).update().snapshot();
   * space.set(7, 3, 0, 13, 10).update();
   * // the network says that this frame was wrong:
   * space.restore(saved); // and play it again
   * space.get(7); // → Float64Array [0, 0, 10, 10]
   */
  snapshot(): Uint8Array<ArrayBuffer> {
    let bad = -1;
    try {
      const at = this.kernel.save() >>> 0;
      const [length, id] = this.io() as unknown as [number, number];
      if (id < 0) return new Uint8Array(this.kernel.memory.buffer, at, length).slice();
      bad = id;
    } catch (error) {
      this.recover(error, 'snapshot');
    }
    this.#badInPlace('snapshot', bad);
  }

  /**
   * Puts what stood in a space when `snapshot` was called in place of all that stands in this one. From there on the
   * same calls give the same pairs, in the same order, as they gave there, whatever either space did before, where the
   * two were made with the same options.
   *
   * A restored space is as after an update of the boxes that it now has: `pairs`, `isColliding`, `collisionsOf` and all
   * questions answer by them. With `events: true`, `began` and `ended` are those that the space of the snapshot had, and
   * what begins and ends with the next update does so against the pairs that it had: events come again as they came
   * there, and what happened only in frames that were taken back does not end. A snapshot of a space without events has
   * no pairs to tell them from: all begin.
   *
   * @param bytes what `snapshot` gave, in this version of the library or an older one
   * @throws RangeError that says why for bytes that are damaged, cut off, of other dimensions, or no snapshot at all;
   *   TypeError for other than bytes. The space is as before.
   * @throws RangeError where memory ends while the pairs are found: the boxes are restored, the pairs are empty
   *
   * @example
   * const space = new BroadPhase();
   * space.restore(new Uint8Array(100)); // throws RangeError: restore:
   */
  restore(bytes: Uint8Array | ArrayBuffer): this {
    const source = snapshotBytes(bytes);
    const place = this.#place();
    const io = this.io();
    // The header first: memory is taken only for what may be a snapshot and is as long as it says.
    const header = new Uint8Array(io.buffer, io.byteOffset, headerBytes);
    header.fill(0);
    header.set(source.subarray(0, headerBytes));
    let fault = 0;
    try {
      const at = this.kernel.stage_snapshot(source.length) >>> 0;
      fault = this.io()[0]!;
      if (fault === 0) {
        new Uint8Array(this.kernel.memory.buffer, at, source.length).set(source);
        this.forget();
        fault = this.kernel.restore();
      }
    } catch (error) {
      try {
        this.recover(error, 'restore');
      } finally {
        if (this.#place() !== place) this.#restored(source); // memory ended while the pairs were found
      }
    }
    if (fault !== 0) badSnapshot(fault, source, this.dimensions, techniques[source[7]!] ?? `number ${source[7]}`);
    this.#restored(source);
    return this;
  }

  /**
   * What JSON has of a space, and what is printed of it: not its boxes, which `snapshot` saves.
   *
   * @example
   * const space = new BroadPhase().set(7, 0, 0, 1, 1);
   * JSON.stringify(space); // → '{"dimensions":2,"technique":"auto","size":1,"pairs":0}'
   */
  toJSON():
    | {
        /** As of the space. */
        dimensions: 2 | 3;
        /** As of the space. */
        technique: TechniqueName;
        /** How many boxes there are. */
        size: number;
        /** How many pairs the last update found. */
        pairs: number;
      }
    | {
        /** Of a space that was disposed of there is nothing else to say. */
        disposed: true;
      } {
    if (this.disposed) return { disposed: true };
    return { dimensions: this.dimensions, technique: this.technique, size: this.size, pairs: this.pairCount };
  }

  /**
   * For Node's console.
   * @internal
   */
  [Symbol.for('nodejs.util.inspect.custom')](
    _depth: number,
    options: unknown,
    inspect: (value: unknown, options: unknown) => string,
  ): string {
    return `BroadPhase ${inspect(this.toJSON(), options)}`;
  }

  /**
   * Checks every invariant of the space, in time proportional to boxes and pairs.
   * @throws Error that says what is broken, which would be a fault of this library
   *
   * @example
   * new BroadPhase().set(7, 0, 0, 1, 1).validate().size; // → 1
   */
  validate(): this {
    const code = this.kernel.validate();
    if (code !== 0) throw new Error(`validate: ${broken[code]} ${this.io()[0]}`);
    return this;
  }

  /**
   * Lets go of the memory at once; it also goes with the object. Any call after this throws.
   *
   * @example
   * const space = new BroadPhase();
   * space.dispose();
   * space.update(); // throws Error: this BroadPhase was disposed
   */
  override dispose(): void {
    super.dispose();
    this.#pairViews.length = this.#beganViews.length = this.#endedViews.length = 0;
    this.#stagedViews.length = 0;
    this.#view = undefined;
  }

  /**
   * For broadphase/trace: calls `watcher` after each update from now on; without one, no longer. Returns what the
   * options say about pairs.
   * @internal
   */
  [watch](watcher?: Watcher): World {
    if (watcher && this.#watcher) throw new Error('this BroadPhase is being recorded already');
    this.#watcher = watcher;
    return { wrap: this.wrap, touching: this.touching };
  }

  static {
    splitColours = (space, red) => {
      try {
        space.kernel.split(red);
      } catch (error) {
        space.recover(error, 'findPairsBetween');
      }
    };
    fill = (space, ...given) => space.setAll(...(given as unknown as [Boxes]));
    beginAnew = (space) => {
      space.clear();
      return space.kernel.begin_anew() >>> 0;
    };
  }

  #show(watcher: Watcher): void {
    this.kernel.contents();
    const [ids, boxes, doubles, rules, groups, reaches] = this.io();
    const { buffer } = this.kernel.memory;
    const length = this.size * this.width;
    watcher(
      doubles ? new Float64Array(buffer, doubles, length) : new Float32Array(buffer, boxes, length),
      ids ? new Uint32Array(buffer, ids, this.size) : undefined,
      rules ? new Uint32Array(buffer, rules, 3 * this.size) : undefined,
      {
        groups: groups ? new Uint32Array(buffer, groups, this.size) : undefined,
        reaches: reaches ? new Float64Array(buffer, reaches, this.size) : undefined,
      },
    );
  }

  /** Where the boxes stand: elsewhere once others were restored. */
  #place(): number {
    this.kernel.contents();
    return this.io()[1]!;
  }

  #restored(source: Uint8Array): void {
    this.#technique = techniques[source[7]!] ?? 'auto';
    this.#readStats();
    this.#view = undefined;
  }

  #readStats(): void {
    if (this.#statsView.length === 0) {
      this.#statsView = new Float64Array(this.kernel.memory.buffer, this.kernel.stats_address(), 8);
    }
    const from = this.#statsView;
    const stats = this.#stats;
    stats.tests = from[0]!;
    stats.candidates = from[1]!;
    stats.pairs = from[2]!;
    stats.cells = from[3]!;
    stats.entries = from[4]!;
    stats.bytes = from[5]!;
    stats.technique = techniques[from[6]!]!;
    stats.reason = reasons[from[7]!]!;
  }

  /** A box that was written through `boxes()` is bad. */
  #badInPlace(where: string, id: number): never {
    const box = new Float32Array(this.width);
    this.get(id, box);
    badBox(where, id, box, this.dimensions);
  }

  /** A view of staged boxes. Two arrays take turns in the kernel, so the last two views are kept. */
  #stagedView(at: number, length: number, single: boolean): Float32Array | Float64Array {
    const views = this.#stagedViews;
    const kind = single ? Float32Array : Float64Array;
    for (let k = 0; k < views.length; k++) {
      const view = views[k]!;
      if (view.byteOffset === at && view.length === length && view instanceof kind) return view;
    }
    const view = new kind(this.kernel.memory.buffer, at, length);
    if (views.push(view) > 2) views.shift();
    return view;
  }

  /** A box that cannot wait: it may fail, or a view of the boxes is open that has to show it. */
  private takeNow(): void {
    if (!this.#viewIsOpen) this.#view = undefined;
    this.flush();
  }
}

function* each(pairs: Uint32Array): IterableIterator<[a: number, b: number]> {
  for (let k = 0; k < pairs.length; k += 2) yield [pairs[k]!, pairs[k + 1]!];
}

/** Finds what is wrong with the arguments of `set`. */
function badSet(
  given: number,
  id: unknown,
  a: unknown,
  b: unknown,
  c: unknown,
  d: unknown,
  e: unknown,
  f: unknown,
  dimensions: 2 | 3,
): never {
  if (!isId(id)) badId('set', id);
  if (given !== 1 + 2 * dimensions) badCount('set', id, given, dimensions);
  badBox('set', id, [a, b, c, d, e, f], dimensions);
}

/** Finds what is wrong with the arguments of `setSwept`. */
function badSwept(id: unknown, given: readonly unknown[], dimensions: 2 | 3): never {
  if (!isId(id)) badId('setSwept', id);
  badQuestion('setSwept', given, dimensions === 2 ? sweep2 : sweep3, 'a number');
}

function checkBoolean(what: string, value: unknown): void {
  if (typeof value !== 'boolean') badValue(what, value, 'true or false', true);
}

const areNumbers = (a: unknown, b: unknown, c: unknown = 0, d: unknown = 0, e: unknown = 0, f: unknown = 0): boolean =>
  typeof a === 'number' &&
  typeof b === 'number' &&
  typeof c === 'number' &&
  typeof d === 'number' &&
  typeof e === 'number' &&
  typeof f === 'number';

function noEvents(what: string): never {
  throw new Error(`${what}: this space records no events, expected one made with new BroadPhase({ events: true })`);
}

const isBuilt = (technique: number): boolean => (builtTechniques() & (1 << technique)) !== 0;

function checkDimensions(dimensions: Dimensions): void {
  if (builtDimensions.includes(dimensions)) return;
  const more = builtDimensions.length > 1 ? '' : ": 'broadphase' has both 2 and 3";
  badValue('dimensions', dimensions, `${builtDimensions.join(' or ')}${more}`);
}

function checkTechnique(name: unknown): void {
  const technique = techniques.indexOf(name as TechniqueName);
  if (technique >= 0 && isBuilt(technique)) return;
  const more = technique < 0 ? '' : ": the others are in 'broadphase/all'";
  badValue('technique', name, `one of ${BroadPhase.techniques.join(', ')}${more}`, typeof name !== 'string');
}

/** Options that no technique of this build looks at: those who have them are in `broadphase/all`. */
function checkHeeded(options: Record<string, unknown>): void {
  if (isBuilt(techniques.indexOf('spatial-grid'))) return;
  for (const [name, value] of Object.entries(options)) {
    if (value === undefined) continue;
    badValue(name, value, "it to be left out: the techniques that use it are in 'broadphase/all'");
  }
}

const isBoxCount = (count: unknown): boolean =>
  Number.isInteger(count) && Number(count) >= 0 && Number(count) <= maxId + 1;

// Made once: a text of every call would be garbage in each frame.
const boxCounts = `an integer from 0 to ${maxId + 1}`;

function checkBoxCount(what: string, count: unknown): void {
  if (typeof count !== 'number') badValue(what, count, boxCounts, true);
  if (!isBoxCount(count)) badValue(what, count, boxCounts);
}

/** One positive number per axis. */
function checkCellSize(cellSize: number | readonly number[], dimensions: 2 | 3): readonly number[] {
  const sizes = Array.isArray(cellSize) ? cellSize : new Array<unknown>(dimensions).fill(cellSize);
  const expected = `a number above 0, or ${dimensions} of them, one per axis`;
  if (sizes.length !== dimensions) badValue('cellSize', cellSize, expected);
  for (const size of sizes) {
    if (typeof size !== 'number') badValue('cellSize', cellSize, expected, true);
    if (!(size > 0 && size < Number.POSITIVE_INFINITY)) badValue('cellSize', cellSize, expected);
  }
  return sizes as number[];
}

function checkMargin(margin: unknown): void {
  const expected = 'a number above 0';
  if (typeof margin !== 'number') badValue('margin', margin, expected, true);
  if (!(margin > 0 && margin < Number.POSITIVE_INFINITY)) badValue('margin', margin, expected);
}

function checkBounds(bounds: readonly number[], dimensions: 2 | 3): void {
  const expected = `${2 * dimensions} finite numbers: minima, then larger maxima`;
  if (!Array.isArray(bounds)) badValue('bounds', bounds, expected, true);
  let good = bounds.length === 2 * dimensions && bounds.every(Number.isFinite);
  for (let a = 0; a < dimensions; a++) good &&= bounds[a]! < bounds[a + dimensions]!;
  if (!good) badValue('bounds', bounds, expected);
}

/** How many boxes an array holds, which must be a whole number of them. */
export function countBoxes(where: string, boxes: Boxes, dimensions: 2 | 3): number {
  const width = 2 * dimensions;
  if (boxes.length % width !== 0) {
    badValue(`${where}: length`, boxes.length, `a multiple of ${width}, the numbers of a box in ${dimensions}D`);
  }
  return (boxes.length / width) | 0; // as an integer: a double out of a call would be garbage
}

/** Each number of the first `count` boxes of an array really is one; what it is worth the kernel checks. */
function checkNumbers(where: string, boxes: ArrayLike<unknown>, count: number, dimensions: 2 | 3): void {
  const width = 2 * dimensions;
  for (let k = 0; k < count * width; k++) {
    if (typeof boxes[k] === 'number') continue;
    const id = Math.floor(k / width);
    badBox(where, id, Array.prototype.slice.call(boxes, id * width, (id + 1) * width), dimensions);
  }
}
