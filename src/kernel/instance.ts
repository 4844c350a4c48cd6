// One instance of the kernel, which is one space: its functions, views of its memory, and recovery when memory runs
// out. Growing memory detaches views: their length is then 0, and they are made again.
import type { Dimensions } from '../dimensions.ts';
import { badValue, checkNumberArray } from '../errors.ts';
import { ioLength, type KernelExports, statsLength } from '../generated/abi.ts';
import type { Kept } from '../pairs-between.ts';
import type { RayHit } from '../query-options.ts';
import type { Stats } from '../stats.ts';
import type { Watcher } from '../watch.ts';
import { instantiate } from './load.ts';
import { Ring } from './ring.ts';

/** How many views are cached, so that recent pair counts make no garbage. */
const viewsKept = 256;
/** The most worlds that a ray or a sweep may cross if the world wraps around: each costs a search. */
const mostWorlds = 1000;

export class KernelInstance {
  readonly dimensions: Dimensions;
  /** Numbers in a box. */
  readonly width: number;
  /** The size of the world if it wraps around. */
  readonly wrap: readonly number[] | undefined;
  /** How far a ray or a sweep may go: unlimited unless the world wraps around. */
  readonly farthest: number;
  /** Whether boxes that only touch overlap. */
  readonly touching: boolean;
  /** What uses each of the kernel's sets of lists: see pairs-between.ts. */
  neighbours: { used: number }[] = [];
  /** The kernel's functions, without flushing the ring first. */
  exports: KernelExports;
  readonly ring: Ring;
  /** The kernel's memory, as of the last call of `wordView`. */
  words = new Uint32Array();
  private doubles = new Float64Array();
  private numbers = new Float64Array();
  /** The array that `boxes()` returned last, while it is in use. */
  exposed: Float32Array | undefined;
  /** Whether it may have been written since the last update: then detaching it by growing memory must be noticed. */
  exposedIsOpen = false;
  /** The number of the selected technique. */
  technique = 0;
  /** Whether updates determine which pairs began and ended. */
  readonly events: boolean;
  /** The counters, once somebody has asked for them. */
  stats: Stats | undefined;
  /** Called after each update: see watch.ts. */
  watcher: Watcher | undefined;
  /** Spare hit objects, from answers that were shorter than the one before, to reuse in a longer one. */
  readonly spare: RayHit[] = [];
  /** Pairs with other spaces: see pairs-between.ts. */
  readonly kept = new WeakMap<KernelInstance, Kept>();
  // Cached views: of pairs by their count, of boxes that are staged, of the counters.
  private pairs: Uint32Array[][] = [];
  private staged: (Float32Array | Float64Array)[] = [];
  private counters = new Float64Array();
  /** Where the kernel's stack begins, to go back to after an exception. */
  private readonly top: number;
  private asked = false; // whether there has been a query
  private losses = 0; // how often memory has run out

  constructor(dimensions: Dimensions, wrap: readonly number[] | undefined, touching: boolean, events: boolean) {
    this.dimensions = dimensions;
    this.wrap = wrap;
    this.farthest = wrap === undefined ? Number.POSITIVE_INFINITY : mostWorlds * Math.min(...wrap);
    this.touching = touching;
    this.events = events;
    this.width = 2 * dimensions;
    this.exports = instantiate(dimensions);
    this.ring = new Ring(this);
    this.top = this.exports.__stack_pointer.value;
    this.exports.open_space(dimensions);
  }

  /** The kernel's functions, after flushing the ring, so that no caller can forget that. */
  get kernel(): KernelExports {
    if (this.ring.next !== 0) this.ring.close();
    return this.exports;
  }

  /** The same for functions that never grow memory: the ring stays open, so that the next `set` is as fast as others. */
  get reader(): KernelExports {
    this.ring.flush();
    return this.exports;
  }

  /**
   * The same for queries. They see the last update, so boxes that wait go on waiting; `ring.follow` has to be called
   * afterwards. Before the first query boxes are flushed, so that one that comes too late always throws.
   */
  get asker(): KernelExports {
    if (this.asked) return this.exports;
    this.asked = true;
    return this.kernel;
  }

  /** The number of boxes. */
  get size(): number {
    return this.ring.dense > 0 ? this.ring.dense : this.reader.size();
  }

  get isDisposed(): boolean {
    return this.exports === disposed;
  }

  /** Lets go of the memory. Any call after this throws. */
  dispose(): void {
    this.exports = disposed;
    this.ring.dispose();
    this.words = new Uint32Array();
    this.doubles = this.numbers = this.counters = new Float64Array();
    this.exposed = undefined;
    this.pairs = [];
    this.neighbours = [];
    this.staged = [];
  }

  setTechnique(technique: number): void {
    this.kernel.set_technique(technique);
    this.technique = technique;
  }

