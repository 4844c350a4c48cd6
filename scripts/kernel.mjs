// Compiles kernel/ to freestanding wasm, with all techniques and with a few, and inlines each for the library. Also
// writes the definitions that kernel and library share (abi.mjs). Rebuilt only when a source, a flag or the compiler
// changed: their hash is kept beside the result.
//
//   node scripts/kernel.mjs              the two builds that tests and pages need
//   node scripts/kernel.mjs --package    also those of one dimension, which only the package has
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { writeAbi } from './abi.mjs';
import { compile, flags, kernelSources, lean, only, techniqueNames } from './compile.mjs';
import { moduleOf } from './inline.mjs';

const root = fileURLToPath(new URL('..', import.meta.url));
const kernels = [
  { name: 'kernel', techniques: techniqueNames(), dimensions: [2, 3], more: [] },
  { name: 'kernel-lean', techniques: lean, dimensions: [2, 3], more: [only(lean)] },
  ...[2, 3].map((dimension) => ({
    name: `kernel-${dimension}d`,
    techniques: lean,
    dimensions: [dimension],
    more: [only(lean), `-DDIMENSIONS=${dimension}`],
    ofPackage: true,
  })),
];

const compiler = JSON.parse(readFileSync(join(root, 'node_modules/@yowasp/clang/package.json'), 'utf8'));
const common = createHash('sha256').update(JSON.stringify([flags, compiler.version]));
for (const file of kernelSources()) common.update(file).update(readFileSync(join(root, file)));
for (const script of ['inline.mjs', 'kernel.mjs', 'streams.mjs'])
  common.update(readFileSync(join(root, 'scripts', script)));
const sources = common.digest('hex');

mkdirSync(join(root, 'build'), { recursive: true });
mkdirSync(join(root, 'src/generated'), { recursive: true });
writeAbi();
let decoder;
for (const kernel of kernels) {
  if (!kernel.ofPackage || process.argv.includes('--package')) {
    await make(kernel).catch((error) => {
      console.error(`${kernel.name}: ${error.message}`);
      process.exit(1);
    });
  }
}

async function make({ name, techniques, dimensions, more }) {
  const wasm = join(root, `build/${name}.wasm`);
  const inlined = join(root, `src/generated/${name}.ts`);
  const hashFile = join(root, `build/${name}.hash`);
  const made = [wasm, inlined, hashFile].every((file) => existsSync(file));
  if (made && readFileSync(hashFile, 'utf8') === sources) return;
  const started = performance.now();
  decoder ??= Buffer.from(await compile('kernel/decoder.cpp')).toString('hex');
  const bytes = await compile('kernel/abi.cpp', more);
  writeFileSync(wasm, bytes);
  writeFileSync(inlined, moduleOf(bytes, decoder, techniques, dimensions));
  writeFileSync(hashFile, sources);
  console.log(`${name}: compiled, ${bytes.length} bytes, ${((performance.now() - started) / 1000).toFixed(1)} s`);
}
