// A server that runs for months, in hours: spaces that live on while boxes come, go, move, jump and change their
// filters, techniques are switched, states are saved and gone back to; then calm spells in which a few boxes creep, so
// that techniques come to keep what they have found. After each update the pairs are the model's, every invariant holds,
// and memory is what it was. Beside them, crowds of thousands, one after the other, in which `auto` keeps what it finds.
import { BroadPhase } from 'broadphase';
import { Crowd } from '../support/crowd.ts';
import { anyPlace, type Entry, Modelled, pairsOf } from '../support/model.ts';
import { inBox } from '../support/query-reference.ts';
import { keysOf } from '../support/reference.ts';

export interface Totals {
  updates: number;
  calls: number;
  pairs: number;
  restores: number;
  /** Updates that `auto` answered from what was kept. */
  kept: number;
  /** Bytes of the kernels' memories: the most so far. */
  wasm: number;
  /** Bytes the kernels have handed out: the most so far. */
  used: number;
}

const warmUp = 1000; // updates of each space, after which its memory is to be flat
const slack = 2; // times: memory grows in steps, and the rarest of crowds may take one more
const callsPerUpdate = 120;
const spell = 250; // updates of a storm, and of the calm after it
const callsPerCalmUpdate = 5;
const crowdUpdates = 200; // of a crowd, until the next one
const keepers = ['auto', 'incremental', 'aabb-tree', 'retained-grid'] as const; // take turns in calm spells
const { techniques } = BroadPhase;

function fail(what: string): never {
  throw new Error(`soak: ${what}`);
}

class Subject {
  readonly #modelled: Modelled;
  readonly #options: ConstructorParameters<typeof BroadPhase>[0];
  readonly #saves: boolean;
  #saved: { bytes: Uint8Array; entries: Map<number, Entry> } | undefined;
  updates = 0;
  /** Memory at the end of the warm-up. */
  #steady = 0;

  /** One that saves has `auto` keep nothing, so the one without events does not. */
  constructor(dimensions: 2 | 3, events: boolean, seed: number) {
    this.#options = { dimensions, events };
    this.#saves = events;
    this.#modelled = new Modelled(this.#options, seed, anyPlace, 300, 1000);
  }

