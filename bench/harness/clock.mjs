// How long something took. On a shared machine, the clock also runs while others have the processor. The processor time
// of a process is in whole microseconds, too coarse for short times. So the smaller of the two counts, and for short
// times the clock alone.

/** Below this many milliseconds the clock is used: an interruption is unlikely. */
const short = 0.05;

/** A page has only the clock. */
const cpuUsage = globalThis.process?.cpuUsage;

/** @returns milliseconds */
export function clocked(work) {
  const before = cpuUsage?.();
  const start = performance.now();
  work();
  const wall = performance.now() - start;
  if (!before || wall < short) return wall;
  const { user, system } = cpuUsage(before);
  return Math.min(wall, (user + system) / 1000);
}
