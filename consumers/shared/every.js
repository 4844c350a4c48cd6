// What every consumer does: uses each entry of the package, and says what came out.
import { BroadPhase, findPairs, init } from 'broadphase';
import { BroadPhase as FlatBroadPhase } from 'broadphase/2d';
import { findPairs as findPairsInSpace } from 'broadphase/3d';
import { BroadPhase as FullBroadPhase } from 'broadphase/all';
import { Lines } from 'broadphase/draw';
import { coltech, Entity, World } from 'broadphase/ro';
import { Shard, Zones } from 'broadphase/shard';
import { openTrace, record } from 'broadphase/trace';

const fill = (space) => space.set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).set(11, 20, 20, 30, 30).update();

/** @param kernel the bytes of broadphase/kernel.wasm */
export async function every(kernel) {
  const lean = new BroadPhase();
  const recording = record(lean);
  fill(lean);
  await recording.stop();

  const world = new World(null, { coltech: new coltech.BroadPhase({ technique: 'spatial-grid' }) });
  for (const x of [0, 5, 20]) world.addEntity(new Entity(x, 0, 10, 10));
  world.step(16);

  const zones = new Zones({ borders: { x: [8] } });
  const [left, right] = [0, 1].map((zone) => new Shard(zones, zone, new BroadPhase({ events: true })));
  left.set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).set(11, 9, 9, 30, 30);
  const deltas = left.exchange();
  const cut = [left.update().pairs, right.update(deltas).pairs];

  const full = fill(new FullBroadPhase({ technique: 'quadtree' }));
  init(kernel); // from here on the lean build has every technique too
  const loaded = fill(new BroadPhase({ technique: 'r-tree' }));
  return [
    `index ${lean.pairs}`,
    `findPairs ${findPairs([0, 0, 10, 10, 5, 5, 15, 15])}`,
    `2d ${fill(new FlatBroadPhase()).pairs}`,
    `3d ${findPairsInSpace([0, 0, 0, 1, 1, 1, 1, 1, 1, 2, 2, 2])}`,
    `all ${full.pairs}`,
    `draw ${new Lines().addPairs(full).points()}`,
    `ro ${world.broadPhase.queryForCollisionPairs().length} pair`,
    `shard ${cut.join(' | ')}`,
    `trace ${openTrace(recording.bytes()).frames} frame`,
    `kernel.wasm ${loaded.pairs}`,
  ].join('; ');
}
