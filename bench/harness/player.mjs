// One contender playing one scene, frame after frame. Neither the motion of the scene nor the taking of notes is timed.
import { clocked } from './clock.mjs';
import { fingerprint, fingerprintOfBoxes } from './fingerprint.mjs';
import { partOf } from './frames.mjs';

/**
 * The notes on the frames that were timed: their numbers, the milliseconds of each part (`give` the boxes, `update`,
 * `walk` over the pairs), how many pairs were found, and fingerprints of the pairs and of the boxes.
 */
const nothing = () => ({
  frames: [],
  give: [],
  update: [],
  walk: [],
  pairs: [],
  found: [],
  seen: [],
  kept: 0,
  bytes: 0,
});

/** A contender is tried in at least this many frames, unless they exceed its budget this many times. */
const [fewest, mostOfFirst] = [5, 6];

export class Player {
  #scene;
  #contender;
  #plan;
  #stride;
  #frame = 0;
  #notes = nothing();
  /** Milliseconds of the warm-up updates, for contenders whose start is measured. */
  #start = [];
  /** Milliseconds that the contender took in the last frame it played. */
  #last = 0;
  #sink = 0;

  constructor(scene, contender, plan, stride = 1) {
    this.#scene = scene;
    this.#contender = contender;
    this.#plan = plan;
    this.#stride = stride;
  }

  /** Whether frames are left. */
  get over() {
    return this.#frame >= this.#plan.warmUp + this.#plan.timed;
  }

  get notes() {
    return { ...this.#notes, start: this.#start, sink: this.#sink };
  }

  /** Plays the next frames: as many as requested, or as are left. */
  play(frames) {
    const end = Math.min(this.#frame + frames, this.#plan.warmUp + this.#plan.timed);
    for (; this.#frame < end; this.#frame++) {
      // The first frame is the scene as it was made.
      if (this.#frame > 0) this.#scene.step(this.#frame);
      const part = partOf(this.#frame, this.#plan, this.#stride);
      if (part === 'no') continue;
      const times = this.#time();
      this.#last = times.give + times.update + times.walk;
      if (part === 'timed') this.#note(times);
      else if (this.#frame < this.#plan.warmUp) this.#start.push(times.give + times.update);
    }
  }

  /**
   * Plays the first frames for a number of milliseconds, so that the engine compiles the code, and returns how many
   * milliseconds the contender takes in a frame then, the motion of the scene not included. Afterwards everything starts
   * again: this only determines how many frames a contender can be timed in.
   */
  probe(frames, milliseconds) {
    const times = [];
    let spent = 0;
    // The very first frame may take as long as hundreds of others.
    while (times.length < frames && !this.over && spent < (times.length < fewest ? mostOfFirst : 1) * milliseconds) {
      const start = performance.now();
      this.play(1);
      times.push(this.#last);
      spent += performance.now() - start;
    }
    return Math.min(...times.slice(times.length >> 1));
  }

  #time() {
    const { boxes } = this.#scene;
    const contender = this.#contender;
    const give = contender.give ? clocked(() => contender.give(boxes)) : 0;
    const update = clocked(() => {
      this.#sink += contender.update(boxes);
    });
    const walk = contender.walk
      ? clocked(() => {
          this.#sink += contender.walk();
        })
      : 0;
    return { give, update, walk };
  }

  #note({ give, update, walk }) {
    const notes = this.#notes;
    notes.frames.push(this.#frame);
    notes.give.push(give);
    notes.update.push(update);
    notes.walk.push(walk);
    const pairs = this.#contender.pairs();
    notes.pairs.push(pairs.length / 2);
    notes.found.push(fingerprint(pairs));
    notes.seen.push(fingerprintOfBoxes(this.#scene.boxes));
    const stats = this.#contender.stats?.();
    if (!stats) return;
    if (stats.kept) notes.kept++;
    notes.bytes = Math.max(notes.bytes, stats.bytes);
  }
}
