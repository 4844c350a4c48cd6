// For engines that report when two boxes begin and cease to touch: the pairs that touch now. To engines, boxes within a
// margin touch too, so `find` tests each pair.
import { PairList } from './pair-list.mjs';

export class Contacts {
  #keys = new Set();
  #list = new PairList();

  begin(a, b) {
    this.#keys.add(keyOf(a, b));
  }

  end(a, b) {
    this.#keys.delete(keyOf(a, b));
  }

  /** Finds which of the pairs overlap among the boxes of this frame, and returns how many. */
  find(boxes, dimensions) {
    const stride = 2 * dimensions;
    this.#list.clear();
    for (const key of this.#keys) {
      const a = Math.floor(key / shift);
      const b = key % shift;
      let apart = false;
      for (let i = stride * a, j = stride * b, axis = 0; axis < dimensions; axis++, i++, j++) {
        apart ||= boxes[i] > boxes[j + dimensions] || boxes[j] > boxes[i + dimensions];
      }
      if (!apart) this.#list.add(a, b);
    }
    return this.#list.count;
  }

  pairs() {
    return this.#list.pairs();
  }
}

const shift = 2 ** 24;

const keyOf = (a, b) => (a < b ? a * shift + b : b * shift + a);
