// What pairsWith retains between calls: the pairs, the changes, and the lists of nearby boxes. See pairs-between.ts.

/** Numbers of a kernel's row besides the box: the id, layer and mask. See `fill_rows` in kernel/questions/bulk.hpp. */
export const rowMore = 3;
/** The number of views kept, so that a length seen recently makes no garbage. */
const viewsKept = 256;
/** A box is grown by this share of its size on each side. More makes its list longer; less, and it leaves sooner. */
const growth = 0.5;
/** Twice the rounding error of a sum, relative to its terms. */
const roundingShare = 2 ** -52;
/** The most boxes that may be loose: this many, plus a share of the boxes in the space with fewer. */
const leastLoose = 32;
const looseShare = 1 / 16;
/** All lists are dropped once they have more numbers than this, outdated lists included. */
const mostNumbers = 2 ** 22;

/** The array itself, or a longer one with the same contents. */
export function roomFor<Kind extends Uint32Array<ArrayBuffer> | Float64Array<ArrayBuffer>>(
  array: Kind,
  length: number,
): Kind {
  if (length <= array.length) return array;
  const longer = new (array.constructor as new (length: number) => Kind)(Math.max(length, 2 * array.length));
  longer.set(array);
  return longer;
}

/** What has changed in one of the two spaces since the last call. */
export class Side {
  /** The epoch of the kernel's list of changes, and how much of it has been read. */
  epoch = 0;
  #read = 0;
  slots = new Uint32Array(16);
  ids = new Uint32Array(16);
  count = 0;
  /** Per id: the call in which it last changed. */
  marks = new Uint32Array(16);
  /** Indices into `slots`: the boxes that need a query. */
  asking = new Uint32Array(16);

  /** Reads the kernel's list of changes: see kernel/boxes/changed_ids.hpp. False if anything may have changed. */
  read(epoch: number, words: Uint32Array, first: number, total: number, call: number): boolean {
    const same = epoch === this.epoch;
    this.count = 0;
    // Backwards, because only the last change of an id counts.
    for (let k = total; same && k-- > this.#read; ) {
      const id = words[first + 2 * k]!;
      this.marks = roomFor(this.marks, id + 1);
      if (this.marks[id] === call) continue;
      this.marks[id] = call;
      this.add(id, words[first + 2 * k + 1]!);
    }
    this.epoch = epoch;
    this.#read = total;
    return same;
  }

  add(id: number, slot: number): void {
    const { count } = this;
    this.ids = roomFor(this.ids, count + 1);
    this.slots = roomFor(this.slots, count + 1);
    this.ids[count] = id;
    this.slots[count] = slot;
    this.count++;
  }

  /** Treats all boxes as changed. */
  takeAll(count: number): void {
    this.slots = roomFor(this.slots, count);
    for (let k = 0; k < count; k++) this.slots[k] = k;
    this.count = count;
  }
}

/** Per slot, the boxes of the other space that overlap the grown box: ids and numbers, one list after the other. */
export class Lists {
  readonly #width: number;
  /** Lists of an older version are outdated. */
  version = 1;
  #versions = new Uint32Array(16);
  /** Per list: the grown box, layer and mask. */
  #grown = new Float64Array(128);
  #firsts = new Uint32Array(16);
  #ends = new Uint32Array(16);
  numbers = new Float64Array(256);
  used = 0;
  #last = 0;

  constructor(width: number) {
    this.#width = width;
  }

  drop(): void {
    this.version++;
    this.used = 0;
  }

