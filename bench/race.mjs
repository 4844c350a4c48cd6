// One case and number of boxes: every contender in a fresh process of its own, all started and checked, two at a time,
// before any is timed; then timed in turns, one at a time, round after round; at last `auto` meets those near it again.
import { fork } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { duel } from './duel.mjs';
import { checkedFrames } from './harness/fingerprint.mjs';
import { summary } from './statistics.mjs';

const script = fileURLToPath(new URL('./contender.mjs', import.meta.url));
/** A contender that has said nothing for so long is given up, in milliseconds. */
const patience = 15_000;
/** How many processes get ready at the same time. */
const atOnce = 2;
const garbageBudget = 60;
/** In milliseconds: long enough for the engine to compile what runs. */
const warmUp = 300;

/** A process that does one thing at a time: `ask` gives its answer, or { error }. */
export function start(program = script) {
  const child = fork(program, { stdio: ['ignore', 'ignore', 'pipe', 'ipc'] });
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
          settle({ error: `its process ended (${signal ?? code}) ${lastLine(complaint)}` });
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

/** The number of boxes and the fingerprints of the first frames' exact pairs. */
export async function reference(setting) {
  const runner = start();
  const { count, item } = setting;
  const module = item.question ? './floors/answers.mjs' : './floors/reference.mjs';
  // Among so many boxes the exact reference takes seconds a frame.
  const frames = count >= 500_000 || item.still ? 1 : count >= 100_000 ? 2 : checkedFrames;
  const answer = await runner.ask('prepare', { ...setting, module, checkedFrames: frames, slowest: 1e9 }, 120_000);
  runner.stop();
  if (answer.error || answer.slow) throw new Error(`the reference failed: ${answer.error ?? `${answer.slow} ms`}`);
  return answer;
}

/**
 * Races the contenders, and gives for each its figures, or why there are none.
 * @param budget what a round of one contender may take, in milliseconds, beyond its first frame
 */
export async function race(contenders, setting, { rounds, frames, budget, slowest }) {
  const { fingerprints: expected, count } = await reference(setting);
  const results = contenders.map(({ name, peer, variant }) => ({ name, peer, variant }));
  const running = new Map();

  await inTurns(atOnce, contenders, async ({ module, variant }, k) => {
    const runner = start();
    const result = results[k];
    const ask = { ...setting, module, variant, checkedFrames: expected.length, expected, slowest };
    const answer = await runner.ask('prepare', ask);
    const warm = answer.error || answer.slow ? answer : await runner.ask('warmUp', Math.max(0, warmUp - answer.spent));
    if (!note(result, warm, slowest)) return runner.stop();
    if (answer.wrong) result.wrong = answer.wrong;
    running.set(result, { runner, rounds: [], own: [] });
  });

  for (let round = 0; round < rounds; round++) {
    for (const [result, { runner, rounds, own }] of running) {
      const answer = await runner.ask('round', { frames, budget });
      if (!note(result, answer, slowest)) {
        runner.stop();
        running.delete(result);
        continue;
      }
      rounds.push(answer.times);
      result.atWork = Math.min(answer.atWork, result.atWork ?? Infinity);
      if (answer.own !== undefined) own.push(answer.own);
    }
  }

  for (const [result, { rounds, own }] of running) {
    result.figures = summary(rounds);
    if (own.length > 0) result.own = own.sort((a, b) => a - b)[own.length >> 1];
  }
  const met = setting.item.question
    ? undefined
    : await duel(results, (result, action, value) => running.get(result).runner.ask(action, value));

  await inTurns(atOnce, [...running], async ([result, { runner }]) => {
    const { garbage, peak } = await runner.ask('finish', garbageBudget);
    Object.assign(result, { garbage, peak });
    runner.stop();
  });
  return { count, pairs: Number(expected[0].split(' ')[0]), duel: met, results };
}

/** Notes why a contender gave no answer; says whether it gave one. */
function note(result, { error, slow }, slowest) {
  if (error) result.problem = error.split('\n')[0];
  else if (slow) result.skipped = `over ${seconds(Math.max(slow, slowest))} a frame`;
  return !error && !slow;
}

/** Works through the items, so many at a time. */
async function inTurns(atOnce, items, work) {
  let next = 0;
  const worker = async () => {
    while (next < items.length) {
      const k = next++;
      await work(items[k], k);
    }
  };
  await Promise.all(Array.from({ length: atOnce }, worker));
}

const seconds = (milliseconds) => `${Math.round(milliseconds / 100) / 10} s`;

const lastLine = (text) => text.trim().split('\n').at(-1);
