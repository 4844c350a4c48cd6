// The pairs of two spaces, such as a level at rest and what moves in it.
// Idea: the pairs are kept. What an update has changed (kernel/changed_ids.hpp) loses its pairs and gets them anew. Of the
// space with fewer boxes each box that moves has a list of what is near in the other: what overlaps its box when that was
// grown. While it stays within the grown box, its pairs are among these. A box of the other space that changes is loose:
// it counts in no list, and asks for itself in each call. Where many are loose all lists are made anew.
// Cost of a call: about 50 ns for each box that moved within its grown box, one question for each that left it and for each
// that is loose, and a pass over the pairs.
import { known } from './answers.ts';
import type { BroadPhase } from './broad-phase.ts';
import { BulkQueries } from './bulk-queries.ts';
import type { Dimensions } from './dimensions.ts';
import { badValue } from './errors.ts';
import { grow, Kept, meet, reachOut, roomFor, rowMore, type Side } from './kept-pairs.ts';
import { everything, nobody } from './query-options.ts';

const where = 'pairsWith';
/** What the kernel is asked: the boxes that overlap a box, and that it meets by its filter. Answers are slots. */
const meeting = 8;

/** A space that knows its pairs with others. */
export abstract class PairsBetween<D extends Dimensions> extends BulkQueries<D> {
  readonly #kept = new WeakMap<object, Kept>();

  /**
   * Every pair of a box here and a box of another space, `[here0, there0, here1, there1, …]`, as of the last update of
   * each: such as of a level at rest and of what moves in it. Kept from call to call, at the cost of what has changed since.
   * Filters and reaches count as between boxes of one space, boxes that are off are in no pair, and which are static or in
   * a group makes no difference. The order depends on the calls made. The array stays as it is until the next call.
   *
   * @param other a space of as many dimensions, and of the same `wrap` and `touching`
   * @throws TypeError for what is no other space; RangeError for one with another of these; Error for
   *   one that was disposed of, and as questions do: see {@link BroadPhase}
   *
   * @example
   * const level = new BroadPhase().set(0, 0, 0, 10, 1).set(1, 10, 0, 20, 1).update();
   * const movers = new BroadPhase().set(7, 9, 1, 11, 3).update();
   * movers.pairsWith(level); // → Uint32Array [7, 0, 7, 1]
   * movers.set(7, 5, 1, 6, 3).update().pairsWith(level); // → Uint32Array [7, 0]
   */
  pairsWith(other: BroadPhase<D>): Uint32Array {
    this.#checkOther(other);
    let kept = this.#kept.get(other);
    if (kept === undefined) {
      kept = new Kept(this.width, this.touching);
      this.#kept.set(other, kept);
    }
    try {
      if (kept.begin(this.kernel.size(), other.kernel.size())) this.#keep(kept, other);
      else other.#keep(kept, this);
    } catch (error) {
      kept.forget();
      throw error;
    }
    return kept.view();
  }

