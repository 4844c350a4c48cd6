// What every face of a space stands on: its kernel, the views of the kernel's memory, and what to do when that ends.
// BroadPhase is a Space that takes boxes and gives pairs; Queries, in between, asks questions.
import { instantiate, type KernelExports } from './kernel.ts';

/** A number of views kept, so that pair counts seen lately make no garbage. */
const viewsKept = 256;

/** One instance of the kernel. Users meet it as BroadPhase. */
export abstract class Space {
  /** How many axes the boxes have, as the constructor was told. */
  readonly dimensions: 2 | 3;

  /** @internal */
  protected kernel: KernelExports;
  /** Numbers in a box. @internal */
  protected readonly width: number;
  /** Whether the world wraps around. @internal */
  protected readonly wraps: boolean;
  readonly #stackTop: number;
  #io = new Float64Array();

  constructor(dimensions: 2 | 3, wraps: boolean) {
    this.dimensions = dimensions;
    this.wraps = wraps;
    this.width = 2 * dimensions;
    this.kernel = instantiate();
    this.#stackTop = this.kernel.__stack_pointer.value;
    this.kernel.open_space(dimensions);
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
    return this.kernel.size();
  }

  /** Lets go of the memory at once; it also goes with the object. Any call after this throws. */
  dispose(): void {
    this.kernel = disposed;
    this.#io = new Float64Array();
  }

  /** The kernel's array for numbers in and out. Growing memory cuts views off: their length is then 0. @internal */
  protected io(): Float64Array {
    if (this.#io.length === 0) this.#io = new Float64Array(this.kernel.memory.buffer, this.kernel.io_address(), 16);
    return this.#io;
  }

  /** A view of pairs in the kernel's memory, from among those made before if possible. @internal */
  protected pairView(views: Uint32Array[], address: number, count: number): Uint32Array {
    const at = address >>> 0; // a WebAssembly address is signed to JavaScript
    const { buffer } = this.kernel.memory;
    let view = views[count % viewsKept];
    if (view?.buffer !== buffer || view.byteOffset !== at || view.length !== 2 * count) {
      view = new Uint32Array(buffer, at, 2 * count);
      views[count % viewsKept] = view;
    }
    return view;
  }

  /** After an exception out of the kernel: makes the space usable again and says what was wrong. @internal */
  protected recover(error: unknown, where: string): never {
    if (!(error instanceof WebAssembly.RuntimeError)) throw error;
    this.kernel.__stack_pointer.value = this.#stackTop;
    if (this.kernel.recover() === 0) throw error;
    throw new RangeError(
      `${where}: out of memory: ${this.io()[0]} bytes more for ${this.size} boxes and their pairs, expected no ` +
        'more than WebAssembly allows (4 GiB) or this host can give',
      { cause: error },
    );
  }
}

/** Stands in for the kernel of a disposed space. */
const disposed = new Proxy({} as KernelExports, {
  get() {
    throw new Error('this BroadPhase was disposed: it cannot be used any more');
  },
});