  /** Removes a box; returns whether there was one. */
  remove(id: number): boolean {
    if (!this.exposedIsOpen) this.exposed = undefined;
    try {
      const { kernel } = this;
      this.ring.forget();
      return kernel.remove(id) === 1;
    } catch (error) {
      this.recover(error, 'delete');
    }
  }

  clear(): void {
    try {
      this.kernel.clear();
    } catch (error) {
      this.recover(error, 'clear'); // with events, deleted boxes are recorded first
    }
    this.ring.forget();
    this.exposed = undefined;
  }

  /** The kernel's array for numbers in and out. */
  io(): Float64Array {
    if (this.numbers.length === 0) {
      this.numbers = new Float64Array(this.exports.memory.buffer, this.exports.io_address(), ioLength);
    }
    return this.numbers;
  }

  /** The kernel's memory. */
  wordView(): Uint32Array {
    if (this.words.length === 0) this.words = new Uint32Array(this.exports.memory.buffer);
    return this.words;
  }
  doubleView(): Float64Array {
    if (this.doubles.length === 0) this.doubles = new Float64Array(this.exports.memory.buffer);
    return this.doubles;
  }

  /** Stays the same while the answers of a query do. */
  get turn(): number {
    return this.exports.updates() + this.losses;
  }

  /** The counters of the last update. */
  statsView(): Float64Array {
    if (this.counters.length === 0) {
      this.counters = new Float64Array(this.exports.memory.buffer, this.exports.stats_address(), statsLength);
    }
    return this.counters;
  }

  /**
   * Copies the first `length` numbers of an array into the kernel's memory. Getters of it may not use the space, which
   * could move that memory.
   */
  copyIn(where: string, to: Float32Array | Float64Array, at: number, numbers: ArrayLike<number>, length: number): void {
    if (numbers.length < length) {
      checkNumberArray(where, numbers); // it was this space's memory, which has grown
      badValue(`${where}: length`, numbers.length, `${length}`);
    }
    this.ring.view(); // a getter may set a box, which waits there
    const { exports } = this;
    // Neither `subarray` nor `slice`: they call the constructor of a subclass, which may expect anything.
    if (!ArrayBuffer.isView(numbers)) this.exports = busy;
    else if (numbers.length > length) {
      const { buffer, byteOffset } = numbers as Float64Array<ArrayBuffer>;
      numbers = new (to.constructor as Float64ArrayConstructor)(buffer, byteOffset, length); // they are of one kind
    }
    try {
      if (numbers.length === length) to.set(numbers, at);
      else for (let k = 0; k < length; k++) to[at + k] = numbers[k]!;
    } finally {
      if (this.exports === busy) this.exports = exports; // else it was disposed
    }
  }

  /** A view of staged boxes. Three arrays take turns in the kernel, so the last three views are kept. */
  stagedView(at: number, length: number, single: boolean): Float32Array | Float64Array {
    const views = this.staged;
    const kind = single ? Float32Array : Float64Array;
    for (let k = 0; k < views.length; k++) {
      const view = views[k]!;
      if (view.byteOffset === at && view.length === length && view instanceof kind) return view;
    }
    const view = new kind(this.kernel.memory.buffer, at, length);
    if (views.push(view) > 3) views.shift();
    return view;
  }

  /** A view of pairs in the kernel's memory, from the cache for this list if possible. */
  pairView(list: number, address: number, count: number): Uint32Array {
    this.pairs[list] ??= [];
    const views = this.pairs[list]!;
    // A WebAssembly address is signed in JavaScript, and 0 if there was never a pair: then any other will do.
    const at = address >>> 0 || 4;
    let view = views[count % viewsKept];
    // A detached view has the offset 0. Asking the memory for its buffer would take as long as all the rest.
    if (view?.byteOffset !== at || view.length !== 2 * count) {
      view = new Uint32Array(this.exports.memory.buffer, at, 2 * count);
      views[count % viewsKept] = view;
    }
    return view;
  }

  /** After an exception from the kernel: makes the space usable again, and throws an error that says what was wrong. */
  recover(error: unknown, where: string): never {
    if (!this.isDisposed) {
      this.exports.__stack_pointer.value = this.top; // the end of the stack is no RuntimeError
      this.ring.follow();
    }
    if ((error as Error | undefined)?.name !== 'RuntimeError') throw error;
    if (this.exports.recover() === 0) throw error;
    this.ring.close();
    this.losses++; // the index for queries is lost
    throw new RangeError(
      `${where}: out of memory: ${this.io()[0]} more bytes are needed for ${this.size} boxes and their pairs, ` +
        'more than WebAssembly (4 GiB) or this host allows',
      { cause: error },
    );
  }
}

/** Stands in for a kernel that cannot be used. */
const refuse = (why: string) =>
  new Proxy({} as KernelExports, {
    get() {
      throw new Error(`this BroadPhase was ${why}`);
    },
  });
const disposed = refuse('disposed and can no longer be used');
const busy = refuse('used by a getter of its input');