  /** Whether the list of the box in a row still has all boxes that it may overlap. */
  holds(slot: number, rows: Float64Array, row: number): boolean {
    if (this.#versions[slot] !== this.version) return false;
    const width = this.#width;
    const grown = this.#grown;
    const at = slot * (width + 2);
    const within =
      width === 4
        ? grown[at]! <= rows[row + 1]! &&
          grown[at + 1]! <= rows[row + 2]! &&
          rows[row + 3]! <= grown[at + 2]! &&
          rows[row + 4]! <= grown[at + 3]!
        : grown[at]! <= rows[row + 1]! &&
          grown[at + 1]! <= rows[row + 2]! &&
          grown[at + 2]! <= rows[row + 3]! &&
          rows[row + 4]! <= grown[at + 3]! &&
          rows[row + 5]! <= grown[at + 4]! &&
          rows[row + 6]! <= grown[at + 5]!;
    return within && grown[at + width] === rows[row + width + 1]! && grown[at + width + 1] === rows[row + width + 2]!;
  }

  /** Begins the list of the box in a row, which is grown as for the query. */
  begin(slot: number, rows: Float64Array, row: number): void {
    const width = this.#width;
    this.#versions = roomFor(this.#versions, slot + 1);
    this.#firsts = roomFor(this.#firsts, slot + 1);
    this.#ends = roomFor(this.#ends, slot + 1);
    this.#grown = roomFor(this.#grown, (slot + 1) * (width + 2));
    const at = slot * (width + 2);
    for (let n = 0; n < width + 2; n++) this.#grown[at + n] = rows[row + 1 + n]!;
    grow(this.#grown, at, width);
    this.#versions[slot] = this.version;
    this.#firsts[slot] = this.#ends[slot] = this.used;
    this.#last = slot;
  }

  /** Adds the box in a row of the other space to the list that was begun last. */
  add(rows: Float64Array, row: number): void {
    const width = this.#width;
    this.numbers = roomFor(this.numbers, this.used + width + 1);
    for (let n = 0; n <= width; n++) this.numbers[this.used++] = rows[row + n]!;
    this.#ends[this.#last] = this.used;
  }

  first(slot: number): number {
    return this.#firsts[slot]!;
  }
  end(slot: number): number {
    return this.#ends[slot]!;
  }
}

/** Grows a box on each side by a share of its longest finite side. */
export function grow(numbers: Float64Array, at: number, width: number): void {
  const d = width / 2;
  let most = 0;
  for (let a = at; a < at + d; a++) {
    const size = numbers[a + d]! - numbers[a]!;
    if (size > most && size < Number.POSITIVE_INFINITY) most = size;
  }
  for (let a = at; a < at + d; a++) {
    numbers[a]! -= most * growth;
    numbers[a + d]! += most * growth;
  }
}

/** Enlarges a box by `reach` on each side, rounded outward. Bounds may be infinite. */
export function reachOut(numbers: Float64Array, at: number, width: number, reach: number): void {
  for (let n = at; n < at + width; n++) {
    const bound = numbers[n]!;
    if (!Number.isFinite(bound)) continue;
    const more = reach + (Math.abs(bound) + reach) * roundingShare;
    numbers[n] = n < at + width / 2 ? bound - more : bound + more;
  }
}

/** Whether two boxes overlap; if `touching`, also whether they only touch. */
export function meet(
  ones: Float64Array,
  one: number,
  others: Float64Array,
  other: number,
  d: number,
  touching: boolean,
): boolean {
  for (let a = 0; a < d; a++) {
    const low = one + a;
    const high = other + a + d;
    if (ones[low]! > others[high]! || others[other + a]! > ones[low + d]!) return false;
    if (!touching && (ones[low] === others[high] || others[other + a] === ones[low + d])) return false;
  }
  return true;
}

/** The pairs with another space. */
export class Kept {
  /** The space with fewer boxes, and the other. */
  readonly few = new Side();
  readonly many = new Side();
  readonly loose = new Side();
  readonly lists: Lists;
  readonly #width: number;
  /** Whether boxes that only touch are a pair. */
  readonly #touching: boolean;
  /** Per id of the space with more boxes: the version of the lists in which it is loose, and its place in `loose`. */
  #looseIn = new Uint32Array(16);
  #looseAt = new Uint32Array(16);
  /** Whether pairs begin with the id from the space with fewer boxes. */
  #forth = true;
  #list = new Uint32Array(64);
  #views: Uint32Array[] = [];
  length = 0;
  call = 0;

  constructor(width: number, touching: boolean) {
    this.#width = width;
    this.#touching = touching;
    this.lists = new Lists(width);
  }

  /** Begins a call, given the number of boxes of both spaces; returns whether the first has fewer, or nearly so. */
  begin(mine: number, others: number): boolean {
    this.call++;
    const forth = this.#forth ? mine <= 2 * others : 2 * mine < others;
    if (forth !== this.#forth) this.forget();
    this.#forth = forth;
    return forth;
  }

  /** Makes the next call a full rebuild. */
  forget(): void {
    this.few.epoch = this.many.epoch = 0;
    this.length = 0;
    this.dropLists();
  }

  dropLists(): void {
    this.lists.drop();
    this.loose.count = 0;
  }

  /** Makes the changed boxes of the space with more boxes loose. Drops all lists first if that makes too many. */
  loosen(boxes: number): void {
    const { many, loose, lists } = this;
    const most = leastLoose + looseShare * boxes;
    if (loose.count + many.count > most || lists.used > mostNumbers) this.dropLists();
    for (let k = 0; k < many.count; k++) {
      const id = many.ids[k]!;
      this.#looseIn = roomFor(this.#looseIn, id + 1);
      this.#looseAt = roomFor(this.#looseAt, id + 1);
      if (this.#looseIn[id] === lists.version) {
        loose.slots[this.#looseAt[id]!] = many.slots[k]!;
        continue;
      }
      this.#looseIn[id] = lists.version;
      this.#looseAt[id] = loose.count;
      loose.add(id, many.slots[k]!);
    }
  }

  /** Drops the pairs of boxes that have changed or are loose. */
  dropPairs(): void {
    const list = this.#list;
    const { marks } = this.few;
    const few = this.#forth ? 0 : 1;
    const many = 1 - few;
    let length = 0;
    for (let k = 0; k < this.length; k += 2) {
      if (marks[list[k + few]!] === this.call || this.#isLoose(list[k + many]!)) continue;
      list[length] = list[k]!;
      list[length + 1] = list[k + 1]!;
      length += 2;
    }
    this.length = length;
  }

  /** Adds the pairs of the box in a row with the boxes in its list. */
  addNear(slot: number, rows: Float64Array, row: number): void {
    const { numbers } = this.lists;
    const end = this.lists.end(slot);
    const minX = rows[row + 1]!;
    const minY = rows[row + 2]!;
    const third = rows[row + 3]!;
    const fourth = rows[row + 4]!;
    let at = this.lists.first(slot);
    if (this.#width === 4) {
      for (; at < end; at += 5) {
        if (numbers[at + 1]! > third || minX > numbers[at + 3]!) continue;
        if (numbers[at + 2]! <= fourth && minY <= numbers[at + 4]!) this.#addNear(rows, row, at);
      }
      return;
    }
    const maxY = rows[row + 5]!;
    const maxZ = rows[row + 6]!;
    for (; at < end; at += 7) {
      if (numbers[at + 1]! > fourth || minX > numbers[at + 4]! || numbers[at + 2]! > maxY || minY > numbers[at + 5]!)
        continue;
      if (numbers[at + 3]! <= maxZ && third <= numbers[at + 6]!) this.#addNear(rows, row, at);
    }
  }

  #addNear(rows: Float64Array, row: number, at: number): void {
    const { numbers } = this.lists;
    if (this.#touching || meet(rows, row + 1, numbers, at + 1, this.#width / 2, false))
      this.add(rows[row]!, numbers[at]!);
  }

  /** Adds a pair of a box in the space with fewer boxes and one in the other, unless the other is loose. */
  add(few: number, many: number): void {
    if (!this.#isLoose(many)) this.addPair(few, many);
  }

  addPair(few: number, many: number): void {
    const { length } = this;
    if (length + 2 > this.#list.length) this.#list = roomFor(this.#list, length + 2);
    this.#list[length] = this.#forth ? few : many;
    this.#list[length + 1] = this.#forth ? many : few;
    this.length = length + 2;
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

  #isLoose(id: number): boolean {
    return this.#looseIn[id] === this.lists.version;
  }
}
