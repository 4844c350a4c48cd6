// How long something took, by the clock and on the processor. Where others use the machine too, the clock runs on while
// they have the processor; the processor's time of a process is told in microseconds, too coarse for what is short.

/** Fewer milliseconds are taken from the clock: nobody is likely to have come between. */
const short = 0.05;

/** @returns milliseconds: `wall` by the clock, `atWork` without what others did meanwhile */
export function clocked(work) {
  const before = process.cpuUsage();
  const start = performance.now();
  work();
  const wall = performance.now() - start;
  if (wall < short) return { wall, atWork: wall };
  const { user, system } = process.cpuUsage(before);
  return { wall, atWork: Math.min(wall, (user + system) / 1000) };
}
