// One contender on one scene, in a process of its own. The parent sends what to do:
//   { prepare: { module, technique, scene, count, seed } }  ->  { checked: a fingerprint of each checked frame's pairs } or { unable }
//   { warmUp: milliseconds }                                ->  { warm: frames run }
//   { round: frames, budget: milliseconds }                 ->  { times: milliseconds of each frame, sink }
// and any of them can be answered by { error }. The scene's own motion is never timed. Every contender goes through the
// same seeded motion; a slow one gets less far. `sink` keeps what the frames return from being optimised away.
import { createScene } from '../build/bench/library.mjs';
import { checkedFrames, fingerprint } from './fingerprint.mjs';

let scene;
let contender;
let sink = 0;

function timedFrame() {
  scene.step();
  const start = performance.now();
  sink += contender.update(scene.boxes);
  return performance.now() - start;
}

const actions = {
  async prepare({ module, technique, scene: name, count, seed }) {
    const peer = await import(module);
    scene = createScene(name, count, { seed });
    if (!peer.dimensions.includes(scene.dimensions)) return { unable: `has no ${scene.dimensions}D` };
    contender = peer.create({ dimensions: scene.dimensions, count, technique });
    const checked = [];
    for (let frame = 0; frame < checkedFrames; frame++) {
      timedFrame();
      if (peer.findsPairs !== false) checked.push(fingerprint(contender.pairs()));
    }
    return { checked };
  },
  warmUp(milliseconds) {
    const end = performance.now() + milliseconds;
    let frames = 0;
    for (; frames < 3 || (performance.now() < end && frames < 1000); frames++) timedFrame();
    return { warm: frames };
  },
  round({ frames, budget }) {
    const times = [];
    const end = performance.now() + budget;
    while (times.length < 2 || (times.length < frames && performance.now() < end)) times.push(timedFrame());
    return { times, sink };
  },
};

process.on('message', async ([action, value]) => {
  try {
    process.send(await actions[action](value));
  } catch (error) {
    process.send({ error: String(error?.stack ?? error) });
  }
});
