// What stands in a space, read back as from a Map; and boxes that are given by their centre.
import type { BoxOfId, CentredBoxOfId, Dimensions } from './dimensions.ts';
import { badCentred, badId, isId } from './errors.ts';
import { PairsBetween } from './pairs-between.ts';

/** Whom a box meets: see {@link BroadPhase.setFilter}. */
export interface Filter {
  /** What the box is: 32 bits. */
  layer: number;
  /** Whom it meets: 32 bits. */
  mask: number;
}

/** A space whose boxes can be read back. */
export abstract class Contents<D extends Dimensions> extends PairsBetween<D> {
  abstract set(...box: BoxOfId<D>): this;
  abstract has(id: number): boolean;
  abstract get(id: number): Float64Array | undefined;

  /**
   * The ids of all boxes, in the order of a Map: that in which they were added. Those that `setAll` and `boxes` give come
   * by number. Boxes may be set and deleted meanwhile: those that are gone when their turn comes are left out, new ones
   * are not visited. Takes a copy of all ids.
   *
   * @example
   * const space = new BroadPhase();
   * space.set(9, 0, 0, 1, 1).set(3, 0, 0, 1, 1).set(7, 0, 0, 1, 1).delete(9);
   * [...space.set(9, 5, 5, 6, 6).keys()]; // → [3, 7, 9]
   */
  keys(): IterableIterator<number> {
    return present(this, this.#ids());
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

  /**
   * The layer and the mask that `setFilter` gave box `id`: all bits of both where it gave none, `undefined` where there is
   * no box.
   * @param id an integer from 0 to 2^24 - 1
   * @throws RangeError for a bad id
   *
   * @example
   * const space = new BroadPhase().set(7, 0, 0, 1, 1).setFilter(7, 1, 6);
   * space.filterOf(7); // → { layer: 1, mask: 6 }
   * space.filterOf(8); // → undefined
   */
  filterOf(id: number): Filter | undefined {
    if (!isId(id)) badId('filterOf', id);
    if (this.kernel.get_rule(id) === 0) return undefined;
    const io = this.io();
    return { layer: io[0]!, mask: io[1]! };
  }

  /**
   * Whether box `id` is static, as `setStatic` has it: not where there is none.
   * @param id an integer from 0 to 2^24 - 1
   * @throws RangeError for a bad id
   *
   * @example
   * new BroadPhase().set(7, 0, 0, 1, 1).setStatic(7).isStatic(7); // → true
   */
  isStatic(id: number): boolean {
    if (!isId(id)) badId('isStatic', id);
    return this.kernel.get_rule(id) === 1 && this.io()[2] === 1;
  }

  /**
   * Whether box `id` takes part, as `setEnabled` has it: not where there is none.
   * @param id an integer from 0 to 2^24 - 1
   * @throws RangeError for a bad id
   *
   * @example
   * new BroadPhase().set(7, 0, 0, 1, 1).setEnabled(7, false).isEnabled(7); // → false
   */
  isEnabled(id: number): boolean {
    if (!isId(id)) badId('isEnabled', id);
    return this.kernel.get_rule(id) === 1 && this.io()[3] === 1;
  }

  /**
   * Adds box `id`, or moves it, by its centre and half its size, such as the box of a circle:
   * `setCentred(id, x, y, radius, radius)`. 2D `setCentred(id, x, y, halfWidth, halfHeight)`, 3D
   * `setCentred(id, x, y, z, halfWidth, halfHeight, halfDepth)`. The box is that of the four (six) sums, each rounded as
   * sums are.
   *
   * @param box an id; the centre: finite numbers; half the size along each axis: at least 0
   * @throws RangeError and TypeError that name the id and the number. The space is as before.
   *
   * @example
   * const space = new BroadPhase();
   * space.setCentred(7, 10, 10, 5, 2).get(7); // → Float64Array [5, 8, 15, 12]
   *
   * @example
   * const space = new BroadPhase({ dimensions: 3 });
   * space.setCentred(7, 0, 0, 0, 1, 2, 3).get(7); // → Float64Array [-1, -2, -3, 1, 2, 3]
   */
  setCentred(...box: CentredBoxOfId<D>): this;
  setCentred(id: number, a: number, b: number, c: number, d: number, e?: number, f?: number): this {
    const flat = this.width === 4;
    if (
      // biome-ignore lint/complexity/noArguments: a rest parameter would be an array per call
      arguments.length !== this.width + 1 ||
      !isId(id) ||
      !(Number.isFinite(a) && Number.isFinite(b) && (flat || Number.isFinite(c))) ||
      !(flat ? isSize(c) && isSize(d) : isSize(d) && isSize(e) && isSize(f))
    ) {
      // biome-ignore lint/complexity/noArguments: the same
      badCentred('setCentred', arguments, this.dimensions);
    }
    if (flat) return (this as unknown as Contents<2>).set(id, a - c, b - d, a + c, b + d) as unknown as this;
    const solid = this as unknown as Contents<3>;
    return solid.set(id, a - d, b - e!, c - f!, a + d, b + e!, c + f!) as unknown as this;
  }

  /** All ids, copied, in the order in which they came. */
  #ids(): Uint32Array {
    try {
      const { kernel } = this;
      const count = kernel.list_ids();
      return new Uint32Array(kernel.memory.buffer, kernel.answers_address() >>> 0, count).slice();
    } catch (error) {
      this.recover(error, 'keys');
    }
  }
}

const isSize = (size: unknown): boolean => typeof size === 'number' && size >= 0;

/** Those of some ids that have a box when their turn comes. */
function* present(space: { has(id: number): boolean }, ids: Uint32Array): IterableIterator<number> {
  for (const id of ids) if (space.has(id)) yield id;
}
