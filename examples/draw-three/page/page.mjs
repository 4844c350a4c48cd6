// What the animated examples share: a button that plays and pauses, and a stopwatch for the milliseconds shown.

/** Plays and pauses by the button and the P key; off the screen it pauses. Starts paused for who prefers less motion. */
export function playButton(button, changed) {
  const still = matchMedia('(prefers-reduced-motion: reduce)');
  let [playing, onScreen, running] = [!still.matches, true, undefined];
  const tell = () => {
    button.textContent = playing ? 'Pause' : 'Play';
    if (running === (playing && onScreen)) return;
    running = playing && onScreen;
    changed(running);
  };
  const play = (now) => {
    playing = now;
    tell();
  };
  button.addEventListener('click', () => play(!playing));
  addEventListener('keydown', ({ key }) => key === 'p' && play(!playing));
  still.addEventListener('change', () => play(!still.matches));
  new IntersectionObserver((entries) => {
    onScreen = entries.at(-1).isIntersecting;
    tell();
  }).observe(document.body);
  tell();
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
