// One frame from now: the display's next refresh where there is a display, a timer where there is none.

/**
 * Calls `callback` once, with the time in milliseconds, at the next frame.
 * @returns a function that cancels it
 */
export function nextFrame(callback: (now: number) => void): () => void {
  if (typeof requestAnimationFrame === 'function') {
    const frame = requestAnimationFrame(callback);
    return () => cancelAnimationFrame(frame);
  }
  const timer = setTimeout(() => callback(performance.now()), 1000 / 60);
  return () => clearTimeout(timer);
}
