// What coherence is measured on: boxes of which few move, or all by little, and what is meant to make a structure that is
// kept pay for it. A play is the same in every frame each time it is opened. `move` is not timed: it moves the boxes,
// and writes them into the space where they are given in place. `ask` is: it makes the calls of a frame.
// A game knows who moved and touches nobody else. So where boxes are set one by one, who moves and where to is found
// beforehand: a look at all boxes between two updates would leave the caches full of what no game reads.
import { createRandom } from '../build/bench/library.mjs';
import { openScene } from './scene.mjs';

/**
 * Gets a row ready for so many frames; each call of what it returns opens a play of it, for another space.
 * Boxes that the scene knows to rest are set static before the first frame.
 * @param row `by`: 'set', those that moved are set one by one; or all are written in place. `trick`: one of those below.
 */
export function preparePlay(row, seed, frames) {
  if (row.by !== 'set') return () => inPlace(openTricked(row, seed));
  const play = oneByOne(openTricked(row, seed), frames);
  return () => play;
}

/** A scene as its trick, if there is one, moves it; `ask` are the calls that the trick makes in a frame. */
function openTricked(row, seed) {
  const scene = openScene(row, row.count, seed);
  const { dimensions, count, boxes, fixed = 0 } = scene;
  const trick = row.trick ? tricks[row.trick](scene, createRandom(seed)) : {};
  const { step = scene.step.bind(scene), ask = () => {} } = trick;
  return { dimensions, count, boxes, fixed, step, ask };
}

function inPlace({ dimensions, count, boxes, fixed, step, ask }) {
  const write = (space) => space.boxes(count).set(boxes);
  return {
    dimensions,
    count,
    start(space) {
      write(space);
      setStatic(space, fixed);
    },
    move(space, frame) {
      step(frame);
      write(space);
    },
    ask,
  };
}

function oneByOne(scene, frames) {
  const { dimensions, count, fixed } = scene;
  const first = scene.boxes.slice();
  const recorded = recordMoves(scene, frames);
  const stride = 2 * dimensions;
  const most = recorded.reduce((so, { movers }) => Math.max(so, movers.length), 0);
  /** Of the frame that is played, as a game has just written them. */
  const now = { moving: 0, movers: new Uint32Array(most), boxes: new Float32Array(stride * most) };
  return {
    dimensions,
    count,
    start(space) {
      space.setAll(first);
      setStatic(space, fixed);
    },
    move(_space, frame) {
      const { movers, boxes } = recorded[frame];
      now.moving = movers.length;
      now.movers.set(movers);
      now.boxes.set(boxes);
    },
    ask(space, frame) {
      scene.ask(space, frame);
      const { moving, movers, boxes } = now;
      for (let m = 0, k = 0; m < moving; m++, k += stride) {
        const id = movers[m];
        if (dimensions === 2) space.set(id, boxes[k], boxes[k + 1], boxes[k + 2], boxes[k + 3]);
        else space.set(id, boxes[k], boxes[k + 1], boxes[k + 2], boxes[k + 3], boxes[k + 4], boxes[k + 5]);
      }
    },
  };
}

/** Plays all frames, and gives for each the boxes that moved in it, and where they then are. */
function recordMoves({ dimensions, count, boxes, step }, frames) {
  const stride = 2 * dimensions;
  const known = boxes.slice();
  const movers = new Uint32Array(count);
  const moved = new Float32Array(stride * count);
  return Array.from({ length: frames }, (_, frame) => {
    step(frame);
    let moving = 0;
    for (let id = 0, k = 0; id < count; id++, k += stride) {
      let same = true;
      for (let at = k; at < k + stride; at++) same &&= known[at] === boxes[at];
      if (same) continue;
      const box = boxes.subarray(k, k + stride);
      known.set(box, k);
      moved.set(box, stride * moving);
      movers[moving++] = id;
    }
    return { movers: movers.slice(0, moving), boxes: moved.slice(0, stride * moving) };
  });
}

function setStatic(space, fixed) {
  for (let id = 0; id < fixed; id++) space.setStatic(id);
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
