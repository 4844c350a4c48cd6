// The scene of a row, opened at its first frame: a seeded one of src/scenes, a motion of bench/motions, or a recording that
// is played forth and back. A row says { scene | motion | recording, dimensions, count, numbers, seed }.
import { readFileSync } from 'node:fs';
import { gunzipSync } from 'node:zlib';
import { createMotion, createScene, readRecording } from '../../build/bench/library.mjs';

export function openScene({ scene, motion, recording, dimensions, count, seed, speed }) {
  if (motion) return createMotion(motion, dimensions, count, seed);
  if (recording) return play(recording);
  const made = createScene(scene, count, speed === undefined ? { seed } : { seed, speed });
  const { boxes, fixed, world } = made;
  return { dimensions: made.dimensions, count, boxes, fixed, world, step: () => made.step() };
}

function play(path) {
  const bytes = readFileSync(path);
  const { dimensions, count, frames, frame } = readRecording(path.endsWith('.gz') ? gunzipSync(bytes) : bytes);
  const boxes = frame(0).slice();
  const period = Math.max(1, 2 * (frames - 1));
  return {
    dimensions,
    count,
    boxes,
    step(at) {
      const place = at % period;
      boxes.set(frame(place < frames ? place : period - place));
    },
  };
}
