// Runs one race in a worker, so that the page stays quick: the pairs of all contenders are compared first, then they are
// timed in turns, round after round, as bench/ does in Node.
import { fingerprint } from '../../bench/harness/fingerprint.mjs';
import { median, summary } from '../../bench/statistics.mjs';
import { createScene, type SceneName } from '../../src/scenes/index.ts';
import { contenders, type Running } from './peers.ts';
import type { Race, Result } from './records.ts';

export interface Order {
  scene: SceneName;
  count: number;
  names: string[];
}

export type Answer =
  | { contenders: { name: string; dimensions: readonly number[] }[] }
  | { progress: number; doing: string }
  | { race: Race }
  | { failed: string };

/** Milliseconds: of warming up, of a round, and of a frame after which a contender is left out. */
const [warmUp, budget, slowest] = [150, 250, 1500];
const rounds = 3;
const mostFrames = 200;

const say = (answer: Answer) => postMessage(answer);

async function run({ scene: name, count, names }: Order): Promise<Race> {
  const { dimensions } = createScene(name, 0);
  const entering = contenders.filter((each) => names.includes(each.name) && each.dimensions.includes(dimensions));
  const steps = entering.length * (1 + rounds);
  let step = 0;
  let pairs = 0;
  let expected = '';
  const results: Result[] = [];
  const running: { result: Result; contender: Running; scene: ReturnType<typeof createScene>; times: number[][] }[] =
    [];

  for (const { name: who, peer, create } of entering) {
    say({ progress: step++ / steps, doing: `checking ${who}` });
    const result: Result = { name: who, peer };
    results.push(result);
    // Each has a scene of its own, with the same motion.
    const scene = createScene(name, count);
    try {
      const contender = await create({ dimensions, count: scene.boxes.length / (2 * dimensions), boxes: scene.boxes });
      const frame = () => {
        scene.step();
        const start = performance.now();
        contender.update(scene.boxes);
        return performance.now() - start;
      };
      const first = frame();
      const print = fingerprint(contender.pairs());
      if (!expected) {
        expected = print;
        pairs = contender.pairs().length / 2;
      } else if (print !== expected) {
        result.problem = `finds other pairs than ${entering[0].name}`;
        continue;
      }
      if (first > 4 * slowest || frame() > slowest) {
        result.skipped = `over ${slowest / 1000} s a frame`;
        continue;
      }
      const end = performance.now() + warmUp;
      while (performance.now() < end) frame();
      running.push({ result, contender, scene, times: [] });
    } catch (error) {
      result.problem = String(error);
    }
  }
  for (let round = 0; round < rounds; round++) {
    for (const { result, contender, scene, times } of running) {
      say({ progress: step++ / steps, doing: `round ${round + 1} of ${rounds}: ${result.name}` });
      const mine: number[] = [];
      const end = performance.now() + budget;
      while (mine.length === 0 || (mine.length < mostFrames && performance.now() < end)) {
        scene.step();
        const start = performance.now();
        contender.update(scene.boxes);
        mine.push(performance.now() - start);
      }
      times.push(mine);
    }
  }
  for (const { result, times } of running)
    result.figures = { ...summary(times), median: Math.max(1e-4, median(times.map(mean))) };
  return { scene: name, dimensions, count, pairs, results };
}

const mean = (values: readonly number[]) => values.reduce((sum, value) => sum + value, 0) / values.length;

addEventListener('message', ({ data }: MessageEvent<Order>) => {
  run(data).then(
    (race) => say({ race }),
    (error: unknown) => say({ failed: String(error) }),
  );
});
say({ contenders: contenders.map(({ name, dimensions }) => ({ name, dimensions })) });
