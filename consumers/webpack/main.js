import { page } from './page.js';

const kernel = new URL('broadphase/kernel.wasm', import.meta.url);
page(kernel, new Worker(new URL('./worker.js', import.meta.url), { type: 'module' }));
