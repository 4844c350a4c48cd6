// Boxes that were set and wait in the kernel's memory until it takes them: see kernel/boxes/ring.hpp. A call into
// WebAssembly for each box would take several times as long as writing it. A box may wait if taking it cannot fail: its
// id is in the space, or is the next one that there is room for.
import { ringCapacity, ringHead } from '../generated/abi.ts';
import type { KernelInstance } from './instance.ts';

/** An index beyond the last word of any memory. */
const nowhere = 2 ** 30;

export class Ring {
  readonly #instance: KernelInstance;
  /** Numbers in a box. */
  readonly width: number;
  /** For each box that waits, its id, then its numbers. */
  numbers = new Float64Array();
  /** Where the next box goes. */
  next = ringHead;
  /** All ids below this are in the space, once waiting boxes are taken; 0 if that is not known. */
  dense = 0;
  #room = 0;
  /** The index of the kernel's table of id pages in its memory: see kernel/boxes/ids.hpp. */
  #pages = nowhere;

  constructor(instance: KernelInstance) {
    this.#instance = instance;
    this.width = instance.width;
  }

  /** Whether there is a box of this id; also false if only the kernel knows. */
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

  /** The page of an id. If growing memory has detached the view, nothing is found. */
  #page(id: number): number {
    return this.#instance.words[this.#pages + 2 * (id >>> 12)]!;
  }

  /** Forgets which boxes may wait: called after anything that adds or removes boxes. */
  forget(): void {
    this.dense = this.#room = 0;
    this.#pages = nowhere;
  }

  /** Lets the kernel take the boxes that wait. */
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

  /** Called when the ring is full, or was detached as memory grew; returns where the next box goes. */
  drain(): number {
    if (this.next !== ringHead) this.flush();
    if (this.numbers.length === 0) this.#open();
    return ringHead;
  }

  /** Drops the boxes that wait, with the memory they are in. */
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
