// CommonJS for Node before 20.19, where only the library itself can be required.
import { BroadPhase, type ManyIds } from 'broadphase';

const space = new BroadPhase().set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
// @ts-expect-error: three numbers
const wrong = () => space.set(7, 0, 0, 1);
let out: ManyIds | undefined;
for (let k = 0; k < 2; k++) out = space.queryPoints([7, 7], { out });
console.log(`index ${space.pairs}; ${out?.ids}`);
void wrong;
