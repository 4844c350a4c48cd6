// Import maps do not reach workers: there the library is imported by its address.
import { BroadPhase } from './node_modules/broadphase/dist/index.js';

addEventListener('message', () => {
  const { pairs } = new BroadPhase().set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
  postMessage(`index ${pairs}`);
});
