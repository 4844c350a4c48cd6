// The pairs of two spaces, such as a level at rest and what moves in it. The kernel of the space with fewer boxes has
// them, and lists of the other's boxes: see kernel/questions/neighbours.hpp. The code here takes queries and answers from
// one kernel to the other, and copies the pairs.
import { known } from './answers.ts';
import { badValue, show } from './errors.ts';
import {
  asks,
  logAt,
  logCountAt,
  looseCountAt,
  metAt,
  metCountAt,
  mostNeighbours,
  mostReachAt,
  still,
  touchingAt,
} from './generated/abi.ts';
import type { KernelInstance } from './kernel/instance.ts';
import { everything } from './query-options.ts';

const where = 'pairsWith';
const ofOther = 'pairsWith: the other BroadPhase';
/** What both spaces must have in common. */
const shared = ['dimensions', 'wrap', 'touching'] as const;
/** Numbers of a row besides the box: see `write_row` in kernel/questions/index.hpp. */
const rowMore = 3;
/** The number of views kept, so that a length seen recently makes no garbage. */
const viewsKept = 256;
/** The first of the numbers by which views of pairs are kept: those below are of the space's own pairs. */
const firstList = 3;

/** The pairs with another space. */
export class Kept {
  /** Whether the space whose pairs these are has the lists. */
  forth = true;
  /** The epoch of the other space's list of changes, and how much of it has been read. 0: the next call starts over. */
  epoch = 0;
  read = 0;
  /** The call that used it last. */
  used = 0;
  #list = new Uint32Array(64);
  #views: Uint32Array[] = [];
  length = 0;

  /** Copies the pairs. */
  take(pairs: Uint32Array): void {
    const { length } = pairs;
    if (length > this.#list.length) this.#list = new Uint32Array(2 * length);
    this.#list.set(pairs);
    this.length = length;
  }

  /** The pairs, as a view made earlier if possible. */
  view(): Uint32Array {
    const { length } = this;
    const at = (length / 2) % viewsKept;
    let view = this.#views[at];
    if (view?.length !== length || view.buffer !== this.#list.buffer) {
      view = this.#list.subarray(0, length);
      this.#views[at] = view;
    }
    return view;
  }
}

let calls = 0;

export function pairsWith(instance: KernelInstance, other: KernelInstance): Uint32Array {
  checkOther(instance, other);
  let kept = instance.kept.get(other);
  if (kept === undefined) {
    kept = new Kept();
    instance.kept.set(other, kept);
  }
  const mine = instance.size;
  const others = other.size;
  // The space with fewer boxes, or nearly so.
  const forth = kept.forth ? mine <= 2 * others : 2 * mine < others;
  if (forth !== kept.forth) kept.epoch = 0;
  kept.forth = forth;
  if (forth) keep(instance, kept, other);
  else keep(other, kept, instance);
  return kept.view();
}

function checkOther(instance: KernelInstance, other: KernelInstance): void {
  if (other === instance) {
    throw new TypeError(`${where}: got the space itself, expected another: its own pairs are in pairs`);
  }
  instance.exports.size(); // throws where this one was disposed of
  if (other.isDisposed) throw new Error(`${where}: the other BroadPhase was disposed and can no longer be used`);
  for (const name of shared) {
    const mine = instance[name];
    if (String(other[name]) === String(mine)) continue;
    badValue(`${where}: ${name} of the other`, other[name], `${mine === undefined ? 'none' : show(mine)} as here`);
  }
}

/** Brings the pairs up to date. `few` has the lists. */
function keep(few: KernelInstance, kept: Kept, many: KernelInstance): void {
  const set = setOf(few, kept);
  const row = few.width + rowMore;
  const { forth } = kept;
  let running = many;
  try {
    const epoch = known(many, forth ? ofOther : where, many.kernel.read_log());
    const log = many.io();
    const total = log[logCountAt]!;
    const reach = log[mostReachAt]!;
    const same = epoch === kept.epoch;
    const changes = same ? total - kept.read : 0;
    running = few;
    if (changes > 0) stageChanges(few, many, (log[logAt]! >>> 2) + 2 * kept.read, 2 * changes);
    kept.epoch = epoch;
    kept.read = total;
    const asked = known(
      few,
      forth ? where : ofOther,
      few.kernel.begin_pairs(set, changes, same ? 1 : 0, forth ? 1 : 0, reach),
    );
    if (asked === still) return;
    if (asked > 0) {
      running = many;
      copyStaged(few, many, asked * (row - 1));
      many.io()[touchingAt] = Number(many.touching);
      many.kernel.ask_many(asks.meeting, asked, everything, 1);
      const found = rowsOfAnswers(many, asked, row);
      running = few;
      copyStaged(many, few, found * row + asked + 1);
      few.kernel.take_answers(set, found, reach === 0 ? 1 : 0);
    }
    const loose = few.io()[looseCountAt]!;
    if (loose > 0) {
      few.kernel.stage_loose(set);
      running = many;
      copyStaged(few, many, loose * row);
      many.kernel.see_rows(loose);
      running = few;
      copyStaged(many, few, loose * row);
      few.kernel.meet_loose(set);
    }
    const met = few.io();
    kept.take(few.pairView(firstList + set, met[metAt]!, met[metCountAt]!));
  } catch (error) {
    kept.epoch = 0;
    running.recover(error, (running === few) === forth ? where : ofOther);
  }
}

/** The number of the lists in the kernel that these pairs have: perhaps those that others have not used for longest. */
function setOf(instance: KernelInstance, kept: Kept): number {
  const { neighbours } = instance;
  kept.used = ++calls;
  let set = neighbours.indexOf(kept);
  if (set >= 0) return set;
  set = neighbours.length;
  if (set === mostNeighbours) {
    set = 0;
    for (let k = 1; k < mostNeighbours; k++) if (neighbours[k]!.used < neighbours[set]!.used) set = k;
  }
  neighbours[set] = kept;
  kept.epoch = 0;
  return set;
}

/** Takes changes of the other space to the kernel with the lists: `count` of its words from `first` on. */
function stageChanges(few: KernelInstance, many: KernelInstance, first: number, count: number): void {
  const at = few.kernel.stage_questions(count) >>> 3;
  const words = many.wordView();
  const to = few.doubleView();
  for (let n = 0; n < count; n++) to[at + n] = words[first + n]!;
}

/** Copies what is staged in one kernel to another. */
function copyStaged(from: KernelInstance, to: KernelInstance, count: number): void {
  const at = from.kernel.stage_questions(count) >>> 3;
  const place = to.kernel.stage_questions(count) >>> 3;
  const numbers = from.doubleView();
  const its = to.doubleView();
  for (let n = 0; n < count; n++) its[place + n] = numbers[at + n]!;
}

/** Stages a row for each answer, then where the answers of each query begin. Returns the number of answers. */
function rowsOfAnswers(instance: KernelInstance, asked: number, row: number): number {
  const { kernel } = instance;
  const ends = kernel.offsets_address() >>> 2;
  const found = instance.wordView()[ends + asked]!;
  const at = kernel.stage_questions(found * row + asked + 1) >>> 3;
  const words = instance.wordView();
  const rows = instance.doubleView();
  const ids = kernel.many_ids_address() >>> 2;
  for (let k = 0; k < found; k++) rows[at + k * row] = words[ids + k]!;
  kernel.see_rows(found);
  for (let k = 0; k <= asked; k++) rows[at + found * row + k] = words[ends + k]!;
  return found;
}
