// What is in a trace: how many boxes, how large, how dense, how many move, how many pairs.

import { isFloat64Array } from '../values.ts';
import { checkProgress, checkSource, type Frame, type FrameSource, worldOf } from './format.ts';
import { applyFrame, withSpaces } from './replay.ts';
import { type Bin, doublingHistogram, type Summary, summarize } from './statistics.ts';

/** The contents of a trace: see {@link survey}. Sizes are in the units of the boxes. */
export interface Survey {
  /** How many axes the boxes have. */
  dimensions: 2 | 3;
  /** How many frames there are. */
  frames: number;
  /** Whether any box has an id other than its place. */
  ids: boolean;
  /** Whether any box has a rule: a filter, a group or a reach, or is static or off. */
  rules: boolean;
  /** The size of the world along each axis, if it wraps around. */
  wrap?: readonly number[] | undefined;
  /** False if boxes that only touch are not pairs. */
  touching?: boolean | undefined;
  /** Whether any number does not fit float32. */
  doubles: boolean;
  /** How many boxes a frame has. */
  boxes: Summary;
  /** How many pairs a frame has. */
  pairs: Summary;
  /** The share of boxes that are new or moved, for each frame after the first. */
  moving: Summary;
  /** The sides of the boxes in the middle frame, one summary per axis. */
  sides: Summary[];
  /** Minima then maxima of all finite boxes of that frame. */
  world: number[];
  /** The area (3D: volume) of its boxes divided by that of the world. */
  density: number;
  /** Histograms of that frame. */
  histograms: {
    /** The longest side of each box. */
    side: Bin[];
    /** The number of other boxes that each box overlaps. */
    overlaps: Bin[];
  };
}

/**
 * Examines all frames of a source.
 * @param progress called after each frame
 *
 * @example
 * const space = new BroadPhase();
 * const recording = record(space);
 * for (let x = 0; x < 3; x++) space.set(7, x, 0, x + 4, 4).set(9, 5, 0, 9, 4).update();
 * const { boxes, moving } = survey(openTrace(recording.bytes()));
 * boxes.max; // → 2
 * moving.mean; // → 0.5
 */
export function survey(source: FrameSource, progress?: (done: number, total: number) => void): Survey {
  checkSource('survey', source);
  checkProgress('survey', progress);
  const { dimensions } = source;
  const options = { ...worldOf(source), dimensions };
  return withSpaces([options], ([space]) => {
    const middle = source.frames >> 1;
    const counts: number[] = [];
    const pairs: number[] = [];
    const moving: number[] = [];
    let ids = false;
    let rules = false;
    let doubles = false;
    let shape: ReturnType<typeof shapeOf> | undefined;
    let overlaps: Bin[] = [];
    for (const frame of source) {
      applyFrame(space, frame);
      space.update();
      counts.push(frame.count);
      pairs.push(space.pairCount);
      if (frame.index > 0) moving.push(frame.count === 0 ? 0 : frame.changed / frame.count);
      ids ||= frame.ids !== undefined;
      rules ||= (frame.rules ?? frame.groups ?? frame.reaches) !== undefined;
      doubles ||= isFloat64Array(frame.boxes);
      if (frame.index === middle) {
        shape = shapeOf(frame, dimensions);
        overlaps = doublingHistogram(overlapsOf(frame, space.pairs));
      }
      progress?.(frame.index + 1, source.frames);
    }
    shape ??= shapeOf({ boxes: new Float32Array() }, dimensions);
    return {
      dimensions,
      frames: source.frames,
      ids,
      rules,
      ...worldOf(source),
      doubles,
      boxes: summarize(counts),
      pairs: summarize(pairs),
      moving: summarize(moving),
      sides: shape.sides,
      world: shape.world,
      density: shape.density,
      histograms: { side: shape.histogram, overlaps },
    };
  });
}

/** The longest side of each box. */
export function longestSides(boxes: Frame['boxes'], dimensions: 2 | 3): Float64Array {
  const width = 2 * dimensions;
  return Float64Array.from({ length: boxes.length / width }, (_, box) => {
    let longest = 0;
    for (let k = box * width; k < box * width + dimensions; k++) {
      longest = Math.max(longest, boxes[k + dimensions] - boxes[k]);
    }
    return longest;
  });
}

function shapeOf({ boxes }: Pick<Frame, 'boxes'>, dimensions: 2 | 3) {
  const width = 2 * dimensions;
  const count = boxes.length / width;
  const world = [...new Array<number>(dimensions).fill(Infinity), ...new Array<number>(dimensions).fill(-Infinity)];
  const sides = Array.from({ length: dimensions }, () => new Float64Array(count));
  let volume = 0;
  for (let box = 0; box < count; box++) {
    let product = 1;
    for (let axis = 0; axis < dimensions; axis++) {
      const low = boxes[box * width + axis];
      const high = boxes[box * width + dimensions + axis];
      sides[axis][box] = high - low;
      product *= high - low;
      if (Number.isFinite(low)) world[axis] = Math.min(world[axis], low);
      if (Number.isFinite(high)) world[axis + dimensions] = Math.max(world[axis + dimensions], high);
    }
    if (Number.isFinite(product)) volume += product;
  }
  const room = sides.reduce((product, _, axis) => product * (world[axis + dimensions] - world[axis]), 1);
  return {
    world: world.map((value) => (Number.isFinite(value) ? value : 0)),
    sides: sides.map((values) => summarize(values.filter(Number.isFinite))),
    density: room > 0 && Number.isFinite(room) ? volume / room : 0,
    histogram: doublingHistogram(longestSides(boxes, dimensions)),
  };
}

function overlapsOf({ ids, count }: Frame, pairs: Uint32Array): Iterable<number> {
  const places = ids && new Map(Array.from(ids, (id, place) => [id, place]));
  const overlaps = new Float64Array(count);
  for (const id of pairs) overlaps[places ? places.get(id)! : id]++;
  return overlaps;
}