  get #wasm(): number {
    return this.#modelled.space.pairs.buffer.byteLength;
  }

  round(totals: Totals): void {
    const { space, entries } = this.#modelled;
    const calm = this.updates % (2 * spell) >= spell;
    if (calm && this.updates % spell === 0)
      space.technique = keepers[Math.floor(this.updates / (2 * spell)) % keepers.length]!;
    const calls = calm ? callsPerCalmUpdate : callsPerUpdate;
    for (let k = 0; k < calls; k++) {
      if (calm) this.#creep();
      else this.#churn();
    }
    const chance = this.#modelled.random() * (calm ? 20 : 1);
    if (this.#saves && chance < 0.1) this.#save();
    else if (this.#saves && chance < 0.2) this.#restore(totals);
    space.update().validate();
    totals.kept += Number(space.technique === 'auto' && space.stats.technique === 'incremental');
    this.updates++;
    const found = keysOf(space.pairs);
    const expected = pairsOf(entries, space.dimensions);
    if (found.length !== expected.length || found.some((key, k) => key !== expected[k]))
      fail("the pairs are not the model's");
    if (space.size !== entries.size) fail("the size is not the model's");
    const box = this.#modelled.box();
    const [low, high] = [box.slice(0, space.dimensions), box.slice(space.dimensions)];
    const ask = space.queryBox as (...numbers: number[]) => number[];
    const answer = ask.call(space, ...low, ...high).sort((a, b) => a - b);
    if (answer.join() !== inBox(entries, box, {}).join()) fail("the answer is not the model's");
    totals.updates++;
    totals.calls += calls;
    totals.pairs += space.pairCount;
    totals.wasm = Math.max(totals.wasm, this.#wasm);
    totals.used = Math.max(totals.used, space.stats.bytes);
    if (this.updates === warmUp) this.#steady = this.#wasm;
    if (this.updates > warmUp && this.#wasm > slack * this.#steady) {
      fail(`memory has grown from ${this.#steady} to ${this.#wasm} bytes in ${this.updates - warmUp} updates`);
    }
  }

  /** One call: mostly boxes that come, jump or go, so that hundreds stand there at any time. */
  #churn(): void {
    const modelled = this.#modelled;
    const chance = modelled.random();
    const bits = () => [0xffffffff, 1, 2, 3, 0x80000000][modelled.integer(5)]!;
    if (chance < 0.7) modelled.set(modelled.id());
    else if (chance < 0.9) modelled.delete(modelled.id());
    else if (chance < 0.94) modelled.filter(modelled.id(), bits(), bits());
    else if (chance < 0.98) modelled.setStatic(modelled.id(), modelled.random() < 0.6);
    else if (chance < 0.995) modelled.space.technique = techniques[modelled.integer(techniques.length)]!;
    else if (chance < 0.9995) modelled.set(modelled.id(), [...modelled.entries.values()][0]?.box);
    else if (chance < 0.9998) modelled.replace(modelled.integer(1000), modelled.random() < 0.5);
    else modelled.clear();
  }

  /** One call in calm spells: a box moves by a little of its size, now and then one comes, goes or jumps. */
  #creep(): void {
    const modelled = this.#modelled;
    const id = modelled.id();
    const known = modelled.entries.get(id);
    const chance = modelled.random();
    if (!known || chance < 0.02) modelled.set(id);
    else if (chance < 0.03) modelled.delete(id);
    else if (chance < 0.04) modelled.filter(id, 3, 0xffffffff);
    else if (chance < 0.05) modelled.setStatic(id, modelled.random() < 0.6);
    else {
      const { dimensions } = modelled.space;
      const steps = Array.from({ length: dimensions }, () => (modelled.integer(5) - 2) / 8);
      const moved = known.box.map((x, k) => x + steps[k % dimensions]!);
      modelled.set(id, moved);
    }
  }

  #save(): void {
    const entries = new Map([...this.#modelled.entries].map(([id, entry]) => [id, { ...entry }]));
    this.#saved = { bytes: this.#modelled.space.snapshot(), entries };
  }

  /** Goes back, and sees that a space that is new gives the same pairs in the same order. */
  #restore(totals: Totals): void {
    if (!this.#saved) return;
    const { entries, space } = this.#modelled;
    space.restore(this.#saved.bytes).update();
    const { pairs } = new BroadPhase(this.#options).restore(this.#saved.bytes).update();
    if (Buffer.compare(bytesOf(pairs), bytesOf(space.pairs)) !== 0) fail('a restored space goes on otherwise');
    entries.clear();
    for (const [id, entry] of this.#saved.entries) entries.set(id, { ...entry });
    totals.restores++;
  }
}

/** Crowds, one after the other. */
class Crowds {
  #seed: number;
  #crowd: Crowd;
  #updates = 0;

  constructor(seed: number) {
    this.#seed = seed;
    this.#crowd = new Crowd(seed);
  }

  round(totals: Totals): void {
    if (this.#updates === crowdUpdates) {
      this.#crowd.dispose();
      this.#crowd = new Crowd(++this.#seed);
      this.#updates = 0;
    }
    this.#crowd.step();
    const { expected, found } = this.#crowd.pairs;
    if (found !== expected) fail(`the pairs of crowd ${this.#seed} are not strip-sweep's in update ${this.#updates}`);
    this.#updates++;
    const { pairCount, stats } = this.#crowd.kept;
    totals.updates++;
    totals.pairs += pairCount;
    totals.kept += Number(stats.reason.includes('are retained'));
  }
}

const bytesOf = (words: Uint32Array) => new Uint8Array(words.buffer, words.byteOffset, words.byteLength);

/** Runs until `now() >= until`; calls `report` every `every` milliseconds. */
export function soak(seed: number, until: number, every: number, report: (totals: Totals) => void): Totals {
  const totals: Totals = { updates: 0, calls: 0, pairs: 0, restores: 0, kept: 0, wasm: 0, used: 0 };
  const subjects = ([2, 3] as const).flatMap((dimensions) =>
    [false, true].map((events, k) => new Subject(dimensions, events, seed + dimensions * 10 + k)),
  );
  const crowds = new Crowds(seed);
  let next = performance.now() + every;
  while (performance.now() < until) {
    for (const subject of subjects) subject.round(totals);
    crowds.round(totals);
    if (performance.now() < next) continue;
    report(totals);
    next = performance.now() + every;
  }
  return totals;
}
