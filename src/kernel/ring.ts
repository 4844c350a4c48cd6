// Boxes that were set and wait in the kernel's memory until it takes them: see kernel/boxes/ring.hpp. A call into
// WebAssembly for each box would take several times as long as writing it. A box may wait if taking it cannot fail: its
// id is in the space, or is the next one that there is room for.
// `BroadPhase.set` writes a box first and asks afterwards, so that it has nothing left to keep across a call. Since a
// call of the kernel may grow its memory, which detaches the ring, the ring is closed before each: the next box is
// written aside and opens it again. Queries leave it open, since they see the last update: it is found again after them.
import { badId, maxId } from '../errors.ts';
import { ringHead } from '../generated/abi.ts';
import type { KernelInstance } from './instance.ts';

/** An index beyond the last word of any memory. */
const nowhere = 2 ** 30;
/** No id. */
const none = -1;
/** The ids of a page. */
const pageLength = 4096;

/** Relative to the numbers involved: more than the roundings of `sweep`, for which see kernel/questions/meeting.hpp. */
const roundings = 2 ** -49;
const isSingle = (x: number) => Math.fround(x) === x;
const sizeOf = (x: number) => (Number.isFinite(x) ? Math.abs(x) * roundings : 0);

export class Ring {
  private readonly instance: KernelInstance;
  /** Numbers per entry: the id, then the box. */
  readonly step: number;
  /** Where the next box goes while the ring is closed. */
  private readonly aside: Float64Array;
  /** What the kernel tells about the ring, and the ring, in the kernel's memory. */
  private told = new Float64Array();
  private entries = new Float64Array();
  /** Where boxes are written: for each its id, then its numbers. */
  numbers: Float64Array;
  /** How far the next box moves, if it does. */
  readonly way = new Float64Array(3);
  /** The index of the next box; 0 if the ring is closed. */
  next = 0;
  /** Boxes of ids below this may wait. */
  limit = 0;
  /** The index of the last box that may wait. */
  last = 0;
  /** All ids below this are in the space, once waiting boxes are taken; 0 if that is not known. */
  dense = 0;
  private room = 0;
  /** The index of the kernel's table of id pages in its memory: see kernel/boxes/ids.hpp. */
  private pages = nowhere;
  /** If ids have gaps: all pages of ids below this exist, so these ids may wait. */
  private paged = 0;

  constructor(instance: KernelInstance) {
    this.instance = instance;
    this.step = instance.width + 1;
    this.numbers = this.aside = new Float64Array(7);
  }

  /** Whether there is a box of this id; also false if only the kernel knows. */
  knows(id: number): boolean {
    if (id < this.dense) return true;
    const page = this.page(id);
    return page > 0 && this.instance.words[(page >>> 2) + (id & (pageLength - 1))]! > 0;
  }

  /**
   * What `set` does, for calls that have checked their numbers: they must not call `set`, which a subclass may override.
   * With `moves`, the box is enlarged by its way.
   */
  put(id: number, a: number, b: number, c: number, d: number, e?: number, f?: number, moves = false): void {
    const { numbers, next } = this;
    numbers[next] = id;
    numbers[next + 1] = a;
    numbers[next + 2] = b;
    numbers[next + 3] = c;
    numbers[next + 4] = d;
    if (this.step === 7) {
      numbers[next + 5] = e!;
      numbers[next + 6] = f!;
    }
    if (moves) this.stretch();
    if (id >= this.limit || next >= this.last) this.settle(id);
    else this.next = next + this.step;
  }

  /**
   * Enlarges the box that was written last by its way, so that it holds all that `sweep` may hit. Of float32 numbers an
   * exact sum is the answer. Others are rounded outward, as `sweep` hits what its own roundings do not tell apart.
   */
  private stretch(): void {
    const { numbers, next, way } = this;
    const axes = this.step >> 1;
    for (let a = 0; a < axes; a++) {
      const by = way[a]!;
      const lo = numbers[next + 1 + a]!;
      const hi = numbers[next + 1 + a + axes]!;
      const from = by < 0 ? lo : hi;
      let to = from + by;
      const isExact = to - from === by && to - by === from && isSingle(by) && isSingle(lo) && isSingle(hi);
      if (!isExact) to += Math.sign(by) * (sizeOf(by) + sizeOf(lo) + sizeOf(hi));
      numbers[next + 1 + a + (by < 0 ? 0 : axes)] = to;
    }
  }

