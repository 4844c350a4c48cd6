import kernel from 'url:broadphase/kernel.wasm';
import { page } from './page.js';

page(kernel, new Worker(new URL('./worker.js', import.meta.url), { type: 'module' }));
