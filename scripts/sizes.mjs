// Prints what the build weighs: the kernel, and both builds of the library as a bundler would ship it, minified and gzipped.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { minify } from 'vite';

const dist = fileURLToPath(new URL('../dist/', import.meta.url));
const gzipped = (data) => gzipSync(data, { level: 9 }).length;
const bytes = (count) => count.toLocaleString('en').padStart(9);

const wasm = readFileSync(`${dist}kernel.wasm`);
const rows = [['kernel.wasm', wasm.length, gzipped(wasm)]];
for (const name of ['index.js', 'all.js']) {
  const library = readFileSync(dist + name, 'utf8');
  const minified = await minify(name, library, { module: true });
  if (minified.errors.length > 0) throw new Error(`cannot minify dist/${name}: ${minified.errors[0].message}`);
  rows.push(
    [name, library.length, gzipped(library)],
    [`${name}, minified`, minified.code.length, gzipped(minified.code)],
  );
}
console.log(`${''.padEnd(20)}${'bytes'.padStart(9)}  ${'gzipped'.padStart(9)}`);
for (const [name, raw, small] of rows) console.log(`${name.padEnd(20)}${bytes(raw)}  ${bytes(small)}`);
