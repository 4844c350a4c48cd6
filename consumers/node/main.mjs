import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { every } from './every.js';

console.log(await every(readFileSync(fileURLToPath(import.meta.resolve('broadphase/kernel.wasm')))));
