// In a thread, beside one that uses the package itself.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { isMainThread, parentPort, Worker } from 'node:worker_threads';
import { every } from './every.js';

const answer = await every(readFileSync(fileURLToPath(import.meta.resolve('broadphase/kernel.wasm'))));
if (isMainThread) {
  const worker = new Worker(fileURLToPath(import.meta.url));
  worker.on('message', (heard) => console.log(heard === answer ? answer : `thread: ${heard}; main: ${answer}`));
} else {
  parentPort.postMessage(answer);
}
