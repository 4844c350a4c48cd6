// What the animated examples share: a button that plays and pauses, and a stopwatch for the milliseconds shown.

/** Plays and pauses by the button and the P key. Starts paused if the visitor prefers reduced motion. */
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

/** Times repeated work: `time(work)` runs it, `mean()` returns the mean milliseconds since its last call. */
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
