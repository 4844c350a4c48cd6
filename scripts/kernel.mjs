// Compiles kernel/ to one freestanding wasm and inlines it for the library.
// Rebuilt only when a source, a flag or the compiler changed: their hash is kept beside the result.
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { compile, flags, kernelSources } from './compile.mjs';

const root = fileURLToPath(new URL('..', import.meta.url));
const wasmFile = join(root, 'build/kernel.wasm');
const hashFile = join(root, 'build/kernel.hash');
const inlined = join(root, 'src/generated/kernel-wasm.ts');

const compiler = JSON.parse(readFileSync(join(root, 'node_modules/@yowasp/clang/package.json'), 'utf8'));
const hash = createHash('sha256').update(JSON.stringify([flags, compiler.version]));
for (const file of kernelSources()) hash.update(file).update(readFileSync(join(root, file)));
const digest = hash.digest('hex');
const upToDate =
  existsSync(wasmFile) && existsSync(inlined) && existsSync(hashFile) && readFileSync(hashFile, 'utf8') === digest;

if (!upToDate) {
  const started = performance.now();
  const wasm = await compile('kernel/abi.cpp').catch((error) => {
    console.error(`kernel: ${error.message}`);
    process.exit(1);
  });
  mkdirSync(join(root, 'build'), { recursive: true });
  mkdirSync(join(root, 'src/generated'), { recursive: true });
  writeFileSync(wasmFile, wasm);
  // As hexadecimal digits: longer than base64, but gzip still finds what repeats, so that less is shipped.
  const hex = Buffer.from(wasm).toString('hex');
  writeFileSync(
    inlined,
    `// Made by scripts/kernel.mjs from kernel/: do not edit.\nexport const kernelHex =\n  '${hex}';\n`,
  );
  writeFileSync(hashFile, digest);
  console.log(`kernel: compiled, ${wasm.length} bytes, ${((performance.now() - started) / 1000).toFixed(1)} s`);
}
