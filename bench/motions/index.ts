// Motions as in games, in 2D and 3D, in doubles: a set to tune on, and a set of different ones to check on.
import { Bodies, type Motion } from './bodies.ts';
import { checkMoving } from './check.ts';
import { checkResting } from './check-resting.ts';
import { tune } from './tune.ts';

const check = { ...checkMoving, ...checkResting };
const all: Record<string, Motion> = { ...tune, ...check };

/** The names of both sets. */
export const motionNames = { tune: Object.keys(tune), check: Object.keys(check) };

/** Motions in a dense world: smaller than four times the volume of its boxes. */
const rooms: Record<string, number> = { pile: 3 };

export interface MotionScene {
  readonly dimensions: 2 | 3;
  readonly count: number;
  /** Minima then maxima of every box. */
  readonly boxes: Float64Array;
  readonly world: number;
  /** Moves the boxes into frame `frame`; frames are called one after another, from 1. */
  step(frame: number): void;
}

/** Opens a motion at its first frame. Same seed, same frames. */
export function createMotion(name: string, dimensions: 2 | 3, count: number, seed = 1): MotionScene {
  if (!Object.hasOwn(all, name)) {
    throw new RangeError(`No motion is called "${name}": expected one of ${Object.keys(all).join(', ')}.`);
  }
  const bodies = new Bodies(dimensions, count, seed, rooms[name]);
  const move = all[name](bodies);
  bodies.put();
  const { boxes, world } = bodies;
  return {
    dimensions,
    count,
    boxes,
    world,
    step(frame) {
      move(frame);
      bodies.put();
    },
  };
}
