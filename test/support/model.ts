// A space and a plain model of it, which get the same random calls. The tests of filters, events and queries compare
// the two. The model has each box's numbers, layer, mask, group and reach, and whether it is static or off. Its pairs
// are the reference's.
import { BroadPhase, type BroadPhaseOptions } from 'broadphase';
import { createRandom } from '../../src/scenes/random.ts';
import { overlap, pairOf, referencePairs } from './reference.ts';
import { setBox } from './set-box.ts';

export interface Entry {
  box: number[];
  layer: number;
  mask: number;
  isStatic: boolean;
  isOff?: boolean;
  group?: number;
  reach?: number;
}

const all = 0xffffffff;

export const meet = (a: Entry, b: Entry): boolean =>
  !a.isOff &&
  !b.isOff &&
  !(a.group && a.group === b.group) &&
  (a.layer & b.mask) !== 0 &&
  (b.layer & a.mask) !== 0 &&
  !(a.isStatic && b.isStatic);

/** Whether two boxes overlap, not only touch. */
export function overlaps(a: readonly number[], b: readonly number[]): boolean {
  const d = a.length / 2;
  return a.every((x, k) => (k < d ? x < b[k + d]! : b[k - d]! < x));
}

/** The box of an entry, enlarged by its reach. */
export function grown({ box, reach = 0 }: Entry): number[] {
  return box.map((x, k) => (k < box.length / 2 ? x - reach : x + reach));
}

/** The keys of all pairs of the entries that overlap and meet, sorted. */
export function pairsOf(entries: ReadonlyMap<number, Entry>, dimensions: number): Float64Array {
  const boxes = [...entries.values()].flatMap(grown);
  return referencePairs(boxes, dimensions, [...entries.keys()]).filter((key) => {
    const [a, b] = pairOf(key);
    return meet(entries.get(a)!, entries.get(b)!);
  });
}

export const touches = (box: readonly number[], entry: Entry): boolean => overlap(box, 0, entry.box, 0, box.length / 2);

/** A space with its model. `step` makes one random call, which is never `update`. */
export class Modelled {
  readonly space: BroadPhase<2 | 3>;
  readonly entries = new Map<number, Entry>();
  readonly random: () => number;
  /** Ids that any call has deleted since this set was last cleared. */
  readonly deleted = new Set<number>();
  readonly #world: number;
  readonly #ids: number;
  readonly #place: (random: () => number) => number;

  constructor(options: BroadPhaseOptions<2 | 3>, seed: number, place = anyPlace, world = 60, ids = 80) {
    this.space = new BroadPhase(options);
    this.random = createRandom(seed);
    this.#world = world;
    this.#ids = ids;
    this.#place = place;
    if (!options.events) return;
    // Room to note the end of any id, so that no call detaches an array of boxes().
    const largest = 2 ** 24 - 1;
    setBox(this.space, largest, Array(2 * this.space.dimensions).fill(0));
    this.space.delete(largest);
    this.space.clear();
  }

  integer(below: number): number {
    return Math.floor(this.random() * below);
  }

  box(): number[] {
    const { dimensions } = this.space;
    const min = Array.from({ length: dimensions }, () => this.integer(this.#world) + this.#place(this.random));
    const box = [...min, ...min.map((value) => value + this.integer(12) + Math.abs(this.#place(this.random)))];
    if (this.random() < 0.02) box[this.integer(dimensions)] = -Infinity;
    if (this.random() < 0.02) box[dimensions + this.integer(dimensions)] = Infinity;
    return box;
  }

  id(): number {
    return this.random() < 0.05 ? 2 ** 24 - 1 - 4096 * this.integer(5) : this.integer(this.#ids);
  }

  set(id: number, box = this.box()): void {
    setBox(this.space, id, box);
    const known = this.entries.get(id);
    if (known) known.box = box;
    else this.entries.set(id, { box, layer: all, mask: all, isStatic: false });
  }

  delete(id: number): void {
    this.space.delete(id);
    if (this.entries.delete(id)) this.deleted.add(id);
  }

  filter(id: number, layer: number, mask: number): void {
    if (!this.entries.has(id)) return;
    this.space.setFilter(id, layer, mask);
    Object.assign(this.entries.get(id)!, { layer, mask });
  }

  setStatic(id: number, isStatic: boolean): void {
    if (!this.entries.has(id)) return;
    this.space.setStatic(id, isStatic);
    this.entries.get(id)!.isStatic = isStatic;
  }

  setGroup(id: number, group: number): void {
    if (!this.entries.has(id)) return;
    this.space.setGroup(id, group);
    this.entries.get(id)!.group = group;
  }

  setReach(id: number, reach: number): void {
    if (!this.entries.has(id)) return;
    this.space.setReach(id, reach);
    this.entries.get(id)!.reach = reach;
  }

  setEnabled(id: number, enabled: boolean): void {
    if (!this.entries.has(id)) return;
    this.space.setEnabled(id, enabled);
    this.entries.get(id)!.isOff = !enabled;
  }

  /** Ids 0 … count - 1, given at once. */
  replace(count: number, shared: boolean, boxOf: (id: number) => number[] = () => this.box()): void {
    const boxes = Array.from({ length: count }, (_, id) => (shared ? boxOf(id).map(Math.fround) : boxOf(id)));
    if (shared) this.space.boxes(count).set(boxes.flat());
    else this.space.setAll(boxes.flat());
    for (const id of [...this.entries.keys()]) {
      if (id < count) continue;
      this.entries.delete(id);
      this.deleted.add(id);
    }
    boxes.forEach((box, id) => {
      const known = this.entries.get(id);
      if (known) known.box = box;
      else this.entries.set(id, { box, layer: all, mask: all, isStatic: false });
    });
  }

  clear(): void {
    this.space.clear();
    for (const id of this.entries.keys()) this.deleted.add(id);
    this.entries.clear();
  }

  step(): void {
    const chance = this.random();
    if (chance < 0.5) this.set(this.id());
    else if (chance < 0.62) this.delete(this.id());
    else if (chance < 0.78) this.filter(this.id(), this.#bits(), this.#bits());
    else if (chance < 0.9) this.setStatic(this.id(), this.random() < 0.6);
    else if (chance < 0.96) this.space.technique = BroadPhase.techniques[this.integer(BroadPhase.techniques.length)];
    else if (chance < 0.99) this.replace(this.integer(0.75 * this.#ids), this.random() < 0.5);
    else this.clear();
  }

  /** Mostly one of a few values, so that boxes share bits. */
  #bits(): number {
    return this.random() < 0.9 ? [all, 1, 2, 4, 3, 6, 0, 0x80000000][this.integer(8)] : this.integer(2 ** 32);
  }
}

/** Mostly whole numbers, so that boxes touch, and fractions that float32 cannot hold. */
export function anyPlace(random: () => number): number {
  return random() < 0.8 ? 0 : random() < 0.5 ? 1e-12 : 0.1;
}
