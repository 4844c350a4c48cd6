// Values of a vm context, as in Electron and in test runners; and two copies of the package in one program.
import { cpSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { createContext, runInContext } from 'node:vm';
import * as library from 'broadphase';
import { openTrace, record } from 'broadphase/trace';
import foreign from './foreign.cjs';

const context = createContext({});
const globals = runInContext('({ Array, Float32Array, Float64Array, Uint8Array })', context);
const kernel = readFileSync(fileURLToPath(import.meta.resolve('broadphase/kernel.wasm')));
console.log(foreign.everyForeign(library, globals, globals.Uint8Array.from(kernel)) === foreign.expectedOfForeign);
library.init(await WebAssembly.compile(kernel));

// The library itself in a realm that has nothing but the language: no TextEncoder, no console.
const script = readFileSync(
  fileURLToPath(import.meta.resolve('broadphase')).replace('index.js', 'script/broadphase.js'),
);
const bare = createContext({});
runInContext(`${script}`, bare);
console.log(
  String(runInContext('new broadphase.BroadPhase().set(7, 0, 0, 9, 9).set(9, 5, 5, 8, 8).update().pairs', bare)),
);
// A space of one copy is recorded, and asked, by another.
const space = runInContext('new broadphase.BroadPhase()', bare);
const recording = record(space);
space.set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
await recording.stop();
console.log(openTrace(recording.bytes()).frames);

// Hot reload: the same module again, and again.
cpSync('node_modules/broadphase', 'node_modules/broadphase-again', { recursive: true });
const again = await import('broadphase-again');
const reloaded = await import(`${import.meta.resolve('broadphase')}?again`);
const snapshot = new library.BroadPhase().set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update().snapshot();
for (const { BroadPhase } of [again, reloaded]) console.log(String(new BroadPhase().restore(snapshot).update().pairs));
