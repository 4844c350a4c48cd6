// The scene of a case: a seeded one of src/scenes, moving or still, or a recording, played forth and back without end.
import { readFileSync } from 'node:fs';
import { gunzipSync } from 'node:zlib';
import { createScene, readRecording } from '../build/bench/library.mjs';

/** `speed` is the furthest a box moves in a frame, if not as the scenes have it. */
export function openScene({ scene, recording, still, speed }, count, seed) {
  if (recording) return play(recording);
  const made = createScene(scene, count, speed === undefined ? { seed } : { seed, speed });
  if (still) made.step = () => {};
  return made;
}

function play(path) {
  const bytes = readFileSync(path);
  const { dimensions, count, frames, frame } = readRecording(path.endsWith('.gz') ? gunzipSync(bytes) : bytes);
  const boxes = frame(0).slice();
  let at = 0;
  let direction = 1;
  return {
    dimensions,
    count,
    boxes,
    step() {
      if (frames < 2) return;
      if (at + direction < 0 || at + direction >= frames) direction = -direction;
      at += direction;
      boxes.set(frame(at));
    },
  };
}
