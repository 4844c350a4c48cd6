import kernel from 'broadphase/kernel.wasm?url';
import { page } from './page.js';

page(kernel, new Worker(new URL('./worker.js', import.meta.url), { type: 'module' }));
