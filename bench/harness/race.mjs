// A race: several contenders on one scene, each in a process of its own, one at a time and in turns of a few frames. All
// begin at the scene's first frame. At the end it is checked that all saw the same boxes and found the same pairs in the
// frames that they were timed in; who saw others has no figures, and who found others is shown as wrong.
import { fork } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { strideFor } from './frames.mjs';
import { leastOfEach, mean, spread } from './statistics.mjs';

const script = fileURLToPath(new URL('./process.mjs', import.meta.url));
/** Frames that a contender plays before it is another's turn: the caches are then its own, as in a game. */
const turn = 20;
/** A contender that has said nothing for so long is given up, in milliseconds. */
const patience = 60_000;
const parts = ['give', 'update', 'walk'];

/** A process that does one thing at a time: `ask` gives its answer, or { error }. */
export function start() {
  const child = fork(script, { stdio: ['ignore', 'ignore', 'pipe', 'ipc'] });
  let complaint = '';
  child.stderr.on('data', (text) => {
    complaint = `${complaint}${text}`.slice(-2000);
  });
  return {
    ask: (action, value) =>
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
          settle({ error: `no answer within ${patience / 1000} s` });
        }, patience);
        child.once('exit', ended).once('message', settle);
        child.send([action, value], (failure) => {
          if (failure) settle({ error: failure.message });
        });
      }),
    stop: () => child.kill('SIGKILL'),
  };
}

/**
 * @param row `{ scene | motion | recording, dimensions, count, numbers, seed, plan: { warmUp, timed } }`
 * @param contenders `[{ name, module, variant }]`. The first is held to be fast: it plays all frames.
 * @param settings `budget`: milliseconds that a contender may take; `playings`: how often all is played, each time from
 *   the first frame, of which the least time of each frame counts
 */
export async function race(row, contenders, { budget, playings = 1 }) {
  const entrants = [];
  for (const [k, { name, module, variant }] of contenders.entries()) {
    const runner = start();
    const order = { module, variant, row };
    const { ms, error, count } = await runner.ask('open', order);
    const stride = k === 0 ? 1 : strideFor(ms, row.plan, budget);
    if (error || !stride) {
      runner.stop();
      entrants.push({ name, ...(error ? { error: error.split('\n')[0] } : { slow: ms }) });
      continue;
    }
    entrants.push({ name, runner, order: { ...order, stride }, stride, count, notes: [] });
  }
  const running = () => entrants.filter(({ runner, error }) => runner && !error);
  for (let playing = 0; playing < playings; playing++) {
    // Who begins is another in each playing: the first finds the caches as the last left them.
    const order = running();
    order.push(...order.splice(0, playing % Math.max(1, order.length)));
    await all(order, 'open', ({ order }) => order);
    for (let over = false; !over; ) over = (await all(order, 'play', () => turn)).every(({ over }) => over !== false);
    for (const [k, notes] of (await all(order, 'notes', () => 0)).entries()) order[k].notes.push(notes);
  }
  for (const { runner } of entrants) runner?.stop();
  return judge(row, entrants);
}

/** Asks one after another, and notes who gave no answer. */
async function all(entrants, action, value) {
  const answers = [];
  for (const entrant of entrants) {
    if (entrant.error) {
      answers.push({});
      continue;
    }
    const answer = await entrant.runner.ask(action, value(entrant));
    if (answer.error) entrant.error = answer.error.split('\n')[0];
    answers.push(answer);
  }
  return answers;
}

/** The figures of a row out of what was noted. Pairs are those of the frames that the first contender was timed in. */
export function judge(row, entrants) {
  const [first] = entrants;
  if (first.error || first.slow)
    return { ...facts(row), error: first.error ?? 'too slow', contenders: entrants.map(problem) };
  const reference = first.notes[0];
  const { pairs } = reference;
  return {
    ...facts(row),
    count: first.count,
    pairs: { mean: mean(pairs), least: Math.min(...pairs), most: Math.max(...pairs) },
    contenders: entrants.map((entrant) =>
      entrant.error || entrant.slow ? problem(entrant) : figuresOf(entrant, reference, row.plan),
    ),
  };
}

const facts = ({ plan, recording: _, ...row }) => ({ ...row, frames: plan.timed, warmUp: plan.warmUp });

const problem = ({ name, error, slow }) => (error ? { name, error } : { name, slow });

function figuresOf({ name, notes, stride }, reference, plan) {
  const differing = difference(notes, reference);
  if (differing?.saw) return { name, error: `saw other boxes in frame ${differing.frame}` };
  const times = Object.fromEntries(parts.map((part) => [part, leastOfEach(notes.map((each) => each[part]))]));
  const total = times.update.map((update, k) => times.give[k] + update + times.walk[k]);
  const timed = total.length;
  const figures = { name, timed, total: spread(total), update: spread(times.update), give: spread(times.give) };
  if (stride === 1 && plan.warmUp > 0) {
    figures.start = spread(leastOfEach(notes.map(({ start }) => start)));
  }
  const [{ kept, bytes }] = notes;
  if (bytes > 0) Object.assign(figures, { kept: kept / timed, bytes });
  if (differing) figures.wrong = differing;
  return figures;
}

/** The first frame in which a contender saw other boxes, or found other pairs, than the reference in the same frame. */
export function difference(notes, reference) {
  const at = new Map(reference.frames.map((frame, k) => [frame, k]));
  for (const { frames, seen, found, pairs } of notes) {
    for (const [k, frame] of frames.entries()) {
      const same = at.get(frame);
      if (same === undefined || seen[k] !== reference.seen[same]) return { frame, saw: true };
      if (found[k] !== reference.found[same]) return { frame, pairs: pairs[k], exact: reference.pairs[same] };
    }
  }
  return undefined;
}
