// What figure 10 measures: four worlds take turns on the page's one heap, and leave garbage behind.
//
// If the browser does not report the size of its heap, the number of arrays created is taken instead, which is always
// known.

import { heapSize } from '../shared/heap.ts';
import { makeWorlds } from './demos/heap.ts';

export const tellsHeap = heapSize() !== undefined;
/** For `chosen`: all worlds take turns. */
export const inTurn = -1;
/** Milliseconds of one turn. */
export const turn = 3000;
/** Samples kept: more than there are frames in the time shown. */
const kept = 4096;

/** The last samples: when, how much, and whose turn it was. Samples are numbered from 0 on, and the old ones forgotten. */
export class Samples {
  /** How many there have been. */
  count = 0;
  readonly #times = new Float64Array(kept);
  readonly #values = new Float64Array(kept);
  readonly #owners = new Uint8Array(kept);

  /** The oldest that is kept. */
  get first(): number {
    return Math.max(0, this.count - kept);
  }

  time(sample: number): number {
    return this.#times[sample % kept];
  }

  value(sample: number): number {
    return this.#values[sample % kept];
  }

  owner(sample: number): number {
    return this.#owners[sample % kept];
  }

  add(time: number, value: number, owner: number): void {
    const place = this.count % kept;
    this.#times[place] = time;
    this.#values[place] = value;
    this.#owners[place] = owner;
    this.count++;
  }
}

export class Turns {
  readonly worlds = makeWorlds();
  /** What each world has used and left behind in its turns. */
  readonly totals = this.worlds.map(() => ({ milliseconds: 0, grown: 0, collections: 0 }));
  readonly samples = new Samples();
  /** Milliseconds, while one of them ran. */
  clock = 0;
  /** The world that runs, or `inTurn`. */
  chosen = inTurn;
  #made = 0;

  /** One step of the world whose turn it is, and one sample. */
  step(milliseconds: number): void {
    const { worlds, samples, chosen } = this;
    const owner = chosen === inTurn ? Math.floor(this.clock / turn) % worlds.length : chosen;
    const { world, coltech } = worlds[owner];
    const before = heapSize() ?? this.#made;
    world.step();
    this.#made += coltech.arraysCreated;
    const value = heapSize() ?? this.#made;

    const total = this.totals[owner];
    const last = samples.count - 1;
    total.milliseconds += milliseconds;
    if (last >= 0 && samples.owner(last) === owner) {
      const grown = value - samples.value(last);
      if (grown >= 0) total.grown += grown;
      else total.collections++;
    } else total.grown += Math.max(0, value - before);
    this.clock += milliseconds;
    samples.add(this.clock, value, owner);
  }
}
