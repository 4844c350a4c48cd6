// Runs one race in a worker, so that the page stays responsive. As bench/ does in Node, all contenders take turns on
// the same frames, and their results are compared.
import { framesFor, strideFor } from '../../bench/harness/frames.mjs';
import { type Entrant, judge } from '../../bench/harness/judge.mjs';
import { Player } from '../../bench/harness/player.mjs';
import { createScene, type SceneName } from '../../src/scenes/index.ts';
import { type Contender, contenders } from './peers.ts';
import type { Race } from './records.ts';

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

/** The milliseconds that a contender may take in all, and the number of frames that show how slow it is. */
const [budget, probed] = [800, 20];
/** Frames that a contender plays before it is another's turn. */
const turn = 20;

/** The least mean of a frame in milliseconds: the clock is too coarse for less. */
const leastMean = 1e-4;

const say = (answer: Answer) => postMessage(answer);

async function run({ scene: name, count, names }: Order): Promise<Race> {
  const { dimensions } = createScene(name, 0);
  const entering = contenders.filter((each) => names.includes(each.name) && each.dimensions.includes(dimensions));
  const plan = framesFor(count);
  const entrants: (Entrant & { player?: Player })[] = [];
  for (const [k, contender] of entering.entries()) {
    const { name: who, peer } = contender;
    say({ progress: (0.3 * k) / entering.length, doing: `trying ${who}` });
    const entrant: Entrant & { player?: Player } = { name: who, peer };
    entrants.push(entrant);
    try {
      const trial = await playerOf(contender, name, count, 1);
      const ms = trial.probe(probed, budget / 3);
      const stride = k === 0 ? 1 : strideFor(ms, plan, budget);
      if (stride) Object.assign(entrant, { stride, count, player: await playerOf(contender, name, count, stride) });
      else entrant.slow = ms;
    } catch (error) {
      entrant.error = String(error);
    }
  }
  const running = entrants.filter(({ player }) => player);
  const frames = plan.warmUp + plan.timed;
  for (let frame = 0; frame < frames; frame += turn) {
    say({ progress: 0.3 + (0.7 * frame) / frames, doing: `frame ${frame} of ${frames}` });
    for (const { player } of running) player!.play(turn);
  }
  for (const entrant of running) entrant.notes = [entrant.player!.notes];
  const race = judge({ kind: 'scenes', name, dimensions, numbers: 'float32', plan }, entrants);
  // The clock of a page is coarse, so for short frames the mean says more than the median.
  for (const { total } of race.contenders) if (total) total.median = Math.max(leastMean, total.mean);
  return race;
}

/** A contender at the first frame of a scene of its own: all have the same motion. */
async function playerOf(contender: Contender, name: SceneName, count: number, stride: number): Promise<Player> {
  const scene = createScene(name, count);
  const { dimensions, boxes } = scene;
  return new Player(scene, await contender.create({ dimensions, count, boxes }), framesFor(count), stride);
}

addEventListener('message', ({ data }: MessageEvent<Order>) => {
  run(data).then(
    (race) => say({ race }),
    (error: unknown) => say({ failed: String(error) }),
  );
});
say({ contenders: contenders.map(({ name, dimensions }) => ({ name, dimensions })) });