  #checkOther(other: BroadPhase<D>): void {
    if (!(other instanceof PairsBetween)) badValue(where, other, 'another BroadPhase', true);
    if ((other as unknown) === this) {
      throw new TypeError(`${where}: got the space itself, expected another: the pairs within it are in its pairs`);
    }
    this.kernel.size(); // throws where this one was disposed of
    if (other.disposed) throw new Error(`${where}: the other BroadPhase was disposed and can no longer be used`);
    if (other.dimensions !== this.dimensions) {
      badValue(`${where}: dimensions of the other`, other.dimensions, `${this.dimensions} as here`);
    }
    if (String(other.wrap) !== String(this.wrap)) {
      badValue(
        `${where}: wrap of the other`,
        other.wrap,
        `${this.wrap ? `[${this.wrap.join(', ')}]` : 'none'} as here`,
      );
    }
    if (other.touching !== this.touching) {
      badValue(`${where}: touching of the other`, other.touching, `${this.touching} as here`);
    }
  }

  /** Brings the pairs up to date, of this space, which has fewer boxes, and another. */
  #keep(kept: Kept, other: PairsBetween<D>): void {
    const { few, many } = kept;
    const followed = this.#follow(few, kept.call);
    const same = other.#follow(many, kept.call);
    if (followed && same && few.count + many.count === 0) return;
    if (!same) kept.dropLists();
    kept.loosen(this.kernel.seen_count());
    if (followed && same) {
      kept.dropPairs();
    } else {
      kept.length = 0;
      few.takeAll(this.kernel.seen_count());
    }
    this.#askFew(kept, other);
    other.#askLoose(kept, this);
  }

  /** Finds out what has changed since the call before; false where all may have. */
  #follow(side: Side, call: number): boolean {
    try {
      const { kernel } = this;
      const epoch = known(where, kernel.log_epoch());
      return side.read(epoch, this.wordView(), kernel.log_address() >>> 2, kernel.log_count(), call);
    } catch (error) {
      this.recover(error, where);
    }
  }

  /**
   * Reads what the last update saw of so many slots, those given or else those that the kernel's answers begin with: rows in
   * the kernel's memory, of which this is the place.
   */
  #see(count: number, slots?: Uint32Array): number {
    try {
      const { kernel } = this;
      const stride = this.width + rowMore;
      const at = kernel.stage_questions(count * stride) >>> 3;
      const rows = this.doubleView();
      const from = slots ?? this.wordView();
      const first = slots ? 0 : kernel.many_ids_address() >>> 2;
      for (let k = 0; k < count; k++) rows[at + k * stride] = from[first + k]!;
      kernel.see_rows(count);
      return at;
    } catch (error) {
      this.recover(error, where);
    }
  }

  /** The pairs of the boxes here that have changed: out of their lists, or asked for. */
  #askFew(kept: Kept, other: PairsBetween<D>): void {
    const { few, lists } = kept;
    if (few.count === 0) return;
    const stride = this.width + rowMore;
    const listed = this.wrap === undefined; // where the world wraps around only the kernel tests exactly
    const at = this.#see(few.count, few.slots);
    const rows = this.doubleView();
    few.asking = roomFor(few.asking, few.count);
    let asked = 0;
    for (let k = 0; k < few.count; k++) {
      const row = at + k * stride;
      const id = rows[row]!;
      if (id < 0) continue;
      const slot = few.slots[k]!;
      if (listed && lists.holds(slot, rows, row)) kept.addNear(slot, rows, row);
      else few.asking[asked++] = k;
    }
    if (asked === 0) return;
    const ends = this.#ask(other, at, few.asking, asked, listed);
    let answer = other.#see(other.wordView()[ends + asked]!);
    const its = other.doubleView();
    const words = other.wordView();
    for (let k = 0; k < asked; k++) {
      const row = at + few.asking[k]! * stride;
      const slot = few.slots[few.asking[k]!]!;
      if (listed) lists.begin(slot, rows, row);
      for (let n = words[ends + k + 1]! - words[ends + k]!; n > 0; n--, answer += stride) {
        if (listed) lists.add(its, answer);
        else if (other.#meets(its, answer, rows, row)) kept.add(rows[row]!, its[answer]!);
      }
      if (listed) kept.addNear(slot, rows, row);
    }
  }

  /** The pairs of the boxes here that are loose. */
  #askLoose(kept: Kept, other: PairsBetween<D>): void {
    const { loose } = kept;
    if (loose.count === 0) return;
    const stride = this.width + rowMore;
    const at = this.#see(loose.count, loose.slots);
    const rows = this.doubleView();
    loose.asking = roomFor(loose.asking, loose.count);
    let asked = 0;
    for (let k = 0; k < loose.count; k++) if (rows[at + k * stride]! >= 0) loose.asking[asked++] = k;
    if (asked === 0) return;
    const ends = this.#ask(other, at, loose.asking, asked, false);
    let answer = other.#see(other.wordView()[ends + asked]!);
    const its = other.doubleView();
    const words = other.wordView();
    for (let k = 0; k < asked; k++) {
      const id = rows[at + loose.asking[k]! * stride]!;
      for (let n = words[ends + k + 1]! - words[ends + k]!; n > 0; n--, answer += stride) {
        if (other.#meets(its, answer, rows, at + loose.asking[k]! * stride)) kept.addPair(its[answer]!, id);
      }
    }
  }

  /**
   * Whether the boxes of two rows overlap, the first of which is here and answered a question about the other. Where no box
   * here reaches beyond itself the answer said so.
   */
  #meets(its: Float64Array, answer: number, rows: Float64Array, row: number): boolean {
    if (this.kernel.most_reach() === 0) return true;
    const { width } = this;
    if (this.wrap === undefined) return meet(its, answer + 1, rows, row + 1, width / 2, this.touching);
    const io = this.io();
    for (let n = 0; n < width; n++) {
      io[n] = its[answer + 1 + n]!;
      io[width + n] = rows[row + 1 + n]!;
    }
    return this.kernel.meet_around() === 1;
  }

  /** Asks another space about so many of the rows at a place, grown or not; returns the place of the ends of the answers. */
  #ask(other: PairsBetween<D>, first: number, asking: Uint32Array, count: number, grown: boolean): number {
    try {
      const { width } = this;
      const step = width + 2;
      const reach = other.kernel.most_reach();
      const at = other.kernel.stage_questions(count * (step + 1)) >>> 3;
      const to = other.doubleView();
      const rows = this.doubleView();
      for (let k = 0; k < count; k++) {
        const row = first + asking[k]! * (width + rowMore);
        const place = at + k * step;
        for (let n = 0; n < step; n++) to[place + n] = rows[row + 1 + n]!;
        if (grown) grow(to, place, width);
        if (reach > 0) reachOut(to, place, width, reach);
      }
      other.tellTouching(where, undefined);
      to.fill(nobody, at + count * step, at + count * (step + 1));
      other.kernel.ask_many(meeting, count, everything, 1);
      return other.kernel.offsets_address() >>> 2;
    } catch (error) {
      other.recover(error, where);
    }
  }
}
