// The fast inner loop: when a header is edited, runs the nearest tests within seconds. Compiles only the lean kernel,
// under a separate name, with the machine's own clang if there is one. Linker and test runner stay loaded, since they
// take as long to start as to run.
//
//   npm run dev                    watches kernel/; the tests named as the header is, else properties and set
//   npm run dev -- wrap events     these tests, whatever was edited
//   npm run dev -- --once          once, without watching
import { readdirSync, watch, writeFileSync } from 'node:fs';
import { basename, join, parse } from 'node:path';
import { fileURLToPath } from 'node:url';
import { createVitest } from 'vitest/node';
import { writeAbi } from './abi.mjs';
import { compile, compileSoon, lean, only } from './compile.mjs';
import { moduleOf } from './inline.mjs';

const root = fileURLToPath(new URL('..', import.meta.url));
const chosen = process.argv.slice(2).filter((name) => name !== '--once');
const usual = ['properties', 'set'];
const name = 'kernel-dev';
const generated = join(root, `src/generated/${name}.ts`);

const seconds = (since) => `${((performance.now() - since) / 1000).toFixed(1)} s`;
let decoder;

process.env.KERNEL = name; // for vitest.config.ts
const vitest = await createVitest('test', { root, project: ['unit'], watch: false });
await vitest.standalone();

/** The tests whose names start like this, except browser tests. */
const testsOf = (stem) =>
  readdirSync(join(root, 'test'), { recursive: true, encoding: 'utf8' })
    .filter((file) => file.endsWith('.test.ts') && basename(file).startsWith(stem))
    .map((file) => join('test', file));

/** The tests named like a header. */
const nearest = (header) => testsOf(parse(header).name.replaceAll('_', '-'));

/** Compiles the lean kernel, and runs tests on it. */
async function check(header) {
  const started = performance.now();
  decoder ??= Buffer.from(await compile('kernel/decoder.cpp')).toString('hex');
  const bytes = await compileSoon('kernel/abi.cpp', [only(lean)]);
  writeAbi();
  writeFileSync(generated, moduleOf(bytes, decoder, lean, [2, 3]));
  const compiled = seconds(started);
  const near = header ? nearest(header) : [];
  const tests = [chosen.flatMap(testsOf), near, usual.flatMap(testsOf)].find((each) => each.length > 0);
  vitest.invalidateFile(generated);
  const { testModules } = await vitest.runTestSpecifications(await vitest.globTestSpecifications(tests));
  console.log(`compiled in ${compiled}, tested in all by ${seconds(started)}`);
  return testModules.every((each) => each.ok());
}

let edited;
let running = false;
/** Runs again if something was edited meanwhile. */
async function again() {
  if (running) return;
  running = true;
  while (edited) {
    const header = edited;
    edited = undefined;
    await check(header).catch(({ message }) => console.error(message));
  }
  running = false;
}

if (process.argv.includes('--once')) {
  process.exitCode = Number(!(await check()));
  await vitest.close();
} else {
  await check().catch(({ message }) => console.error(message));
  console.log('waiting for a header of kernel/ to be edited');
  watch(join(root, 'kernel'), { recursive: true }, (_, file) => {
    if (!/\.(hpp|cpp)$/.test(file ?? '')) return;
    edited = file;
    again();
  });
}
