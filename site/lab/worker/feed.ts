// The source of the boxes of each frame: a generator, which never ends, or a trace, which starts again.
import { type Frame, type FrameSource, gunzip, openAny } from 'broadphase/trace';
import { createScene, type SceneName } from '../../../src/scenes/index.ts';

export interface Feed {
  readonly dimensions: 2 | 3;
  /** What to show at first: minima, then maxima. */
  readonly world: readonly number[];
  /** The number of frames; undefined: no end. */
  readonly frames: number | undefined;
  /** The current frame, from 0. */
  readonly index: number;
  readonly frame: Frame;
  step(): void;
}

const topSpeed = 2;

/** A generator, which has made the frames up to `index`. With few boxes they move more slowly, as on the first page. */
export function generate(name: SceneName, count: number, index: number): Feed {
  const scene = createScene(name, count, { speed: Math.min(topSpeed, 0.02 * Math.sqrt(count)) });
  const { dimensions, boxes, world } = scene;
  const frame: { -readonly [K in keyof Frame]: Frame[K] } = { index: 0, count, ids: undefined, boxes, changed: count };
  for (; frame.index < index; frame.index++) scene.step();
  return {
    dimensions,
    world: [...new Array<number>(dimensions).fill(0), ...new Array<number>(dimensions).fill(world)],
    frames: undefined,
    frame,
    get index() {
      return frame.index;
    },
    step() {
      scene.step();
      frame.index++;
    },
  };
}

/** The most bytes of an unpacked file. */
const mostUnpacked = 2 ** 28;

/**
 * The frames of a trace, from frame `index` on.
 * @throws TraceError if the bytes are not a trace, or a broken one
 */
export async function play(bytes: Uint8Array, index: number): Promise<Feed> {
  const zipped = bytes[0] === 0x1f && bytes[1] === 0x8b;
  const source = await openAny(zipped ? await gunzip(bytes, mostUnpacked) : bytes);
  if (source.frames === 0) throw new RangeError('the trace has no frames');
  return new Player(source, index % source.frames);
}

class Player implements Feed {
  readonly dimensions: 2 | 3;
  readonly world: readonly number[];
  readonly frames: number;
  frame: Frame;
  readonly #source: FrameSource;
  #iterator: Iterator<Frame>;

  constructor(source: FrameSource, index: number) {
    this.#source = source;
    this.dimensions = source.dimensions;
    this.frames = source.frames;
    this.#iterator = source[Symbol.iterator]();
    this.frame = this.#iterator.next().value;
    this.world = worldOf([], this.dimensions);
    for (const { boxes, count } of source) {
      if (count === 0) continue;
      this.world = worldOf(boxes, this.dimensions);
      break;
    }
    while (this.frame.index < index) this.step();
  }

  get index(): number {
    return this.frame.index;
  }

  step(): void {
    let next = this.#iterator.next();
    if (next.done) {
      this.#iterator = this.#source[Symbol.iterator]();
      next = this.#iterator.next();
    }
    this.frame = next.value as Frame;
  }
}

/** Grounds and walls may reach far beyond where things happen, so only this share of the boxes determines the view. */
const usual = 0.98;
const beyond = 0.25;
/** But walls that are not much farther apart than what is between them are shown whole. */
const near = 2;

/** The extent of the boxes, without outliers. */
export function worldOf(boxes: ArrayLike<number>, dimensions: 2 | 3): number[] {
  const width = 2 * dimensions;
  const low: number[] = [];
  const high: number[] = [];
  for (let axis = 0; axis < dimensions; axis++) {
    const minima: number[] = [];
    const maxima: number[] = [];
    for (let at = axis; at < boxes.length; at += width) {
      if (Number.isFinite(boxes[at])) minima.push(boxes[at]);
      if (Number.isFinite(boxes[at + dimensions])) maxima.push(boxes[at + dimensions]);
    }
    const ends = [Float64Array.from(minima).sort(), Float64Array.from(maxima).sort()];
    const from = ends[0][Math.floor((1 - usual) * ends[0].length)] ?? 0;
    const to = ends[1][Math.floor(usual * (ends[1].length - 1))] ?? from + 1;
    const [least, most] = [ends[0][0] ?? 0, ends[1].at(-1) ?? 1];
    const spare = most - least <= near * (to - from) ? Infinity : beyond * Math.max(to - from, Number.MIN_VALUE);
    low.push(Math.max(least, from - spare));
    high.push(Math.min(most, to + spare));
    if (!(low[axis] < high[axis])) high[axis] = low[axis] + 1;
  }
  return [...low, ...high];
}
