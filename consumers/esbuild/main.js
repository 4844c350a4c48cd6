import kernel from 'broadphase/kernel.wasm';
import { page } from './page.js';

page(kernel, new Worker('worker.js'));
