import { BroadPhase, type BroadPhaseOptions } from 'broadphase';
import { record } from 'broadphase/trace';

const options = { dimensions: 3 } satisfies BroadPhaseOptions<3>;
const space = new BroadPhase(options);
const recording = record(space);
space.set(7, 0, 0, 0, 10, 10, 10).set(9, 5, 5, 5, 15, 15, 15).update();
recording.stop().then(() => console.log(`index ${space.pairs}; ${recording.bytes().length > 0}`));
