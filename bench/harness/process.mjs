// A contender in a process of its own. The parent asks for one thing at a time, and each can be answered by { error }:
//   { open: { module, variant, row, budget } }      ->  { ms: milliseconds of a frame }
//   { open: { …, stride } }                         ->  begins again at the first frame, to play through
//   { play: frames }                                ->  { over }
//   { notes: … }                                    ->  what was noted of the frames that were timed

import { Player } from './player.mjs';
import { openScene } from './scene.mjs';

/** The most first frames used to find out how slow a contender is. */
const probed = 100;

let player;
let contender;

const actions = {
  async open({ module, variant, row, stride, budget }) {
    contender?.dispose?.();
    const { create } = await import(module);
    const scene = openScene(row);
    contender = await create({ ...scene, scene, variant, row });
    player = new Player(scene, contender, row.plan, stride ?? 1);
    return { ms: stride === undefined ? player.probe(probed, budget / 3) : 0, count: scene.count };
  },
  play(frames) {
    player.play(frames);
    return { over: player.over };
  },
  notes: () => player.notes,
};

process.on('message', async ([action, value]) => {
  try {
    process.send(await actions[action](value));
  } catch (error) {
    process.send({ error: String(error?.stack ?? error) });
  }
});
