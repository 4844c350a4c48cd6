import { BroadPhase } from 'broadphase';

const { pairs } = new BroadPhase().set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
document.querySelector('#page').textContent = `index ${pairs}`;
const worker = new Worker(new URL('./own-worker.js', import.meta.url), { type: 'module' });
worker.addEventListener('message', ({ data }) => {
  document.querySelector('#worker').textContent = data;
});
