import { BroadPhase } from 'broadphase';

postMessage(`index ${new BroadPhase().set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update().pairs}`);
