// Compiles C++ of this repository to one freestanding wasm, with the compiler that `npm ci` installs.
import { mkdirSync, readdirSync, readFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { clangs, run } from './native.mjs';

const root = fileURLToPath(new URL('..', import.meta.url));

// wasm32-wasip1 because libc++'s headers need a known target; -nostdlib keeps everything else out.
export const flags = [
  '--target=wasm32-wasip1',
  '-std=c++20',
  '-O2',
  // Vectorized by hand where it pays; the compiler's own vectorization only adds bytes.
  '-fno-vectorize',
  '-fno-slp-vectorize',
  '-msimd128',
  '-mbulk-memory',
  '-mnontrapping-fptoint',
  '-fno-exceptions',
  '-fno-rtti',
  '-ffp-contract=off',
  // Nor does it pay to unroll loops of unknown length.
  '-mllvm',
  '-unroll-runtime=false',
  // Engines optimise addresses and loads in loops themselves: docs/decisions/0015-builds-and-entries.md.
  '-mllvm',
  '-disable-lsr',
  '-mllvm',
  '-enable-load-pre=false',
  '-Ikernel',
  '-Wall',
  '-Wextra',
  '-nostdlib',
  '-Wl,--no-entry',
  '-Wl,--export=__stack_pointer',
  '-Wl,--compress-relocations',
  '-Wl,-z,stack-size=65536',
];

/** Every C++ file below kernel/ except its native tests, by path relative to the root. */
export function kernelSources(folder = join(root, 'kernel')) {
  return readdirSync(folder, { withFileTypes: true })
    .flatMap((entry) => {
      const path = join(folder, entry.name);
      if (entry.isDirectory()) return entry.name === 'test' ? [] : kernelSources(path);
      return /\.(cpp|hpp)$/.test(entry.name) ? [relative(root, path)] : [];
    })
    .sort();
}

/** The techniques of `import 'broadphase'`; 'broadphase/all' has all. */
export const lean = ['brute-force', 'strip-sweep', 'incremental', 'auto'];

/** The techniques in the order of their bits, which is that of BroadPhase.techniques. */
export function techniqueNames() {
  const header = readFileSync(join(root, 'kernel/space/techniques.hpp'), 'utf8');
  const [, names] = /enum class Technique : u32 \{([^}]*)\}/.exec(header);
  return names.split(',').flatMap((name) => name.trim().replaceAll('_', '-').replace('automatic', 'auto') || []);
}

/** A bit for each of these techniques. */
export function bitsOf(techniques) {
  const names = techniqueNames();
  return techniques.reduce((bits, technique) => {
    if (!names.includes(technique)) throw new Error(`there is no technique ${technique}, expected one of ${names}`);
    return bits | (1 << names.indexOf(technique));
  }, 0);
}

/** The flag that leaves out all techniques but these. */
export const only = (techniques) => `-DTECHNIQUES=${bitsOf(techniques)}`;

/** The flag that keeps the names of functions. */
export const keepNames = '-Wl,--strip-debug';

/**
 * The module that decodes the inlined text. It is compiled by the engine before it runs once: small is fast. Its memory
 * has room for any kernel and its text, so that it never grows; what is not written costs nothing.
 */
export const compileDecoder = () =>
  compile('kernel/decoder.cpp', ['-Oz', '-Wl,--initial-memory=4194304', '-Wl,--export=__heap_base']);

/** The wasm made from one source file, given by its path relative to the root, and the kernel's headers. */
export async function compile(entry, more = []) {
  const tree = {};
  for (const file of new Set([...kernelSources(), entry])) {
    const parts = file.split(/[\\/]/);
    const name = parts.pop();
    let folder = tree;
    for (const part of parts) folder = folder[part] ??= {};
    folder[name] = readFileSync(join(root, file), 'utf8');
  }
  return make([...flags, ...more, entry], tree, entry);
}

/** Compiles these files to wasm with the compiler from npm. */
async function make(options, tree, entry) {
  const { runClang } = await import('@yowasp/clang');
  // The compiler prints its diagnostics itself; its exit is an exception that carries the whole file tree.
  const strip = options.includes(keepNames) ? [] : ['-Wl,--strip-all'];
  const output = await runClang(['clang++', ...options, ...strip, '-o', 'out.wasm'], tree, {
    fetchProgress: () => {},
  }).catch((error) => {
    throw new Error(`${entry} was not compiled (${error.message})`);
  });
  return output['out.wasm'];
}

/**
 * The same in a third of the time, if the machine has a clang with support for wasm; only linked by the compiler from
 * npm. Only for `npm run dev`: the package is built by the same compiler everywhere.
 */
export async function compileSoon(entry, more = []) {
  const folder = join(root, 'build/dev');
  mkdirSync(folder, { recursive: true });
  const object = join(folder, 'object.o');
  const ofLinker = (flag) => flag.startsWith('-Wl') || flag === '-nostdlib';
  const ours = flags.filter((flag) => !ofLinker(flag) && !flag.startsWith('--target'));
  const options = [
    '--target=wasm32',
    '-ffreestanding',
    '-mmutable-globals',
    ...ours,
    ...more.filter((flag) => !ofLinker(flag)),
    '-c',
    entry,
    '-o',
    object,
  ];
  for (const clang of clangs) {
    const { found, ok, output } = await run(clang, options);
    if (!found || /no available targets|unable to create target|unknown argument/i.test(output)) continue;
    if (!ok) throw new Error(`${entry} was not compiled\n${output}`);
    const target = flags.filter((flag) => flag.startsWith('--target'));
    return make(
      [...target, ...[...flags, ...more].filter(ofLinker), 'object.o'],
      { 'object.o': readFileSync(object) },
      entry,
    );
  }
  return compile(entry, more);
}
