// What the examples that move share: a button that plays and pauses, and a clock for what is shown as milliseconds.

/** Plays and pauses by the button and the P key. Starts paused for those who ask for less motion. */
export function playButton(button, changed) {
  const still = matchMedia('(prefers-reduced-motion: reduce)');
  let playing;
  const play = (now) => {
    playing = now;
    button.textContent = playing ? 'Pause' : 'Play';
    changed(playing);
  };
  button.addEventListener('click', () => play(!playing));
  addEventListener('keydown', ({ key }) => key === 'p' && play(!playing));
  still.addEventListener('change', () => play(!still.matches));
  play(!still.matches);
}

/** Times what is done often: `time(work)` does it, `mean()` is the milliseconds of one since it was last asked. */
export function stopwatch() {
  let [total, count] = [0, 0];
  return {
    time(work) {
      const started = performance.now();
      work();
      total += performance.now() - started;
      count++;
    },
    mean() {
      const mean = total / Math.max(1, count);
      [total, count] = [0, 0];
      return mean;
    },
  };
}
