// Uses the built package as users do, by the names in package.json: all builds of the library find the same pairs, each
// has its techniques and dimensions, and the entry points work together.
import { deepEqual, equal, ok, throws } from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import * as lean from 'broadphase';
import * as flat from 'broadphase/2d';
import * as solid from 'broadphase/3d';
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
for (const library of [all, flat, solid]) deepEqual(Object.keys(library), Object.keys(lean));
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

for (const option of [{ cellSize: 4 }, { bounds: [0, 0, 9, 9] }, { margin: 1 }]) {
  const [name] = Object.keys(option);
  const unheeded = { name: 'RangeError', message: new RegExp(`^${name}: got .*it to be left out.*'broadphase/all'`) };
  throws(() => new lean.BroadPhase(option), unheeded);
  throws(() => new flat.BroadPhase(option), unheeded);
  equal(new all.BroadPhase(option).technique, 'auto');
}

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

// Builds of one dimension find the same pairs, have it as their default, and refuse the other.
for (const technique of leanTechniques) deepEqual(pairsOf(flat, technique), expected, technique);
const cubes = Float32Array.from(
  { length: 6 * 2000 },
  (_, k) => ((Math.floor(k / 6) * [37, 61, 11][k % 3]) % 90) + (k % 6 > 2 ? 9 : 0),
);
const inSpace = lean.findPairs(cubes, { dimensions: 3 });
ok(inSpace.length > 0);
deepEqual(solid.findPairs(cubes), inSpace);
deepEqual(solid.findPairs(cubes, { dimensions: 3 }), inSpace);
deepEqual(flat.findPairs(boxes), lean.findPairs(boxes));
equal(new flat.BroadPhase().dimensions, 2);
equal(new solid.BroadPhase().dimensions, 3);
const other = (got, has) => ({
  name: 'RangeError',
  message: `dimensions: got ${got}, expected ${has}: 'broadphase' has both 2 and 3`,
});
throws(() => new flat.BroadPhase({ dimensions: 3 }), other(3, 2));
throws(() => new solid.BroadPhase({ dimensions: 2 }), other(2, 3));
throws(() => solid.findPairs([], { dimensions: 2 }), other(2, 3));
await record(new flat.BroadPhase()).stop();

// A kernel that the host has loaded has every technique, in both dimensions.
lean.init(readFileSync(fileURLToPath(import.meta.resolve('broadphase/kernel.wasm'))));
deepEqual(lean.BroadPhase.techniques, techniqueNames());
deepEqual(pairsOf(lean, 'quadtree'), expected);
console.log('the package: all builds find the same pairs');
