// How long something took. Where others use the machine too, the clock runs on while they have the processor; the time
// that a process had it is told in microseconds, too coarse for what is short. So the lesser of the two counts, and the
// clock alone for what is short.

/** Fewer milliseconds are taken from the clock: nobody is likely to have come between. */
const short = 0.05;

/** A page has the clock alone. */
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
