// Compiles the kernel for this machine with sanitizers, for the native tests and the fuzzer.
// A program of a few lines tests which compilers there are, and whether their sanitizers run.
import { spawn } from 'node:child_process';
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { fileURLToPath } from 'node:url';

export const root = fileURLToPath(new URL('..', import.meta.url));
export const tests = join(root, 'kernel/test');

export const flags = [
  '-std=c++20',
  '-O1',
  '-g',
  '-msse4.1',
  '-ffp-contract=off',
  '-fno-omit-frame-pointer',
  '-fno-sanitize-recover=all',
  `-DCORPUS="${join(root, 'kernel/test/corpus')}"`,
  `-I${join(root, 'kernel')}`,
  '-Wall',
  '-Wextra',
  '-Werror',
];

/** clang++ without and with a version in its name, as Debian installs it. */
export const clangs = ['clang++', ...Array.from({ length: 12 }, (_, k) => `clang++-${25 - k}`)];

/** The C++ files of kernel/test, without the fuzzer. */
export const testSources = () =>
  readdirSync(tests)
    .filter((name) => name.endsWith('.cpp') && name !== 'fuzz.cpp')
    .map((name) => join(tests, name));

/** Runs a program to its end. `output` is its output, unless that went to the terminal. */
export function run(program, options, { show = false, env = {} } = {}) {
  return new Promise((resolve) => {
    const child = spawn(program, options, {
      stdio: ['ignore', ...(show ? ['inherit', 'inherit'] : ['pipe', 'pipe'])],
      env: { ...process.env, ...env },
    });
    let output = '';
    for (const stream of [child.stdout, child.stderr]) stream?.on('data', (text) => (output += text));
    child.on('error', (error) => resolve({ found: false, ok: false, output: error.message }));
    child.on('close', (code) => resolve({ found: true, ok: code === 0, output }));
  });
}

/**
 * The first of these compilers whose build of `program` with the arguments `given` runs. Otherwise `reasons` says why
 * each compiler found was rejected; it is empty if there is none.
 */
export async function findCompiler(names, options, program, folder, given = []) {
  mkdirSync(folder, { recursive: true });
  const source = join(folder, 'probe.cpp');
  const made = join(folder, 'probe');
  writeFileSync(source, program);
  const reasons = [];
  for (const name of names) {
    const compiled = await run(name, [...flags, ...options, source, '-o', made]);
    if (!compiled.found) continue;
    const ran = compiled.ok ? await run(made, given) : compiled;
    if (ran.ok) return { compiler: name, reasons };
    reasons.push(`${name}: ${ran.output.trim().split('\n').slice(0, 4).join('\n  ') || 'what it makes does not run'}`);
  }
  return { reasons };
}

/** A hash of all inputs of a program except the compiler's version. */
function digestOf(...settings) {
  const hash = createHash('sha256').update(JSON.stringify([flags, ...settings]));
  const names = readdirSync(join(root, 'kernel'), { recursive: true }).filter((name) => /\.(cpp|hpp)$/.test(name));
  for (const name of names.sort()) hash.update(name).update(readFileSync(join(root, 'kernel', name)));
  return hash.digest('hex');
}

/**
 * Compiles all sources in parallel and links them, unless nothing has changed since the last time. Returns the path of
 * the program.
 */
export async function build(compiler, options, sources, folder, name) {
  const digest = digestOf(compiler, options, sources);
  const hashFile = join(folder, `${name}.hash`);
  const output = join(folder, name);
  if (existsSync(output) && existsSync(hashFile) && readFileSync(hashFile, 'utf8') === digest) return output;
  const started = performance.now();
  mkdirSync(folder, { recursive: true });
  const objects = sources.map((source) => join(folder, `${basename(source)}.o`));
  const compiled = await Promise.all(
    sources.map((source, k) => run(compiler, [...flags, ...options, '-c', source, '-o', objects[k]])),
  );
  const result =
    compiled.find(({ ok }) => !ok) ?? (await run(compiler, [...flags, ...options, ...objects, '-o', output]));
  if (!result.ok) {
    rmSync(hashFile, { force: true });
    console.error(result.output);
    throw new Error(`${name}: not compiled`);
  }
  writeFileSync(hashFile, digest);
  console.log(`${name}: built with ${compiler} in ${((performance.now() - started) / 1000).toFixed(1)} s`);
  return output;
}
