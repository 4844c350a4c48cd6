// Requests frame after frame: a new one only after the last has arrived, so that nothing piles up if a scene is slow,
// and no more often than the chosen rate.
import { FrameLoop } from '../../shared/loop.ts';

/** Displays of 60 Hz also have frames slightly shorter than 1/60 s. */
const slack = 4;

export class Playback {
  readonly #loop: FrameLoop;
  readonly #make: (steps: number) => Promise<void>;
  /** The rate of the display, and above: every frame. */
  readonly #every = 60;
  #last: Promise<void> = Promise.resolve();
  #waiting = 0;
  #at = 0;
  rate = 60;

  /** @param make shows the frame this many steps ahead; 0: the current one again. It does not throw */
  constructor(make: (steps: number) => Promise<void>) {
    this.#make = make;
    this.#loop = new FrameLoop((now) => this.#tick(now));
  }

  get playing(): boolean {
    return this.#loop.playing;
  }
  set playing(playing: boolean) {
    this.#loop.playing = playing;
  }

  /** Shows a frame once earlier requests are done. */
  show(steps: number): Promise<void> {
    this.#waiting++;
    this.#last = this.#last.then(() => this.#make(steps)).finally(() => this.#waiting--);
    return this.#last;
  }

  #tick(now: number): void {
    if (this.#waiting > 0) return;
    if (this.rate < this.#every && now - this.#at < 1000 / this.rate - slack) return;
    this.#at = now;
    void this.show(1);
  }
}
