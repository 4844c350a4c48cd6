// The scene of a row, opened at its first frame: a seeded one of src/scenes, a motion of bench/motions, or a recording
// that is played forward and back. A row has { scene | motion | recording, dimensions, count, numbers, seed }.
import { readFileSync } from 'node:fs';
import { gunzipSync } from 'node:zlib';
import { createJitter, createMotion, createScene, framesOf, openPlain } from '../../build/bench/library.mjs';

export function openScene(row) {
  const opened = open(row);
  return row.objects ? withThings(opened) : opened;
}

function open({ scene, motion, recording, part, dimensions, count, seed, speed, numbers, still, movers }) {
  if (motion) return createMotion(motion, dimensions, count, seed);
  if (movers !== undefined) return createJitter(count, movers, seed);
  if (recording) return play(recording, part);
  const made = createScene(scene, count, { seed, numbers, ...(speed !== undefined && { speed }) });
  const { boxes, fixed, world } = made;
  const step = still ? () => {} : () => made.step();
  return { dimensions: made.dimensions, count, boxes, fixed, world, step };
}

/** `part`: the first frame, and the frame before which to stop. */
function play(path, part = []) {
  const bytes = readFileSync(path);
  const { dimensions, count, frames, frame } = framesOf(
    openPlain(path.endsWith('.gz') ? gunzipSync(bytes) : bytes),
    ...part,
  );
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

/** A scene whose boxes are objects, as in a game: `moved` has those that moved in this frame. */
function withThings(scene) {
  const { boxes, count } = scene;
  const things = Array.from({ length: count }, (_, id) => ({ id, x: 0, y: 0, width: 0, height: 0, moved: true }));
  const put = () => {
    for (let id = 0, k = 0; id < count; id++, k += 4) {
      const thing = things[id];
      thing.moved = thing.x !== boxes[k] || thing.y !== boxes[k + 1];
      thing.x = boxes[k];
      thing.y = boxes[k + 1];
      thing.width = boxes[k + 2] - boxes[k];
      thing.height = boxes[k + 3] - boxes[k + 1];
    }
  };
  put();
  const step = (frame) => {
    scene.step(frame);
    put();
  };
  return { ...scene, things, step };
}
