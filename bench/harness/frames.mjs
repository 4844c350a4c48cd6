// Which frames a contender plays. They are chosen by count, never by time: every contender of a race starts at the
// scene's first frame, warms up over the same frames and is timed in the same frames. One that is too slow for all of
// them is timed in every second, fourth, eighth … of them. It plays the frame before each of these untimed, so that
// boxes move as far between two of its updates as for all others.

/** The smallest number of frames in which a contender is timed. */
export const fewestTimed = 5;

/**
 * How many frames warm up and how many are timed, by the number of boxes: enough for the engine to compile the code,
 * and for structure kept between frames to settle.
 */
export function framesFor(count) {
  if (count <= 2000) return { warmUp: 600, timed: 400 };
  if (count <= 20_000) return { warmUp: 120, timed: 280 };
  if (count <= 200_000) return { warmUp: 60, timed: 100 };
  return { warmUp: 20, timed: 20 };
}

/**
 * The stride of the frames in which a contender is timed: 1, or the smallest power of two with which it stays within
 * its milliseconds. Undefined if even the fewest frames take longer.
 */
export function strideFor(millisecondsAFrame, { warmUp, timed }, budget) {
  for (let stride = 1; Math.floor(timed / stride) >= Math.min(fewestTimed, timed); stride *= 2) {
    const frames = stride === 1 ? warmUp + timed : Math.ceil(warmUp / stride) + 2 * Math.floor(timed / stride);
    if (millisecondsAFrame * frames <= budget) return stride;
  }
  return undefined;
}

/** What a contender does in a frame: it is 'timed', plays 'along' untimed, or skips it ('no'). */
export function partOf(frame, { warmUp }, stride) {
  if (stride === 1) return frame < warmUp ? 'along' : 'timed';
  if (frame < warmUp) return frame % stride === 0 ? 'along' : 'no';
  const place = (frame - warmUp) % stride;
  return place === stride - 1 ? 'timed' : place === stride - 2 ? 'along' : 'no';
}