  /**
   * Called after the box of this id was written, if it may not wait without asking, or fills the ring. It counts only at
   * the end of all that can fail, the end of the stack included. With `none`, no box was written: all that wait are
   * flushed.
   * This is one function, too long for V8 to inline it; the copies of a box are written out for that. Otherwise `set`
   * with it would exceed what V8 inlines into a caller that calls other functions too, and then each call of `set`
   * would allocate its numbers.
   */
  settle(id: number): void {
    const { step } = this;
    const instance = this.instance;
    const aside = this.aside;
    let end = this.next;
    if (id !== none) {
      if (id > maxId) badId('set', id);
      const isNext = id === this.dense && this.room > 0;
      const mayWait = isNext || id < this.dense || this.page(id) > 0;
      if (!mayWait && end > step) {
        // Adding it may fail, or an open view of the boxes has to show it: it is flushed after all others.
        const { numbers } = this;
        aside[0] = numbers[end]!;
        aside[1] = numbers[end + 1]!;
        aside[2] = numbers[end + 2]!;
        aside[3] = numbers[end + 3]!;
        aside[4] = numbers[end + 4]!;
        aside[5] = numbers[end + 5]!;
        aside[6] = numbers[end + 6]!;
        this.settle(none);
        this.numbers = aside;
      }
      if (this.numbers === aside) {
        const ring = this.view();
        ring[step] = aside[0]!;
        ring[step + 1] = aside[1]!;
        ring[step + 2] = aside[2]!;
        ring[step + 3] = aside[3]!;
        ring[step + 4] = aside[4]!;
        ring[step + 5] = aside[5]!; // a box in 2D has two numbers fewer: the next one replaces these
        ring[step + 6] = aside[6]!;
        this.numbers = ring;
        this.next = step;
      }
      end = this.next + step;
      if (mayWait && this.next < this.last) {
        this.next = end;
        if (isNext) {
          this.dense++;
          this.room--;
        }
        this.limit = Math.max(this.dense, this.paged);
        return;
      }
      if (!mayWait && !instance.exposedIsOpen) instance.exposed = undefined;
    }
    try {
      instance.exports.take(end / step - 1);
    } catch (error) {
      this.fail(error);
      instance.recover(error, 'set');
    }
    this.reopen();
  }

  /** Flushes the ring and closes it, as the kernel is about to be called. */
  close(): void {
    this.flush();
    this.shut();
  }

  /** Flushes the ring and leaves it open. */
  flush(): void {
    if (this.next > this.step) this.settle(none);
  }

  /** After a call of the kernel during which boxes went on waiting: growing memory has detached the ring. */
  follow(): void {
    if (this.numbers !== this.aside) this.numbers = this.view();
  }

  /** Drops the boxes that wait, with the memory they are in. */
  dispose(): void {
    this.shut();
    this.forget();
    this.told = this.entries = new Float64Array();
  }

  /** Forgets which boxes may wait: called after anything that adds or removes boxes. */
  forget(): void {
    this.limit = this.dense = this.room = this.paged = 0;
    this.pages = nowhere;
  }

  /** Lets an update of the kernel take the boxes that wait. Returns what it returns. */
  update(): number {
    const waiting = this.next / this.step - 1;
    if (waiting <= 0) this.shut();
    try {
      const bad = this.instance.exports.update(Math.max(waiting, 0));
      if (waiting > 0) this.reopen();
      return bad;
    } catch (error) {
      this.fail(error);
      throw error;
    }
  }

  /** After an exception. At the end of the stack, the boxes that were set go on waiting: taking them twice is harmless. */
  private fail(error: unknown): void {
    if ((error as Error | undefined)?.name !== 'RuntimeError') {
      if (this.next > 0) this.numbers = this.view(); // memory may have grown before
      return;
    }
    this.shut();
    this.forget();
  }

  /** After the kernel has emptied the ring: reads which boxes may wait in it, and opens it. */
  private reopen(): void {
    this.forget();
    const ring = this.view();
    const { told } = this;
    // As integers: doubles would be garbage.
    this.dense = told[0]! | 0;
    this.room = told[1]! | 0;
    if (told[2]! > 0) {
      this.pages = (told[2]! / 4) | 0;
      this.instance.wordView();
      while (this.paged <= maxId && this.page(this.paged) > 0) this.paged += pageLength;
    }
    this.last = (told[3]! | 0) * this.step;
    this.numbers = ring;
    this.next = this.step;
    this.limit = Math.max(this.dense, this.paged);
  }

  /** The page of an id. If growing memory has detached the view, nothing is found. */
  private page(id: number): number {
    return this.instance.words[this.pages + 2 * (id >>> 12)]!;
  }

  /** Closes the ring. */
  private shut(): void {
    this.numbers = this.aside;
    this.next = this.limit = 0;
  }

  /** The ring in the kernel's memory. */
  view(): Float64Array {
    const { exports } = this.instance;
    if (this.told.length === 0) this.told = new Float64Array(exports.memory.buffer, exports.ring_address(), ringHead);
    const at = this.told[4]! >>> 0;
    if (this.entries.byteOffset !== at) this.entries = new Float64Array(exports.memory.buffer, at);
    return this.entries;
  }
}
