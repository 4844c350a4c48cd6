// Runs something while the reader attends to it: while the mouse is over it, it has the keyboard focus, or a finger
// tapped it. It stops when the mouse or the focus leaves, and after a tap elsewhere.
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

export function runWhileAttended(target: HTMLElement, start: () => void, stop: () => void): Attended {
  let running = false;
  const run = (wanted: boolean) => {
    if (wanted === running) return;
    running = wanted;
    target.toggleAttribute('data-running', running);
    if (running) start();
    else stop();
  };
  const keyboardIsHere = () => target.matches(':focus-visible') || target.querySelector(':focus-visible') !== null;

  target.addEventListener('pointerenter', (event) => {
    if (event.pointerType === 'mouse' && !prefersStill()) run(true);
  });
  target.addEventListener('pointerleave', (event) => {
    if (event.pointerType === 'mouse' && !keyboardIsHere()) run(false);
  });
  target.addEventListener('click', () => run(true));
  target.addEventListener('focusin', () => {
    if (!prefersStill() && keyboardIsHere()) run(true);
  });
  target.addEventListener('focusout', (event) => {
    if (!target.contains(event.relatedTarget as Node | null)) run(false);
  });
  target.addEventListener('keydown', (event) => {
    if (event.key === 'Enter') run(true);
    if (event.key === 'Escape') run(false);
  });
  document.addEventListener('pointerdown', (event) => {
    if (!target.contains(event.target as Node)) run(false);
  });

  return {
    get running() {
      return running;
    },
    stop: () => run(false),
  };
}
