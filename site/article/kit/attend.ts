// Runs something while the reader attends to it: while the mouse is over it, it has the keyboard focus, or a finger
// tapped it. It stops when the mouse or the focus leaves, and after a tap elsewhere; if it has controls, it goes on
// while the reader is at these, and can be watched as they change it.
//
// If the reader prefers reduced motion, hovering does not start it, only a tap, a click or the Enter key.

const still = matchMedia('(prefers-reduced-motion: reduce)');

/** Whether the reader prefers reduced motion. */
export const prefersStill = (): boolean => still.matches;

export interface Attended {
  readonly running: boolean;
  /** Stops it in any case: for when it goes out of sight. */
  stop(): void;
}

/**
 * @param around what contains the target and its controls: in there, it goes on, but does not start
 */
export function runWhileAttended(
  target: HTMLElement,
  start: () => void,
  stop: () => void,
  around: HTMLElement = target,
): Attended {
  let running = false;
  const run = (wanted: boolean) => {
    if (wanted === running) return;
    running = wanted;
    target.toggleAttribute('data-running', running);
    if (running) start();
    else stop();
  };
  const keyboardIsIn = (place: HTMLElement) =>
    place.matches(':focus-visible') || place.querySelector(':focus-visible') !== null;

  target.addEventListener('pointerenter', (event) => {
    if (event.pointerType === 'mouse' && !prefersStill()) run(true);
  });
  around.addEventListener('pointerleave', (event) => {
    if (event.pointerType === 'mouse' && !keyboardIsIn(around)) run(false);
  });
  target.addEventListener('click', () => run(true));
  target.addEventListener('focusin', () => {
    if (!prefersStill() && keyboardIsIn(target)) run(true);
  });
  around.addEventListener('focusout', (event) => {
    if (!around.contains(event.relatedTarget as Node | null)) run(false);
  });
  target.addEventListener('keydown', (event) => {
    if (event.key === 'Enter') run(true);
    if (event.key === 'Escape') run(false);
  });
  document.addEventListener('pointerdown', (event) => {
    if (!around.contains(event.target as Node)) run(false);
  });
  still.addEventListener('change', () => prefersStill() && run(false));

  return {
    get running() {
      return running;
    },
    stop: () => run(false),
  };
}
