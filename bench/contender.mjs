// One contender on one case, in a process of its own. The parent asks for one thing at a time:
//   { describe: module }      ->  what it can do: { dimensions, variants, answers, npm }
//   { prepare: { … } }        ->  makes the scene and the contender, runs and checks the first frames:
//                                 { fingerprints, wrong } or { unable } or { slow: milliseconds of a frame }
//   { warmUp: milliseconds }  ->  { frames } that were run: for so long, and until what is kept has settled
//   { round: { … } }          ->  { times } in milliseconds of each frame, and the means { atWork } on the processor and
//                                 { own } of what its own profiler says
//   { catchUp: frames }       ->  { played } frames in all, once it has run as many as that
//   { turn: frames }          ->  { ms } on the processor, of a frame
//   { finish: milliseconds }  ->  { garbage: bytes of JavaScript heap allocated per frame, peak: bytes of memory }
// and any of them can be answered by { error }. The scene's own motion is never timed. Every contender goes through the
// same seeded motion; a slow one gets less far. Who answers questions is made a contender of pairs by questions.mjs. `sink` keeps what the frames return from being optimised away.
import { readFileSync } from 'node:fs';
import { keysOf, referencePairs } from '../build/bench/library.mjs';
import { clocked } from './clock.mjs';
import { allocatedBy } from './garbage.mjs';
import { fingerprint } from './harness/fingerprint.mjs';
import { asking, makeQuestions, naive } from './questions.mjs';
import { openScene } from './scene.mjs';

/** A contender whose frames took so long in all is checked in two of them only, in milliseconds. */
const enough = 600;
const mostWarmUp = 3000;
/** Who keeps things between frames has filled them after so many, for which there is so much time, in milliseconds. */
const settling = 150;
const mostSettling = 1500;

let scene;
let contender;
/** Of the boxes as they are, as [a, b, …]: only to tell what is wrong. */
let exactPairs;
let sink = 0;
/** Frames that were run, whatever for. */
let played = 0;

function clockedFrame() {
  played++;
  scene.step();
  return clocked(() => {
    sink += contender.update(scene.boxes);
  });
}

const actions = {
  async describe(module) {
    const { dimensions, variants = [undefined], answers, npm } = await import(module);
    return { dimensions, variants, answers, npm };
  },

  async prepare({ module, variant, item, count, seed, checkedFrames, expected, slowest }) {
    const { create, findsPairs = true } = await import(module);
    scene = openScene(item, count, seed);
    const { dimensions, boxes, fixed } = scene;
    contender = await create({ dimensions, count: scene.count, boxes, fixed, variant });
    if (item.question) {
      const questions = makeQuestions(item, scene, seed);
      const exact = asking(naive(scene), item, questions, scene, true);
      exactPairs = () => {
        exact.update(scene.boxes);
        return keysOf(exact.pairs());
      };
      contender = asking(contender, item, questions, scene, contender.untimed);
    } else {
      exactPairs = () => referencePairs(scene.boxes, dimensions);
    }
    const fingerprints = [];
    let wrong;
    let spent = 0;
    for (let frame = 0; frame < checkedFrames && (!expected || frame < 2 || spent < enough); frame++) {
      const time = clockedFrame().wall;
      spent += time;
      // The first frame builds what the others keep: it may take longer.
      if (time > slowest * (frame === 0 ? 4 : 1)) return { slow: time };
      if (!findsPairs) continue;
      fingerprints.push(fingerprint(contender.pairs()));
      if (expected && !wrong && fingerprints[frame] !== expected[frame]) wrong = { frame: frame + 1, ...fault() };
    }
    return { fingerprints, wrong, spent, count: scene.count };
  },

  warmUp(milliseconds, settled = settling) {
    const start = performance.now();
    let frames = 0;
    for (; frames < mostWarmUp; frames++) {
      const spent = performance.now() - start;
      if (spent > mostSettling || (spent > milliseconds && frames >= settled)) break;
      clockedFrame();
    }
    return { frames };
  },

  round({ frames, budget }) {
    const times = [];
    let [own, atWork] = [0, 0];
    const end = performance.now() + budget;
    while (times.length === 0 || (times.length < frames && performance.now() < end)) {
      const time = clockedFrame();
      times.push(time.wall);
      atWork += time.atWork;
      own += contender.own?.() ?? 0;
    }
    return { times, atWork: atWork / times.length, own: contender.own && own / times.length, sink };
  },

  catchUp(frames) {
    while (played < frames) clockedFrame();
    return { played };
  },

  turn(frames) {
    clockedFrame(); // another has just been at work: the caches are his
    let atWork = 0;
    for (let frame = 0; frame < frames; frame++) atWork += clockedFrame().atWork;
    return { ms: atWork / frames };
  },

  async finish(milliseconds) {
    // What the engine allocates until it has compiled everything is nobody's garbage.
    actions.warmUp(milliseconds, 0);
    const frame = () => contender.update(scene.boxes);
    const garbage = await allocatedBy(frame, () => scene.step(), milliseconds);
    return { garbage, peak: peakMemory() };
  },
};

/** How the contender's pairs, or answers, differ from the exact ones: how many there are, how many it missed and added. */
function fault() {
  const exact = exactPairs();
  const found = keysOf(contender.pairs());
  let [i, j, missed, extra] = [0, 0, 0, 0];
  while (i < exact.length || j < found.length) {
    const [want, got] = [exact[i] ?? Infinity, found[j] ?? Infinity];
    if (want <= got) i++;
    if (got <= want) j++;
    if (want < got) missed++;
    if (got < want) extra++;
  }
  return { exact: exact.length, missed, extra };
}

/** Linux's own figure knows nothing of the process this one was forked from; Node's does. */
function peakMemory() {
  if (process.platform !== 'linux') return process.resourceUsage().maxRSS * 1024;
  return Number(/VmHWM:\s+(\d+)/.exec(readFileSync('/proc/self/status', 'utf8'))[1]) * 1024;
}

process.on('message', async ([action, value]) => {
  try {
    process.send(await actions[action](value));
  } catch (error) {
    process.send({ error: String(error?.stack ?? error) });
  }
});
