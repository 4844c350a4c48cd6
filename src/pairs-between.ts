// The pairs of two spaces, such as a level at rest and what moves in it.
// Idea: the pairs are retained. When an update has changed a box (kernel/boxes/changed_ids.hpp), its pairs are dropped
// and found again. In the space with fewer boxes, each box that moves has a list: the boxes of the other space that
// overlapped it when it was grown. While it stays within its grown box, its pairs are among these. A box of the other
// space that has changed is loose: lists ignore it, and it takes a query in each call. If too many are loose, all lists
// are dropped.
// Cost of a call: about 50 ns for each box that moved within its grown box, one query for each that left it, one for
// each loose box, and a pass over the pairs.
import { known, tellTouching } from './answers.ts';
import { badValue } from './errors.ts';
import { asks } from './generated/abi.ts';
import { grow, Kept, meet, reachOut, roomFor, rowMore, type Side } from './kept-pairs.ts';
import type { KernelInstance } from './kernel/instance.ts';
import { everything, nobody } from './query-options.ts';

const where = 'pairsWith';

/** `keptOf`: what is retained for each other space. */
export function pairsWith(
  instance: KernelInstance,
  other: KernelInstance,
  keptOf: WeakMap<KernelInstance, Kept>,
): Uint32Array {
  checkOther(instance, other);
  let kept = keptOf.get(other);
  if (kept === undefined) {
    kept = new Kept(instance.width, instance.touching);
    keptOf.set(other, kept);
  }
  try {
    if (kept.begin(instance.kernel.size(), other.kernel.size())) keep(instance, kept, other);
    else keep(other, kept, instance);
  } catch (error) {
    kept.forget();
    throw error;
  }
  return kept.view();
}

function checkOther(instance: KernelInstance, other: KernelInstance): void {
  if (other === instance) {
    throw new TypeError(`${where}: got the space itself, expected another: the pairs within it are in its pairs`);
  }
  instance.kernel.size(); // throws where this one was disposed of
  if (other.isDisposed) throw new Error(`${where}: the other BroadPhase was disposed and can no longer be used`);
  if (other.dimensions !== instance.dimensions) {
    badValue(`${where}: dimensions of the other`, other.dimensions, `${instance.dimensions} as here`);
  }
  if (String(other.wrap) !== String(instance.wrap)) {
    badValue(
      `${where}: wrap of the other`,
      other.wrap,
      `${instance.wrap ? `[${instance.wrap.join(', ')}]` : 'none'} as here`,
    );
  }
  if (other.touching !== instance.touching) {
    badValue(`${where}: touching of the other`, other.touching, `${instance.touching} as here`);
  }
}

/** Brings the pairs up to date. `instance` has fewer boxes than `other`, or nearly so. */
function keep(instance: KernelInstance, kept: Kept, other: KernelInstance): void {
  const { few, many } = kept;
  const followed = follow(instance, few, kept.call);
  const same = follow(other, many, kept.call);
  if (followed && same && few.count + many.count === 0) return;
  if (!same) kept.dropLists();
  kept.loosen(instance.kernel.seen_count());
  if (followed && same) {
    kept.dropPairs();
  } else {
    kept.length = 0;
    few.takeAll(instance.kernel.seen_count());
  }
  askFew(instance, kept, other);
  askLoose(other, kept, instance);
}

/** Reads what has changed since the last call; false if anything may have. */
function follow(instance: KernelInstance, side: Side, call: number): boolean {
  try {
    const { kernel } = instance;
    const epoch = known(where, kernel.log_epoch());
    return side.read(epoch, instance.wordView(), kernel.log_address() >>> 2, kernel.log_count(), call);
  } catch (error) {
    instance.recover(error, where);
  }
}

/**
 * Has the kernel fill `count` rows with what the last update saw of some slots: the given ones, or the first of the
 * kernel's answers. Returns the place of the rows in its memory.
 */
function see(instance: KernelInstance, count: number, slots?: Uint32Array): number {
  try {
    const { kernel } = instance;
    const stride = instance.width + rowMore;
    const at = kernel.stage_questions(count * stride) >>> 3;
    const rows = instance.doubleView();
    const from = slots ?? instance.wordView();
    const first = slots ? 0 : kernel.many_ids_address() >>> 2;
    for (let k = 0; k < count; k++) rows[at + k * stride] = from[first + k]!;
    kernel.see_rows(count);
    return at;
  } catch (error) {
    instance.recover(error, where);
  }
}

