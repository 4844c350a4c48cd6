// The kernel comes from this server like any other file; nothing is inlined, evaluated or fetched from elsewhere.
import { BroadPhase, init } from './broadphase/index.js';

init(await WebAssembly.compileStreaming(fetch('./broadphase/kernel.wasm')));

const space = new BroadPhase({ technique: 'aabb-tree' }); // kernel.wasm has every technique
space.set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).set(11, 12, 12, 20, 20).update();
document.querySelector('#pairs').textContent = space.pairs.join(', ');
