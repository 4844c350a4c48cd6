// Compiles kernel/ to one freestanding wasm and inlines it for the library.
// Rebuilt only when a source, a flag or the compiler changed: their hash is kept beside the result.
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = fileURLToPath(new URL('..', import.meta.url));
const source = join(root, 'kernel');
const wasmFile = join(root, 'build/kernel.wasm');
const hashFile = join(root, 'build/kernel.hash');
const inlined = join(root, 'src/generated/kernel-wasm.ts');

// wasm32-wasip1 because libc++'s headers need a known target; -nostdlib keeps everything else out.
const flags = [
  '--target=wasm32-wasip1',
  '-std=c++20',
  '-O2',
  // Vectorised by hand where it pays; the compiler's own attempts only add bytes.
  '-fno-vectorize',
  '-fno-slp-vectorize',
  '-msimd128',
  '-mbulk-memory',
  '-mnontrapping-fptoint',
  '-fno-exceptions',
  '-fno-rtti',
  '-ffp-contract=off',
  '-Ikernel',
  '-Wall',
  '-Wextra',
  '-nostdlib',
  '-Wl,--no-entry',
  '-Wl,--export=__stack_pointer',
  '-Wl,--strip-all',
  '-Wl,-z,stack-size=65536',
];

/** Every C++ file below kernel/ but its native tests, by path relative to the root. */
function sources(folder = source) {
  return readdirSync(folder, { withFileTypes: true })
    .flatMap((entry) => {
      const path = join(folder, entry.name);
      if (entry.isDirectory()) return entry.name === 'test' ? [] : sources(path);
      return /\.(cpp|hpp)$/.test(entry.name) ? [path] : [];
    })
    .sort();
}

const files = sources();
const compiler = JSON.parse(readFileSync(join(root, 'node_modules/@yowasp/clang/package.json'), 'utf8'));
const hash = createHash('sha256').update(JSON.stringify([flags, compiler.version]));
for (const file of files) hash.update(relative(root, file)).update(readFileSync(file));
const digest = hash.digest('hex');
const upToDate =
  existsSync(wasmFile) && existsSync(inlined) && existsSync(hashFile) && readFileSync(hashFile, 'utf8') === digest;

if (!upToDate) {
  const { runClang } = await import('@yowasp/clang');
  const tree = {};
  for (const file of files) {
    const parts = relative(root, file).split(/[\\/]/);
    const name = parts.pop();
    let folder = tree;
    for (const part of parts) folder = folder[part] ??= {};
    folder[name] = readFileSync(file, 'utf8');
  }
  const started = performance.now();
  // The compiler prints its diagnostics itself; its exit is an exception that carries the whole file tree.
  const output = await runClang(['clang++', ...flags, '-o', 'kernel.wasm', 'kernel/abi.cpp'], tree, {
    fetchProgress: () => {},
  }).catch((error) => {
    console.error(`kernel: not compiled (${error.message})`);
    process.exit(1);
  });
  const wasm = output['kernel.wasm'];
  mkdirSync(join(root, 'build'), { recursive: true });
  mkdirSync(join(root, 'src/generated'), { recursive: true });
  writeFileSync(wasmFile, wasm);
  const base64 = Buffer.from(wasm).toString('base64');
  writeFileSync(
    inlined,
    `// Made by scripts/kernel.mjs from kernel/: do not edit.\nexport const kernelBase64 =\n  '${base64}';\n`,
  );
  writeFileSync(hashFile, digest);
  console.log(`kernel: compiled, ${wasm.length} bytes, ${((performance.now() - started) / 1000).toFixed(1)} s`);
}
