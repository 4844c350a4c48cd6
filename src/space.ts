// What every face of a space stands on: its kernel, the views of the kernel's memory, and what to do when that ends.
// BroadPhase is a Space that takes boxes and gives pairs; Queries, in between, asks questions.
import type { Dimensions } from './dimensions.ts';
import { instantiate, type KernelExports } from './kernel.ts';

/** A number of views kept, so that pair counts seen lately make no garbage. */
const viewsKept = 256;

/** Numbers at the beginning of the ring, in which the kernel says what may wait there: see kernel/boxes/ring.hpp. */
const ringHead = 3;
const ringBoxes = 512;
/** Numbers in the kernel's array: see kernel/abi.cpp. */
export const ioLength = 48;
/** Through how many worlds a ray or a way may lead, where they wrap around: each costs a search. */
const mostWorlds = 1000;
/** Behind the last word of any memory. */
const nowhere = 2 ** 30;

/** One instance of the kernel. Users meet it as BroadPhase. */
export abstract class Space<D extends Dimensions> {
  /** How many axes the boxes have, as the constructor was told. */
  readonly dimensions: D;

  #own: KernelExports;
  /** Boxes that wait to be taken by the kernel, in its memory: of each its id, then its numbers. @internal */
  protected ring = new Float64Array();
  /** Where the next one goes. @internal */
  protected next = ringHead;
  /** The ids below this are in the space, once all that wait are taken; 0 where that is not known. @internal */
  protected dense = 0;
  #room = 0;
  /** Where the kernel's table of pages of ids stands among its words: see kernel/boxes/ids.hpp. */
  #pages = nowhere;
  #words = new Uint32Array();
  /** Numbers in a box. @internal */
  protected readonly width: number;
  /** The size of the world, where it wraps around. @internal */
  protected readonly wrap: readonly number[] | undefined;
  /** How far a ray or a way may lead: without an end, but where the world wraps around. @internal */
  protected readonly farthest: number;
  /** Whether boxes that only touch overlap. @internal */
  protected readonly touching: boolean;
  readonly #stackTop: number;
  #io = new Float64Array();

  constructor(dimensions: D, wrap: readonly number[] | undefined, touching: boolean) {
    this.dimensions = dimensions;
    this.wrap = wrap;
    this.farthest = wrap === undefined ? Number.POSITIVE_INFINITY : mostWorlds * Math.min(...wrap);
    this.touching = touching;
    this.width = 2 * dimensions;
    this.#own = instantiate();
    this.#stackTop = this.kernel.__stack_pointer.value;
    this.kernel.open_space(dimensions);
  }

  /** Frameworks that wrap what they hold in proxies, such as Vue, leave alone what is no plain object by this name. */
  get [Symbol.toStringTag](): string {
    return 'BroadPhase';
  }

  /**
   * The number of boxes.
   *
   * @example
   * const space = new BroadPhase();
   * space.set(7, 0, 0, 1, 1);
   * space.size; // → 1
   */
  get size(): number {
    return this.dense > 0 ? this.dense : this.kernel.size();
  }

  /** The kernel, which knows of all that was set: whoever calls it cannot forget to tell it. @internal */
  protected get kernel(): KernelExports {
    if (this.next !== ringHead) this.flush();
    return this.#own;
  }

  /** @internal */
  protected get disposed(): boolean {
    return this.kernel === disposed;
  }

  /** Lets go of the memory at once; it also goes with the object. Any call after this throws. */
  dispose(): void {
    this.#own = disposed;
    this.next = ringHead;
    this.ring = new Float64Array();
    this.forget();
    this.#io = new Float64Array();
  }

  /** Whether there is a box of this id. @internal */
  protected knows(id: number): boolean {
    if (id < this.dense) return true;
    const page = this.#words[this.#pages + 2 * (id >>> 12)]!;
    if (page > 0 && this.#words[(page >>> 2) + (id & 4095)]! > 0) return true;
    return this.kernel.has(id) === 1;
  }

  /**
   * Whether a box of an id from `dense` on may wait in the ring, since taking it cannot fail. Asked once for each box
   * that will.
   * @internal
   */
  protected mayWait(id: number): boolean {
    if (id !== this.dense || this.#room === 0) {
      // Where growing memory has cut the view off nothing is found, and the box is taken at once.
      return this.#words[this.#pages + 2 * (id >>> 12)]! > 0;
    }
    this.dense++;
    this.#room--;
    return true;
  }

  /** Nothing is known any more of what may wait: to be called after what adds boxes or takes them away. @internal */
  protected forget(): void {
    this.dense = this.#room = 0;
    this.#pages = nowhere;
  }

  /** The kernel takes what waits. @internal */
  protected flush(): void {
    const own = this.#own;
    const count = (this.next - ringHead) / (this.width + 1);
    this.next = ringHead;
    this.forget();
    try {
      own.take(count);
    } catch (error) {
      this.recover(error, 'set');
    }
    if (this.ring.length === 0) this.#openRing();
    // As integers: doubles would be garbage.
    this.dense = this.ring[0]! | 0;
    this.#room = this.ring[1]! | 0;
    if (this.ring[2]! > 0) {
      this.#pages = (this.ring[2]! / 4) | 0;
      if (this.#words.length === 0) this.#words = new Uint32Array(own.memory.buffer);
    }
  }

  /** The ring is full, or was cut off as memory grew; gives where the next box goes. @internal */
  protected drain(): number {
    if (this.next !== ringHead) this.flush();
    if (this.ring.length === 0) this.#openRing();
    return ringHead;
  }

  #openRing(): void {
    const own = this.#own;
    this.ring = new Float64Array(own.memory.buffer, own.ring_address(), ringHead + ringBoxes * (this.width + 1));
  }

  /** The kernel's array for numbers in and out. Growing memory cuts views off: their length is then 0. @internal */
  protected io(): Float64Array {
    if (this.#io.length === 0) {
      this.#io = new Float64Array(this.kernel.memory.buffer, this.kernel.io_address(), ioLength);
    }
    return this.#io;
  }

  /** A view of pairs in the kernel's memory, from among those made before if possible. @internal */
  protected pairView(views: Uint32Array[], address: number, count: number): Uint32Array {
    // A WebAssembly address is signed to JavaScript, and 0 where there was never a pair: then any other will do.
    const at = address >>> 0 || 4;
    let view = views[count % viewsKept];
    // A view that was cut off stands at 0. To ask the memory for its buffer takes as long as all the rest.
    if (view?.byteOffset !== at || view.length !== 2 * count) {
      view = new Uint32Array(this.kernel.memory.buffer, at, 2 * count);
      views[count % viewsKept] = view;
    }
    return view;
  }

  /** After an exception out of the kernel: makes the space usable again and says what was wrong. @internal */
  protected recover(error: unknown, where: string): never {
    if ((error as Error | undefined)?.name !== 'RuntimeError') throw error;
    this.kernel.__stack_pointer.value = this.#stackTop;
    if (this.kernel.recover() === 0) throw error;
    throw new RangeError(
      `${where}: out of memory: ${this.io()[0]} more bytes are needed for ${this.size} boxes and their pairs, which is ` +
        'more than WebAssembly (4 GiB) or this host allows',
      { cause: error },
    );
  }
}

/** Stands in for the kernel of a disposed space. */
const disposed = new Proxy({} as KernelExports, {
  get() {
    throw new Error('this BroadPhase was disposed and can no longer be used');
  },
});
