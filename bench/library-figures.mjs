// What the library, as `import 'broadphase'` brings it, weighs as a bundler would ship it, and how long it takes from import to its first pairs, each time
// in a fresh process.
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { minify } from 'vite';
import { bundle } from '../scripts/bundle.mjs';
import { median } from './statistics.mjs';

const starts = 9;

export async function libraryFigures() {
  const file = await bundle('src/index.ts', 'build/bench/shipped.mjs', []);
  const { code } = await minify('shipped.mjs', readFileSync(file, 'utf8'), { module: true });
  const wasm = readFileSync(fileURLToPath(new URL('../build/kernel-lean.wasm', import.meta.url)));
  const program = `const start = performance.now();
    const { BroadPhase } = await import(${JSON.stringify(file)});
    const { pairs } = new BroadPhase().set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
    if (pairs.length !== 2) throw new Error('no pair');
    console.log(performance.now() - start);`;
  const run = () => Number(execFileSync(process.execPath, ['--input-type=module', '-e', program]));
  return {
    wasmBytes: wasm.length,
    minifiedBytes: code.length,
    gzippedBytes: gzipSync(code, { level: 9 }).length,
    importToPairsMs: median(Array.from({ length: starts }, run)),
  };
}
