// A page's part: shows what came out here, and in a worker where the bundler makes one.
import { every } from './every.js';

const show = (where, answer) => {
  document.querySelector(where).textContent = answer;
};

/** @param kernel where broadphase/kernel.wasm is */
export async function page(kernel, worker) {
  const bytes = await (await fetch(kernel)).arrayBuffer();
  show('#page', await every(bytes).catch(String));
  worker?.addEventListener('message', ({ data }) => show('#worker', data));
  worker?.addEventListener('error', ({ message }) => show('#worker', message));
  worker?.postMessage(bytes);
}
