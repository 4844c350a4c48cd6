// Uses what was built as its users do, by the names in package.json: both builds of the library find the same pairs,
// each has the techniques it says, and the entries go together.
import { deepEqual, equal, ok, throws } from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import * as lean from 'broadphase';
import * as all from 'broadphase/all';
import { coltech } from 'broadphase/ro';
import { Shard, Zones } from 'broadphase/shard';
import { openTrace, record } from 'broadphase/trace';
import { lean as leanTechniques, techniqueNames } from './compile.mjs';

const boxes = Float32Array.from(
  { length: 4 * 2000 },
  (_, k) => (((k >> 2) * (k % 2 ? 37 : 61)) % 500) + (k % 4 > 1 ? 9 : 0),
);
const pairsOf = ({ BroadPhase }, technique) => {
  const { pairs } = new BroadPhase({ technique }).setAll(boxes).update();
  const keys = Array.from({ length: pairs.length / 2 }, (_, k) => pairs[2 * k] * 2 ** 24 + pairs[2 * k + 1]);
  return keys.sort((a, b) => a - b);
};
const expected = pairsOf(all, 'brute-force');
ok(expected.length > 0);

deepEqual(all.BroadPhase.techniques, techniqueNames());
deepEqual(lean.BroadPhase.techniques, leanTechniques);
deepEqual(Object.keys(lean), Object.keys(all));
for (const library of [lean, all]) {
  for (const technique of library.BroadPhase.techniques) deepEqual(pairsOf(library, technique), expected, technique);
}

const missing = { name: 'RangeError', message: /^technique: got "quadtree", expected .*'broadphase\/all'/ };
const space = new lean.BroadPhase();
throws(() => new lean.BroadPhase({ technique: 'quadtree' }), missing);
throws(() => {
  space.technique = 'quadtree';
}, missing);
equal(space.technique, 'auto');
equal(new coltech.BroadPhase({ technique: 'quadtree' }).space.technique, 'quadtree');

const recording = record(space);
space.setAll(boxes).update();
await recording.stop();
equal(openTrace(recording.bytes()).frames, 1);

const zones = new Zones({ borders: { x: [250] } });
const shards = [0, 1].map((zone) => new Shard(zones, zone, new lean.BroadPhase({ events: true })));
for (let id = 0; id < boxes.length / 4; id++) shards[0].set(id, ...boxes.subarray(4 * id, 4 * id + 4));
const deltas = shards.flatMap((shard) => shard.exchange());
for (const shard of shards) shard.update(deltas.filter(({ to }) => to === shard.zone));
equal(shards[0].pairs.length + shards[1].pairs.length, 2 * expected.length);

// What a host has loaded itself has every technique, for both.
lean.init(readFileSync(fileURLToPath(import.meta.resolve('broadphase/kernel.wasm'))));
deepEqual(lean.BroadPhase.techniques, techniqueNames());
deepEqual(pairsOf(lean, 'quadtree'), expected);
console.log('the package: both builds find the same pairs');
