import { BroadPhase, type BroadPhaseOptions, findPairs, type Stats } from 'broadphase';
import { BroadPhase as FlatBroadPhase } from 'broadphase/2d';
import { BroadPhase as SolidBroadPhase } from 'broadphase/3d';
import { BroadPhase as FullBroadPhase } from 'broadphase/all';
import { coltech, Entity, World } from 'broadphase/ro';
import { openTrace, record } from 'broadphase/trace';

const options: BroadPhaseOptions = { dimensions: 2, technique: 'strip-sweep' };
const space: BroadPhase = new BroadPhase(options).set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
const pairs: Uint32Array = space.pairs;
const stats: Stats = space.stats;
// @ts-expect-error: there is no such technique
const wrong: BroadPhaseOptions = { technique: 'guess' };

const full: BroadPhase = new FullBroadPhase();
const recording = record(full);
full.setAll(new Float32Array([0, 0, 1, 1])).update();
await recording.stop();
const frames: number = openTrace(recording.bytes()).frames;

const solid: BroadPhase<3> = new BroadPhase({ dimensions: 3 }).set(7, 0, 0, 0, 1, 1, 1);
// @ts-expect-error: four numbers in 3D
const flatBox = () => solid.set(7, 0, 0, 1, 1);
// @ts-expect-error: it is in broadphase/all
const missing: BroadPhaseOptions = { technique: 'quadtree' };
const ofEntries: BroadPhase<2 | 3>[] = [new FlatBroadPhase().set(7, 0, 0, 1, 1), new SolidBroadPhase()];
const others = [flatBox, missing, ...ofEntries];

const world = new World(null, { coltech: new coltech.SpatialGrid(0, 0, 100, 100, 10) });
world.addEntity(new Entity(1, 1, 2, 2));
const answers = [`index ${pairs}`, `${stats.pairs} pair`, `${frames} frame`, findPairs([0, 0, 2, 2, 1, 1, 3, 3])];
console.log(answers.join('; '), wrong.technique);
void others;
