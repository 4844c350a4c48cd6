// One play of plays.mjs, in a process of its own: every technique plays it, the same frames, as often as is asked for.
//   { play: { row, seed, techniques, frames, settled, every, patience } }
//     ->  { count, pairs, kept, wrong, bytes, playings, times }, or { error }
// The first playing is not timed: in it the pairs of all are compared, and the engine compiles what runs. Of every other
// one the times of all frames are kept, in which techniques take turns, a few frames each.
import { BroadPhase } from '../build/bench/library.mjs';
import { clocked } from './clock.mjs';
import { fingerprint } from './harness/fingerprint.mjs';
import { preparePlay } from './plays.mjs';

/**
 * Frames that a technique plays before it is another's turn: what it keeps is then in the caches, as in a game. In the
 * first of them it is not, so turns begin with other frames in each playing; and with another player, for the first frame
 * of all is shorter for the first one.
 */
const turn = 30;
/** So many playings are enough, and so many the fewest: in the least of two the machine still shows. */
const [mostPlayings, fewestPlayings] = [40, 5];

/** Its multiples, but for their whole parts, are as far apart as can be, however many are taken. */
const goldenRatio = (Math.sqrt(5) - 1) / 2;

/**
 * What else a game reads and writes in a frame: enough to take the place of all that is in the caches of one core, which
 * hold a megabyte or two, while what the cores share may keep it.
 */
const otherData = new Uint8Array(8 * 2 ** 20);
/** No processor moves less than so many bytes between memory and caches. */
const cacheLine = 64;

function doOtherThings() {
  for (let at = 0; at < otherData.length; at += cacheLine) otherData[at]++;
}

/** A technique at work on a play. */
function open(openPlay, technique) {
  const play = openPlay();
  const space = new BroadPhase({ dimensions: play.dimensions, technique });
  play.start(space);
  return { play, space };
}

function timed({ play, space }, frame, cold) {
  if (cold) doOtherThings();
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
function check(openPlay, order) {
  const { frames, settled, every } = order;
  const techniques = [...new Set(order.techniques)];
  const players = techniques.map((technique) => open(openPlay, technique));
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

/** Plays all frames once with each technique; `played` is how often they were before. */
function playing(openPlay, { row, techniques, frames }, played) {
  const players = techniques.map((technique) => ({ ...open(openPlay, technique), times: [] }));
  const first = played % players.length;
  const order = [...players.slice(first), ...players.slice(0, first)];
  const early = Math.floor(turn * ((played * goldenRatio) % 1));
  for (let from = -early; from < frames; from += turn) {
    for (const player of order) {
      for (let frame = Math.max(0, from); frame < Math.min(frames, from + turn); frame++)
        player.times.push(timed(player, frame, row.cold));
    }
  }
  for (const { space } of players) space.dispose();
  return players.map(({ times }) => times);
}

function play(order) {
  const { row, seed, frames, techniques, patience } = order;
  const openPlay = preparePlay(row, seed, frames);
  const checked = check(openPlay, order);
  const times = techniques.map(() => []);
  const start = performance.now();
  let played = 0;
  const enough = () => played >= mostPlayings || performance.now() - start > patience;
  for (; played < fewestPlayings || !enough(); played++) {
    for (const [k, of] of playing(openPlay, order, played).entries()) times[k].push(of);
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
