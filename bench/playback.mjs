// One play of plays.mjs, in a process of its own: every technique plays it, the same frames, as often as is asked for.
//   { play: { row, seed, techniques, frames, settled, playings, every, patience } }
//     ->  { count, pairs, kept, wrong, bytes, playings, times }, or { error }
// The first playing is not timed: in it the pairs of all are compared, and the engine compiles what runs. Of every other
// one the times of all frames are kept, in which techniques take turns, a few frames each.
import { BroadPhase } from '../build/bench/library.mjs';
import { clocked } from './clock.mjs';
import { fingerprint } from './fingerprint.mjs';
import { openPlay } from './plays.mjs';

/** Frames that a technique plays before it is another's turn: what it keeps is then in the caches, as in a game. */
const turn = 30;

/** A technique at work on a play. */
function open(row, seed, technique) {
  const play = openPlay(row, seed);
  const space = new BroadPhase({ dimensions: play.dimensions, technique });
  play.start(space);
  return { play, space };
}

function timed({ play, space }, frame) {
  play.move(space, frame);
  const { atWork } = clocked(() => {
    play.ask(space, frame);
    space.update();
  });
  return atWork;
}

/**
 * Plays all side by side, and compares their pairs with those of the first in every so many frames. `kept` is the share
 * of the frames once all has settled in which `auto` answered by what it keeps.
 */
function check({ row, seed, techniques, frames, settled, every }) {
  const players = techniques.map((technique) => open(row, seed, technique));
  const bytes = {};
  let [pairs, kept, wrong] = [0, 0, undefined];
  for (let frame = 0; frame < frames; frame++) {
    let expected;
    for (const [k, { play, space }] of players.entries()) {
      play.move(space, frame);
      play.ask(space, frame);
      space.update();
      const { reason, bytes: size } = space.stats;
      if (frame >= settled && techniques[k] === 'auto' && reason.includes('is kept')) kept++;
      bytes[techniques[k]] = Math.max(size, bytes[techniques[k]] ?? 0);
      pairs = Math.max(pairs, space.pairCount);
      if (wrong || frame % every > 0) continue;
      const found = fingerprint(space.pairs);
      expected ??= found;
      if (found !== expected) wrong = { technique: techniques[k], frame };
    }
  }
  const { count } = players[0].play;
  for (const technique of techniques) bytes[technique] /= count;
  for (const { space } of players) space.dispose();
  return { count, pairs, kept: kept / (frames - settled), wrong, bytes };
}

/** Plays all frames once with each technique. */
function playing({ row, seed, techniques, frames }, backwards) {
  const players = techniques.map((technique) => ({ ...open(row, seed, technique), times: [] }));
  const order = backwards ? [...players].reverse() : players;
  for (let from = 0; from < frames; from += turn) {
    for (const player of order) {
      for (let frame = from; frame < Math.min(frames, from + turn); frame++) player.times.push(timed(player, frame));
    }
  }
  for (const { space } of players) space.dispose();
  return players.map(({ times }) => times);
}

function play(order) {
  const { techniques, playings, patience } = order;
  const checked = check(order);
  const times = techniques.map(() => []);
  const start = performance.now();
  let played = 0;
  for (; played < playings && (played < 2 || performance.now() - start < patience); played++) {
    for (const [k, of] of playing(order, played % 2 === 1).entries()) times[k].push(of);
  }
  return { ...checked, playings: played, times };
}

process.on('message', ([, order]) => {
  try {
    process.send(play(order));
  } catch (error) {
    process.send({ error: String(error?.stack ?? error) });
  }
});
