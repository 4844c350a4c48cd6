// The model that random calls are compared with: a Map of what each box was given, and what the last update saw.
import type { BroadPhase } from 'broadphase';
import type { Recording } from 'broadphase/trace';
import type fc from 'fast-check';
import { expect } from 'vitest';
import { expectKeys } from '../../support/expect-pairs.ts';
import { type Entry, grown, meet, overlaps, touches } from '../../support/model.ts';
import { keyOf } from '../../support/reference.ts';
import { wrappedOverlap } from '../../support/wrapped-reference.ts';

export const all = 0xffffffff;

/** The options of a space that decide which boxes overlap. */
export interface World {
  touching: boolean;
  wrap: readonly number[] | undefined;
}

export interface Model {
  world: World;
  entries: Map<number, Entry>;
  /** Deleted since the last update. */
  gone: Set<number>;
  /** The keys of the pairs of the last update: of this space, and of the one that was saved. */
  shown: Set<number>;
  before: Set<number>;
  began: number[];
  ended: number[];
  /** What queries see: what stood there at the last update, whether or not one was asked before. */
  seen: Map<number, Entry>;
  /** What `boxes()` gave, while its rows stand for the ids 0, 1, 2, …. */
  view: Float32Array | undefined;
  /** Another space, for pairs between the two; its boxes, and what its last update saw. */
  other: { space: BroadPhase<2 | 3>; entries: Map<number, Entry>; seen: Map<number, Entry> };
  /** A recording of all updates, and the keys of the pairs of each. */
  recording: Recording | undefined;
  frames: Float64Array[];
  saved?: Pick<Model, 'entries' | 'gone' | 'before' | 'began' | 'ended'> & { bytes: Uint8Array };
}

/** Whether two boxes, enlarged by their reaches, overlap. */
export function overlap({ touching, wrap }: World, a: Entry, b: Entry): boolean {
  const [one, other] = [grown(a), grown(b)];
  if (wrap) return wrappedOverlap(one, other, wrap, touching);
  return touching ? touches(one, { ...b, box: other }) : overlaps(one, other);
}

/** The keys of all pairs, sorted. */
export function pairsOf(entries: ReadonlyMap<number, Entry>, world: World): Float64Array {
  const all = [...entries];
  const keys = all.flatMap(([a, one], k) =>
    all.slice(k + 1).flatMap(([b, other]) => (meet(one, other) && overlap(world, one, other) ? [keyOf(a, b)] : [])),
  );
  return Float64Array.from(keys).sort();
}

export const copy = (entries: ReadonlyMap<number, Entry>) =>
  new Map([...entries].map(([id, entry]) => [id, { ...entry }]));
export const ascending = (numbers: Iterable<number>) => [...numbers].sort((a, b) => a - b);

class Call implements fc.Command<Model, BroadPhase> {
  readonly #name: string;
  readonly run: (model: Model, space: BroadPhase<2 | 3>) => void;
  constructor(name: string, run: (model: Model, space: BroadPhase<2 | 3>) => void) {
    this.#name = name;
    this.run = run;
  }
  check = () => true;
  toString = () => this.#name;
}

export function put(model: Pick<Model, 'entries'>, id: number, box: number[]): void {
  const known = model.entries.get(id);
  model.entries.set(id, { layer: all, mask: all, isStatic: false, ...known, box });
}

export function replace(model: Model, boxes: readonly number[][]): void {
  const { entries } = model;
  for (const id of entries.keys()) if (id >= boxes.length) model.gone.add(id);
  model.entries = new Map(); // ids are in numerical order now
  boxes.forEach((box, id) => {
    const known = entries.get(id);
    if (known) model.entries.set(id, known);
    put(model, id, box);
  });
}

export function update(model: Model, space: BroadPhase<2 | 3>): void {
  expect(space.update()).toBe(space);
  const keys = pairsOf(model.entries, model.world);
  expectKeys(space, keys);
  const now = new Set(keys);
  const isGone = (key: number) => model.gone.has(Math.floor(key / 2 ** 24)) || model.gone.has(key % 2 ** 24);
  model.began = ascending([...now].filter((key) => !model.before.has(key) || isGone(key)));
  model.ended = ascending([...model.before].filter((key) => !now.has(key) || isGone(key)));
  expectEvents(model, space);
  model.shown = model.before = now;
  model.gone = new Set();
  model.seen = copy(model.entries);
  model.frames.push(keys);
  expect(space.stats.pairs).toBe(space.pairCount);
  space.validate();
}

export function expectEvents(model: Model, space: BroadPhase<2 | 3>): void {
  const keysIn = (pairs: Uint32Array) =>
    ascending(Array.from({ length: pairs.length / 2 }, (_, k) => keyOf(pairs[2 * k], pairs[2 * k + 1])));
  expect(keysIn(space.began)).toEqual(model.began);
  expect(keysIn(space.ended)).toEqual(model.ended);
}

export type RandomCall = fc.Arbitrary<fc.Command<Model, BroadPhase>>;

export const call = (name: string, run: (model: Model, space: BroadPhase<2 | 3>) => void) => new Call(name, run);

/** The space, for calls that its types do not allow, or that are made by name. */
export const on = (space: BroadPhase<2 | 3>) => space as unknown as Record<string, (...given: unknown[]) => unknown>;
