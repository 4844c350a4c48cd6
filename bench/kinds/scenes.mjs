// Scenes: all boxes are given at once, and all pairs found; against packages, and in doubles. With few boxes, and with
// --full everywhere, every technique takes part.
import { BroadPhase } from '../../build/bench/library.mjs';
import { loadCases } from '../cases/index.mjs';
import { techniques } from '../contenders/techniques.mjs';
import { framesFor } from '../harness/frames.mjs';
import { packagesOf } from './objects.mjs';

export const title = 'Scenes';

/** Up to this many boxes every technique takes part. In these scenes, and in recordings, every package does. */
const fewer = 10_000;
const everyPackage = ['uniform2d', 'mixed2d', 'clustered2d', 'uniform3d', 'clustered3d'];
/** In all others, and with more boxes, only packages that were fastest somewhere. From this many boxes on, none. */
const ahead = ['flatbush', 'rbush (load)', 'box-intersect', 'rapier3d', 'jolt-physics'];
const tooMany = 500_000;

export async function rows({ names, counts, full }) {
  const packages = { 2: await packagesOf(2), 3: await packagesOf(3) };
  const chosen = [...loadCases().values()].filter(({ name }) => !names || names.includes(name));
  return chosen.flatMap(({ name, scene, recording, part, counts: usual = [0] }) => {
    const dimensions = name.includes('3d') ? 3 : 2;
    const of = recording ? { recording, part } : { scene };
    const wanted = recording ? [0] : (counts ?? usual.filter((count) => full || count >= fewer));
    return wanted.flatMap((count) => {
      const plan = framesFor(count || fewer);
      const every = full || recording || count <= fewer;
      const ours = every ? BroadPhase.techniques.filter((each) => each !== 'auto') : ['strip-sweep', 'incremental'];
      const allPackages = full || recording || (count === fewer && everyPackage.includes(name));
      const entering = packages[dimensions].filter((each) => allPackages || ahead.includes(each.name));
      const row = { kind: 'scenes', name, ...of, dimensions, count, by: 'boxes', seed: 1, plan };
      const float32 = {
        ...row,
        numbers: 'float32',
        budget: count > fewer ? 2500 : 500,
        contenders: [...techniques('auto', ...ours), ...(count < tooMany || full ? entering : [])],
      };
      if (recording) return [float32];
      return [float32, { ...row, numbers: 'double', by: 'setAll', contenders: techniques('auto', 'strip-sweep') }];
    });
  });
}
