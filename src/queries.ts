// What a space can be asked between two updates.
// Everything is answered as of the last update; what the questions need is made at the first after it.
import { badId, checkOut, maxId } from './errors.ts';
import { Space } from './space.ts';

/** A space that answers. Users meet it as BroadPhase. */
export abstract class Queries extends Space {
  #words = new Uint32Array();

  /**
   * Whether boxes `a` and `b` are a pair of the last update: constant time after the first question.
   * @throws RangeError for a bad id
   */
  isColliding(a: number, b: number): boolean {
    if (a >>> 0 !== a || a > maxId) badId('isColliding', a);
    if (b >>> 0 !== b || b > maxId) badId('isColliding', b);
    try {
      return this.kernel.is_pair(a, b) === 1;
    } catch (error) {
      this.recover(error, 'isColliding');
    }
  }

  /**
   * The ids of the boxes that are in a pair with box `id` in the last update, in the order of `pairs`: takes time
   * proportional to the answer, after the first question.
   *
   * @param out filled and returned, if given; else a new array
   * @throws RangeError for a bad id; TypeError where `out` is no array
   */
  collisionsOf(id: number, out: number[] = []): number[] {
    if (id >>> 0 !== id || id > maxId) badId('collisionsOf', id);
    checkOut('collisionsOf', out);
    try {
      return this.#copyIds(this.kernel.partners(id), out);
    } catch (error) {
      this.recover(error, 'collisionsOf');
    }
  }

  override dispose(): void {
    super.dispose();
    this.#words = new Uint32Array();
  }

  /** Copies the first of the kernel's answers. */
  #copyIds(count: number, out: number[]): number[] {
    const words = this.#wordsView();
    const first = this.kernel.answers_address() >>> 2;
    for (let k = 0; k < count; k++) out[k] = words[first + k]!;
    out.length = count;
    return out;
  }

  /** The kernel's memory. */
  #wordsView(): Uint32Array {
    if (this.#words.length === 0) this.#words = new Uint32Array(this.kernel.memory.buffer);
    return this.#words;
  }
}
