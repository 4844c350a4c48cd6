// What coherence is measured on: boxes of which few move, or all by little, and what is meant to make a structure that is
// kept pay for it. A play is the same in every frame each time it is opened. `move` is not timed: it moves the boxes,
// and writes them into the space where they are given in place. `ask` is: it makes the calls of a frame.
import { createRandom } from '../build/bench/library.mjs';
import { openScene } from './scene.mjs';

/**
 * Boxes that the scene knows to rest are set static before the first frame.
 * @param row `by`: 'set', those that moved are set one by one; or all are written in place. `trick`: one of those below.
 */
export function openPlay(row, seed) {
  const scene = openScene(row, row.count, seed);
  const { dimensions, count, boxes, fixed = 0 } = scene;
  const trick = row.trick ? tricks[row.trick](scene, createRandom(seed)) : {};
  const { step = scene.step.bind(scene), ask: askMore = () => {} } = trick;
  const how = row.by === 'set' ? oneByOne(scene) : inPlace(scene);
  return {
    dimensions,
    count,
    boxes,
    start(space) {
      how.start(space);
      for (let id = 0; id < fixed; id++) space.setStatic(id);
    },
    move(space, frame) {
      step(frame);
      how.moved(space);
    },
    ask(space, frame) {
      askMore(space, frame);
      how.ask(space);
    },
  };
}

function inPlace({ count, boxes }) {
  const write = (space) => space.boxes(count).set(boxes);
  return { start: write, moved: write, ask() {} };
}

function oneByOne({ dimensions, count, boxes }) {
  const stride = 2 * dimensions;
  const known = boxes.slice();
  const movers = new Uint32Array(count);
  let moving = 0;
  return {
    start: (space) => space.setAll(boxes),
    moved() {
      moving = 0;
      for (let id = 0, k = 0; id < count; id++, k += stride) {
        let moved = false;
        for (let at = k; at < k + stride; at++) {
          if (known[at] === boxes[at]) continue;
          known[at] = boxes[at];
          moved = true;
        }
        if (moved) movers[moving++] = id;
      }
    },
    ask(space) {
      for (let m = 0; m < moving; m++) {
        const id = movers[m];
        const k = stride * id;
        if (dimensions === 2) space.set(id, boxes[k], boxes[k + 1], boxes[k + 2], boxes[k + 3]);
        else space.set(id, boxes[k], boxes[k + 1], boxes[k + 2], boxes[k + 3], boxes[k + 4], boxes[k + 5]);
      }
    },
  };
}

/** A phase of a trick, in frames. */
const phase = 50;
const togglesAFrame = 10_000;

const tricks = {
  /** All boxes are anywhere else in every other frame, and rest in between. */
  teleport({ dimensions, count, boxes, world }, random) {
    return {
      step(frame) {
        if (frame % 2 === 1) return;
        for (let id = 0, k = 0; id < count; id++, k += dimensions) {
          for (let axis = 0; axis < dimensions; axis++, k++) {
            const size = boxes[k + dimensions] - boxes[k];
            boxes[k] = random() * (world - size);
            boxes[k + dimensions] = boxes[k] + size;
          }
        }
      },
    };
  },

  /** All are set static and rest, move all the same, are static no longer and move on, and so again. */
  'static, then moved'(scene) {
    const { count } = scene;
    return {
      step: (frame) => Math.floor(frame / phase) % 3 !== 0 && scene.step(),
      ask(space, frame) {
        const at = frame % (3 * phase);
        if (at !== 0 && at !== 2 * phase) return;
        for (let id = 0; id < count; id++) space.setStatic(id, at === 0);
      },
    };
  },

  /** Boxes become static, and cease to be, by the thousand: a million calls in a hundred frames. */
  toggles({ count }) {
    return {
      ask(space, frame) {
        const calls = Math.min(togglesAFrame, count);
        const first = (calls * frame) % count;
        const round = Math.floor((calls * frame) / count);
        for (let k = 0; k < calls; k++) space.setStatic((first + k) % count, round % 2 === 0);
      },
    };
  },

  /** A box as wide as a third of the world crosses it, and nothing else moves. */
  'huge mover'({ dimensions, boxes, world }) {
    const side = world / 3;
    const frames = 200;
    const place = (frame) => {
      const way = Math.abs(((frame / frames) % 2) - 1);
      for (let axis = 0; axis < dimensions; axis++) {
        boxes[axis] = way * (world - side);
        boxes[dimensions + axis] = boxes[axis] + side;
      }
    };
    place(0);
    return { step: place };
  },
};
