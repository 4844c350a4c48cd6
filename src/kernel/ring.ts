// Boxes that were set and wait to be taken by the kernel, in its memory: see kernel/boxes/ring.hpp. Why: a call into
// WebAssembly for each box would take several times as long as writing it.
// A box may wait where taking it cannot fail: its id is in the space, or the next one that there is room for.
import { ringCapacity, ringHead } from '../generated/abi.ts';
import type { KernelInstance } from './instance.ts';

/** Behind the last word of any memory. */
const nowhere = 2 ** 30;

export class Ring {
  readonly #instance: KernelInstance;
  /** Numbers in a box. */
  readonly width: number;
  /** Of each box that waits its id, then its numbers. */
  numbers = new Float64Array();
  /** Where the next one goes. */
  next = ringHead;
  /** The ids below this are in the space, once all that wait are taken; 0 where that is not known. */
  dense = 0;
  #room = 0;
  /** Where the kernel's table of pages of ids stands among its words: see kernel/boxes/ids.hpp. */
  #pages = nowhere;

  constructor(instance: KernelInstance) {
    this.#instance = instance;
    this.width = instance.width;
  }

  /** Whether there is a box of this id; false also where only the kernel can say. */
  knows(id: number): boolean {
    if (id < this.dense) return true;
    const page = this.#page(id);
    return page > 0 && this.#instance.words[(page >>> 2) + (id & 4095)]! > 0;
  }

  /**
   * Whether a box of an id from `dense` on may wait, since taking it cannot fail. Asked once for each box that will.
   */
  mayWait(id: number): boolean {
    if (id !== this.dense || this.#room === 0) {
      return this.#page(id) > 0;
    }
    this.dense++;
    this.#room--;
    return true;
  }

  /** The page of ids that an id is in. Where growing memory has cut the view off nothing is found. */
  #page(id: number): number {
    return this.#instance.words[this.#pages + 2 * (id >>> 12)]!;
  }

  /** Nothing is known any more of what may wait: to be called after what adds boxes or takes them away. */
  forget(): void {
    this.dense = this.#room = 0;
    this.#pages = nowhere;
  }

  /** The kernel takes what waits. */
  flush(): void {
    const instance = this.#instance;
    const count = (this.next - ringHead) / (this.width + 1);
    this.next = ringHead;
    this.forget();
    try {
      instance.exports.take(count);
    } catch (error) {
      instance.recover(error, 'set');
    }
    if (this.numbers.length === 0) this.#open();
    // As integers: doubles would be garbage.
    this.dense = this.numbers[0]! | 0;
    this.#room = this.numbers[1]! | 0;
    if (this.numbers[2]! > 0) {
      this.#pages = (this.numbers[2]! / 4) | 0;
      instance.wordView();
    }
  }

  /** The ring is full, or was cut off as memory grew; gives where the next box goes. */
  drain(): number {
    if (this.next !== ringHead) this.flush();
    if (this.numbers.length === 0) this.#open();
    return ringHead;
  }

  /** What waits is lost, with the memory it stands in. */
  close(): void {
    this.next = ringHead;
    this.numbers = new Float64Array();
    this.forget();
  }

  #open(): void {
    const { exports } = this.#instance;
    this.numbers = new Float64Array(
      exports.memory.buffer,
      exports.ring_address(),
      ringHead + ringCapacity * (this.width + 1),
    );
  }
}
