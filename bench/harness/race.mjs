// A race: several contenders on one scene, each in its own process, one at a time and in turns of a few frames. All
// begin at the scene's first frame. At the end, the boxes they saw and the pairs they found in timed frames are
// compared. A contender that saw other boxes has no figures; one that found other pairs is shown as wrong.
import { fork } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { strideFor } from './frames.mjs';
import { judge } from './judge.mjs';

const script = fileURLToPath(new URL('./process.mjs', import.meta.url));
/** Frames that a contender plays per turn: enough for the caches to hold its own data, as in a game. */
const turn = 20;
/** A contender that has not answered for this many milliseconds is abandoned, */
const patience = 60_000;
/** and sooner while it only shows how slow it is. */
const patienceAtFirst = 10_000;

/** Our techniques may take this many times as long as others: in a game the slowest of them is not slow. */
const oursMay = 4;

/** A process that does one thing at a time: `ask` returns its answer, or { error }. */
export function start() {
  const child = fork(script, { stdio: ['ignore', 'ignore', 'pipe', 'ipc'] });
  let complaint = '';
  child.stderr.on('data', (text) => {
    complaint = `${complaint}${text}`.slice(-2000);
  });
  return {
    ask: (action, value, limit = patience) =>
      new Promise((resolve) => {
        const settle = (answer) => {
          clearTimeout(timer);
          child.off('exit', ended).off('message', settle);
          resolve(answer);
        };
        const ended = (code, signal) =>
          settle({ error: `its process ended (${signal ?? code}) ${complaint.trim().split('\n').at(-1)}` });
        const timer = setTimeout(() => {
          child.kill('SIGKILL');
          settle({ slow: limit });
        }, limit);
        child.once('exit', ended).once('message', settle);
        child.send([action, value], (failure) => {
          if (failure) settle({ error: failure.message });
        });
      }),
    stop: () => child.kill('SIGKILL'),
  };
}

/**
 * @param row `{ scene | motion | recording, dimensions, count, numbers, seed, plan: { warmUp, timed }, contenders }`, where
 *   the contenders are `{ name, peer, module, variant }`, or have a `runner` that is asked as a process is; the first is held to be fast: it plays all frames;
 *   `budget`: milliseconds that any other may take, or Infinity: then all play all frames; `playings`: how often all is
 *   played, each time from the first frame, of which the least time of each frame counts
 */
export async function race({ contenders, ...row }) {
  const { budget = 1000, playings = 1 } = row;
  const entrants = [];
  for (const { name, peer, module, variant, runner: own } of contenders) {
    const runner = own?.() ?? start();
    const playsAll = entrants.length === 0 || budget === Infinity;
    const order = { module, variant, row, budget, stride: playsAll ? 1 : undefined };
    const { ms, error, count, slow } = await runner.ask('open', order, patienceAtFirst);
    const stride = order.stride ?? strideFor(ms, row.plan, peer === 'broadphase' ? oursMay * budget : budget);
    const entrant = { name, peer };
    entrants.push(entrant);
    if (error) entrant.error = firstLine(error);
    else if (slow || !stride) entrant.slow = slow ?? ms;
    if (entrant.error || entrant.slow) runner.stop();
    else Object.assign(entrant, { runner, order: { ...order, stride }, stride, count, notes: [] });
  }
  const running = () => entrants.filter(({ runner, error }) => runner && !error);
  for (let playing = 0; playing < playings; playing++) {
    // A different contender begins in each playing, since the first finds the caches as the last left them.
    const order = running();
    order.push(...order.splice(0, playing % Math.max(1, order.length)));
    await all(order, 'open', (entrant) => entrant.order);
    for (let over = false; !over; ) over = (await all(order, 'play', () => turn)).every(({ over }) => over !== false);
    for (const [k, notes] of (await all(order, 'notes', () => 0)).entries()) order[k].notes.push(notes);
  }
  for (const { runner } of entrants) runner?.stop();
  return judge(row, entrants);
}

/** Asks one after another, and records which gave no answer. */
async function all(entrants, action, value) {
  const answers = [];
  for (const entrant of entrants) {
    if (entrant.error) {
      answers.push({});
      continue;
    }
    const answer = await entrant.runner.ask(action, value(entrant));
    if (answer.error) entrant.error = firstLine(answer.error);
    else if (answer.slow) entrant.error = `no answer within ${answer.slow / 1000} s`;
    answers.push(answer);
  }
  return answers;
}

const firstLine = (text) => text.split('\n')[0];
