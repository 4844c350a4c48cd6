// When little changes: what an update costs then, against one that finds all anew (`strip-sweep`), in the same run.
// Each row is played frame by frame, from a cold start, by all in turns and several times over, and of every frame the
// least of its times counts: that is what the technique does in it, without what the machine did meanwhile. How much of
// that is left in the figures shows in what all anew is held against: itself, a second time in the same turns.
import { readdirSync } from 'node:fs';
import { resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { start } from './race.mjs';
import { against, leastOfEach, spread } from './statistics.mjs';

const script = fileURLToPath(new URL('./playback.mjs', import.meta.url));
/** The first is what the others are held against, and it is the last once more. */
const techniques = ['strip-sweep', 'auto', 'incremental'];
const players = [...techniques, techniques[0]];
/** Frames after which what is kept has been made and has settled; so many are then measured as steady motion. */
export const phases = { settled: 180, steady: 300 };
const frames = phases.settled + phases.steady;
/** For how many milliseconds a row is played in a round, not counting the last playing; and how long it may take in all. */
const [patience, most] = [10_000, 900_000];
/** Pairs are compared in one frame of so many; of tricks in every one. */
const every = 10;

/** How far a box moves in a frame, at most, in a physics scene and where all is fast: boxes are 10 wide. */
const [slow, fast] = [0.2, 2];

/**
 * What is played, in order. `kind` is what goals are set for. `nativeMs`: the best native library, by its earlier figure.
 * `cold`: between two updates the caches are filled with other things.
 */
export function rows(cases, traces) {
  const moving = ['uniform2d', 'uniform3d'].flatMap((scene) =>
    [10_000, 100_000].flatMap((count) => [
      { name: `${scene}, up to ${slow} a frame`, kind: 'slow', scene, count, speed: slow },
      { name: `${scene}, up to ${fast} a frame`, kind: 'fast', scene, count, speed: fast },
    ]),
  );
  const tiles = { kind: 'tiles', scene: 'tile-map', count: 101_000, by: 'set' };
  const still = { kind: 'still', scene: 'uniform2d', count: 100_000, speed: 0, by: 'set' };
  const world = { kind: 'adversarial', scene: 'uniform2d', count: 100_000 };
  return [
    { name: 'tile-map, 1,000 walkers set', ...tiles },
    { name: 'tile-map, 1,000 walkers set, cold caches', ...tiles, kind: 'cold', cold: true },
    { name: 'nothing moves', ...still },
    { name: 'nothing moves, 100,000 of them static', ...still, scene: 'tile-map', count: 101_000 },
    { name: 'static2d, movers set', kind: 'static', scene: 'static2d', count: 10_000, by: 'set', nativeMs: 0.2 },
    { name: 'static2d', kind: 'static', scene: 'static2d', count: 10_000, nativeMs: 0.2 },
    { name: 'static2d, movers set', kind: 'static', scene: 'static2d', count: 100_000, by: 'set', nativeMs: 4.6 },
    { name: 'static2d', kind: 'static', scene: 'static2d', count: 100_000, nativeMs: 4.6 },
    { name: 'static2d, movers set', kind: 'static', scene: 'static2d', count: 1_000_000, by: 'set', nativeMs: 117 },
    { name: 'static2d', kind: 'static', scene: 'static2d', count: 1_000_000, nativeMs: 117 },
    ...moving,
    { name: `uniform2d, up to ${fast} a frame`, kind: 'many', scene: 'uniform2d', count: 1_000_000, speed: fast },
    ...recordings(cases, traces),
    { name: 'teleport and rest in turns', ...world, trick: 'teleport' },
    { name: 'all static, then moved', ...world, trick: 'static, then moved' },
    { name: 'a million toggles of setStatic', ...world, scene: 'static2d', by: 'set', trick: 'toggles' },
    { name: 'one huge mover', ...world, speed: 0, by: 'set', trick: 'huge mover' },
  ];
}

/** The recorded scenes: those of the folder, if one is given, which are longer than the copies in the repository. */
function recordings(cases, traces) {
  const longer = traces ? readdirSync(traces) : [];
  return [...cases.values()]
    .filter(({ bestNativeMs, name }) => bestNativeMs && cases.get(name).recording)
    .map(({ name, recording, bestNativeMs: nativeMs }) => {
      const found = longer.find((file) => file.startsWith(`${name}-`) || file.startsWith(`${name}.`));
      const kind = name === 'smash' ? 'asleep' : 'recorded';
      return { name, kind, recording: found ? resolve(traces, found) : recording, nativeMs };
    });
}

/** Plays the rows, one after another, each in a process of its own; `done` is called with each result. */
export async function coherence(chosen, { seed, rounds }, done) {
  const results = [];
  for (const row of chosen) {
    const runner = start(script);
    const often = row.kind === 'adversarial' ? 1 : every;
    const { settled } = phases;
    const order = { row, seed, techniques: players, frames, settled, every: often, patience: rounds * patience };
    const answer = await runner.ask('play', order, most);
    runner.stop();
    const { name, kind, nativeMs } = row;
    const problem = answer.slow ? `over ${most / 60_000} minutes` : answer.error;
    results.push(problem ? { name, kind, problem } : { name, kind, nativeMs, ...judge(answer) });
    done(results.at(-1));
  }
  return results;
}

/** The figures of a row from the times of its frames. */
export function judge({ count, pairs, kept, wrong, bytes, playings, times }) {
  const least = times.map(leastOfEach);
  const parts = { filling: [0, phases.settled], steady: [phases.settled, undefined] };
  const held = (k, part) => against(least[k].slice(...part), least[0].slice(...part), count);
  const figures = techniques.map((name, k) => {
    const of = (part) => ({ ...spread(least[k].slice(...part)), ...(k > 0 && held(k, part)) });
    return [name, { ...of(parts.steady), filling: of(parts.filling), bytes: bytes[name] }];
  });
  const again = techniques.length;
  const itself = { filling: held(again, parts.filling), steady: held(again, parts.steady) };
  return { count, pairs, kept, wrong, playings, figures: Object.fromEntries(figures), itself };
}
