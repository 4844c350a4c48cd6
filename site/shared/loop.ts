// The run loop of a live figure: one call per display frame while it plays and is visible. A hidden tab, or a figure
// scrolled out of sight, costs nothing. A figure whose frame throws stops.
export class FrameLoop {
  readonly #frame: (now: number) => void;
  #request = 0;
  #playing = false;
  #onScreen = true;

  constructor(frame: (now: number) => void) {
    this.#frame = frame;
    document.addEventListener('visibilitychange', this.#schedule);
  }

  get playing(): boolean {
    return this.#playing;
  }
  set playing(playing: boolean) {
    this.#playing = playing;
    this.#schedule();
  }

  /** Runs only while the element is on screen. */
  watch(element: Element): void {
    new IntersectionObserver((entries) => {
      this.#onScreen = entries[entries.length - 1].isIntersecting;
      this.#schedule();
    }).observe(element);
  }

  readonly #schedule = (): void => {
    cancelAnimationFrame(this.#request);
    this.#request = this.#playing && this.#onScreen && !document.hidden ? requestAnimationFrame(this.#tick) : 0;
  };

  readonly #tick = (now: number): void => {
    this.#frame(now);
    this.#schedule();
  };
}
