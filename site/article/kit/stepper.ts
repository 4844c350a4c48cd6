// Steps through a recorded run of an algorithm, one operation at a time: forwards, backwards, by a slider, or by
// itself.
import { prefersStill } from './attend.ts';
import { button, row, type Slider, slider } from './controls.ts';

export interface Stepper<S> {
  /** Shows another run, from its first step. */
  load(steps: readonly S[]): void;
  /** Plays from the current step. */
  play(): void;
  /** Stops playing. */
  stop(): void;
}

export interface StepperOptions<S> {
  steps: readonly S[];
  /** Shows one step: its index, and whether it is only passed through while playing. */
  show(step: S, index: number, playing: boolean): void;
  /** Milliseconds per step while playing; 500 by default. */
  pace?: number;
  /** The name of the slider; 'Operation' by default. */
  label?: string;
  /** Begins again after the last step. */
  loops?: boolean;
}

export function createStepper<S>(root: HTMLElement, options: StepperOptions<S>): Stepper<S> {
  const { show, pace = 500, label = 'Operation', loops = false } = options;
  let { steps } = options;
  let at = 0;
  let timer = 0;
  let track: Slider;

  const controls = row(root, 'stepper');
  const trackPlace = document.createElement('div');

  const go = (index: number) => {
    at = Math.min(Math.max(index, 0), steps.length - 1);
    track.value = at + 1;
    back.disabled = at === 0;
    next.disabled = at === steps.length - 1 && !loops;
    show(steps[at], at, timer !== 0);
  };
  const advance = () => {
    if (at < steps.length - 1) go(at + 1);
    else if (loops) go(0);
    else play(false);
  };
  const play = (playing: boolean) => {
    clearInterval(timer);
    timer = playing ? window.setInterval(advance, prefersStill() ? pace * 2 : pace) : 0;
    player.textContent = playing ? 'Pause' : 'Play';
  };

  const back = button(controls, 'Back', () => {
    play(false);
    go(at - 1);
  });
  const next = button(controls, 'Step', () => {
    play(false);
    if (at === steps.length - 1) go(0);
    else go(at + 1);
  });
  next.classList.add('main');
  const player = button(controls, 'Play', () => {
    if (timer === 0 && at === steps.length - 1) go(0);
    play(timer === 0);
  });
  controls.append(trackPlace);
  trackPlace.className = 'track';

  const makeTrack = () => {
    trackPlace.replaceChildren();
    track = slider(trackPlace, {
      label,
      min: 1,
      max: Math.max(2, steps.length),
      value: 1,
      format: (value) => `${value} of ${steps.length}`,
      moved: (value) => {
        play(false);
        go(value - 1);
      },
    });
  };
  makeTrack();
  go(0);

  return {
    load(next) {
      play(false);
      steps = next;
      makeTrack();
      go(0);
    },
    play: () => play(true),
    stop: () => play(false),
  };
}