/** Finds the pairs of changed boxes in the space with fewer boxes: from their lists, or by a query. */
function askFew(instance: KernelInstance, kept: Kept, other: KernelInstance): void {
  const { few, lists } = kept;
  if (few.count === 0) return;
  const stride = instance.width + rowMore;
  const listed = instance.wrap === undefined; // where the world wraps around only the kernel tests exactly
  const at = see(instance, few.count, few.slots);
  const rows = instance.doubleView();
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
  const ends = ask(instance, other, at, few.asking, asked, listed);
  let answer = see(other, other.wordView()[ends + asked]!);
  const its = other.doubleView();
  const words = other.wordView();
  for (let k = 0; k < asked; k++) {
    const row = at + few.asking[k]! * stride;
    const slot = few.slots[few.asking[k]!]!;
    if (listed) lists.begin(slot, rows, row);
    for (let n = words[ends + k + 1]! - words[ends + k]!; n > 0; n--, answer += stride) {
      if (listed) lists.add(its, answer);
      else if (meets(other, its, answer, rows, row)) kept.add(rows[row]!, its[answer]!);
    }
    if (listed) kept.addNear(slot, rows, row);
  }
}

/** Finds the pairs of the loose boxes, by queries. */
function askLoose(instance: KernelInstance, kept: Kept, other: KernelInstance): void {
  const { loose } = kept;
  if (loose.count === 0) return;
  const stride = instance.width + rowMore;
  const at = see(instance, loose.count, loose.slots);
  const rows = instance.doubleView();
  loose.asking = roomFor(loose.asking, loose.count);
  let asked = 0;
  for (let k = 0; k < loose.count; k++) if (rows[at + k * stride]! >= 0) loose.asking[asked++] = k;
  if (asked === 0) return;
  const ends = ask(instance, other, at, loose.asking, asked, false);
  let answer = see(other, other.wordView()[ends + asked]!);
  const its = other.doubleView();
  const words = other.wordView();
  for (let k = 0; k < asked; k++) {
    const id = rows[at + loose.asking[k]! * stride]!;
    for (let n = words[ends + k + 1]! - words[ends + k]!; n > 0; n--, answer += stride) {
      if (meets(other, its, answer, rows, at + loose.asking[k]! * stride)) kept.addPair(its[answer]!, id);
    }
  }
}

/**
 * Whether the boxes in two rows overlap. The first was found by a query with the second. If no box of its space has a
 * reach, the query was exact.
 */
function meets(instance: KernelInstance, its: Float64Array, answer: number, rows: Float64Array, row: number): boolean {
  if (instance.kernel.most_reach() === 0) return true;
  const { width } = instance;
  if (instance.wrap === undefined) return meet(its, answer + 1, rows, row + 1, width / 2, instance.touching);
  const io = instance.io();
  for (let n = 0; n < width; n++) {
    io[n] = its[answer + 1 + n]!;
    io[width + n] = rows[row + 1 + n]!;
  }
  return instance.kernel.meet_around() === 1;
}

/** Queries `other` with `count` of the rows from `first` on, grown if `grown`. Returns the place of the offsets. */
function ask(
  instance: KernelInstance,
  other: KernelInstance,
  first: number,
  asking: Uint32Array,
  count: number,
  grown: boolean,
): number {
  try {
    const { width } = instance;
    const step = width + 2;
    const reach = other.kernel.most_reach();
    const at = other.kernel.stage_questions(count * (step + 1)) >>> 3;
    const to = other.doubleView();
    const rows = instance.doubleView();
    for (let k = 0; k < count; k++) {
      const row = first + asking[k]! * (width + rowMore);
      const place = at + k * step;
      for (let n = 0; n < step; n++) to[place + n] = rows[row + 1 + n]!;
      if (grown) grow(to, place, width);
      if (reach > 0) reachOut(to, place, width, reach);
    }
    tellTouching(other, where, undefined);
    to.fill(nobody, at + count * step, at + count * (step + 1));
    other.kernel.ask_many(asks.meeting, count, everything, 1);
    return other.kernel.offsets_address() >>> 2;
  } catch (error) {
    other.recover(error, where);
  }
}
