// Something that moves: called for every frame of the display.

/**
 * Calls `each` for every frame, with the milliseconds since the one before.
 * @param told called with the frames per second, after at least `interval` milliseconds each time
 * @returns what ends it
 */
export function everyFrame(
  each: (milliseconds: number) => void,
  interval: number,
  told: (rate: number) => void,
): () => void {
  let rate = 0;
  let frames = 0;
  let last = performance.now();
  let since = last;
  const frame = (now: number) => {
    request = requestAnimationFrame(frame);
    // The time of a frame is its beginning, which may be before this was called.
    each(Math.max(now - last, 0));
    last = now;
    frames++;
    if (now - since < interval) return;
    const measured = (1000 * frames) / (now - since);
    rate = rate === 0 ? measured : 0.7 * rate + 0.3 * measured;
    frames = 0;
    since = now;
    told(rate);
  };
  let request = requestAnimationFrame(frame);
  return () => cancelAnimationFrame(request);
}
