// As projects are compiled that know nothing of `exports`.
import { BroadPhase, findPairs } from 'broadphase';

const space: BroadPhase = new BroadPhase().set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
const found: Uint32Array = findPairs([0, 0, 2, 2, 1, 1, 3, 3]);
console.log(`index ${space.pairs}; ${found}`);
