// Compiles kernel/ to freestanding wasm, with all techniques and with a few, and inlines both for the library.
// Rebuilt only when a source, a flag or the compiler changed: their hash is kept beside the result.
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { compile, flags, kernelSources, lean, only } from './compile.mjs';
import { inline } from './inline.mjs';

const root = fileURLToPath(new URL('..', import.meta.url));
const kernels = [
  { name: 'kernel', more: [] },
  { name: 'kernel-lean', more: [only(lean)] },
].map((kernel) => ({
  ...kernel,
  wasm: join(root, `build/${kernel.name}.wasm`),
  inlined: join(root, `src/generated/${kernel.name}.ts`),
}));
const hashFile = join(root, 'build/kernel.hash');

const compiler = JSON.parse(readFileSync(join(root, 'node_modules/@yowasp/clang/package.json'), 'utf8'));
const hash = createHash('sha256').update(JSON.stringify([flags, kernels, compiler.version]));
for (const file of kernelSources()) hash.update(file).update(readFileSync(join(root, file)));
hash.update(readFileSync(new URL('./inline.mjs', import.meta.url)));
const digest = hash.digest('hex');
const upToDate =
  kernels.every(({ wasm, inlined }) => existsSync(wasm) && existsSync(inlined)) &&
  existsSync(hashFile) &&
  readFileSync(hashFile, 'utf8') === digest;

if (!upToDate) {
  mkdirSync(join(root, 'build'), { recursive: true });
  mkdirSync(join(root, 'src/generated'), { recursive: true });
  for (const { name, more, wasm, inlined } of kernels) {
    const started = performance.now();
    const bytes = await compile('kernel/abi.cpp', more).catch((error) => {
      console.error(`${name}: ${error.message}`);
      process.exit(1);
    });
    writeFileSync(wasm, bytes);
    const lines = Object.entries(inline(bytes)).map(([key, value]) => `export const ${key} =\n  '${value}';\n`);
    writeFileSync(inlined, `// Made by scripts/kernel.mjs from kernel/: do not edit.\n${lines.join('')}`);
    console.log(`${name}: compiled, ${bytes.length} bytes, ${((performance.now() - started) / 1000).toFixed(1)} s`);
  }
  writeFileSync(hashFile, digest);
}
