// Fuzzes the kernel: clang's libFuzzer makes up sequences of calls, guided by the lines they reach.
//
//   npm run fuzz                        a minute
//   npm run fuzz -- --seconds 3600      an hour
//   npm run fuzz -- --keep              afterwards makes kernel/test/corpus the smallest set that reaches as much
//   npm run fuzz -- --coverage          instead of fuzzing, says which lines of the kernel the corpus reaches
//   npm run fuzz -- FILE                runs one sequence, such as one that failed
//
// What is found on the way waits in build/fuzz/found for the next run. Where clang has no libFuzzer it says so.
import { mkdirSync, readdirSync, renameSync, rmSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { build, clangs, findCompiler, root, run, tests } from './native.mjs';

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    seconds: { type: 'string', default: '60' },
    keep: { type: 'boolean', default: false },
    coverage: { type: 'boolean', default: false },
  },
});

// Without the tracing of comparisons, whose operands are coordinates here: it would take half of the time.
const options = ['-O2', '-fsanitize=fuzzer,address,undefined', '-fno-sanitize-coverage=trace-cmp'];
const folder = join(root, 'build/fuzz');
const corpus = join(tests, 'corpus');
const found = join(folder, 'found');
const longest = 600; // bytes: about 60 calls
const slowest = 30; // seconds for one sequence

const probe = 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }\n';
const { compiler, reasons } = await findCompiler(clangs, options, probe, folder, ['-runs=1']);
if (!compiler) {
  const why = reasons.length ? `clang has no libFuzzer here\n  ${reasons.join('\n  ')}` : 'no clang found';
  console.log(`fuzz: skipped, ${why}\n  Install both (Debian: apt-get install clang libclang-rt-dev).`);
  process.exit(0);
}
mkdirSync(found, { recursive: true });
mkdirSync(corpus, { recursive: true });

const sources = [join(tests, 'fuzz.cpp')];
const show = { show: true, env: { UBSAN_OPTIONS: 'print_stacktrace=1' } };

if (values.coverage) {
  await coverage();
} else {
  const program = await build(compiler, options, sources, folder, 'fuzz');
  const limits = [`-max_len=${longest}`, '-len_control=0', `-timeout=${slowest}`, `-artifact_prefix=${folder}/`];
  const fuzzing = positionals.length
    ? [...limits, ...positionals]
    : [...limits, `-max_total_time=${Number(values.seconds)}`, '-print_final_stats=1', found, corpus];
  const { ok } = await run(program, fuzzing, show);
  if (!ok) {
    console.error(
      'fuzz: failed. With the fix, put the sequence into kernel/test/corpus as NAME.fixed, for the native tests.',
    );
    process.exit(1);
  }
  if (values.keep) await keep(program);
}

/** The smallest set of sequences, out of the corpus and what was found, that reaches as much as all of them. */
async function keep(program) {
  const merged = join(folder, 'merged');
  rmSync(merged, { recursive: true, force: true });
  mkdirSync(merged);
  const { ok } = await run(program, [
    '-set_cover_merge=1',
    '-use_counters=0',
    `-max_len=${longest}`,
    merged,
    corpus,
    found,
  ]);
  if (!ok) throw new Error('fuzz: the corpus was not merged');
  const regressions = readdirSync(corpus).filter((name) => name.endsWith('.fixed'));
  for (const name of regressions) renameSync(join(corpus, name), join(merged, name));
  rmSync(corpus, { recursive: true });
  renameSync(merged, corpus);
  const kept = readdirSync(corpus);
  const bytes = kept.reduce((sum, name) => sum + statSync(join(corpus, name)).size, 0);
  console.log(`fuzz: the corpus is ${kept.length} sequences, ${bytes} bytes`);
}

/** Runs the corpus, and what was found, once, in a build that counts lines. */
async function coverage() {
  const counting = ['-fsanitize=fuzzer', '-fprofile-instr-generate', '-fcoverage-mapping'];
  const program = await build(compiler, counting, sources, folder, 'coverage');
  const raw = join(folder, 'coverage.profraw');
  const data = join(folder, 'coverage.profdata');
  const steps = [
    [program, ['-runs=0', corpus, found], { env: { LLVM_PROFILE_FILE: raw } }],
    [compiler.replace('clang++', 'llvm-profdata'), ['merge', '-sparse', raw, '-o', data]],
    [
      compiler.replace('clang++', 'llvm-cov'),
      ['report', program, `-instr-profile=${data}`, '-ignore-filename-regex=kernel/test/|/usr/'],
      { show: true },
    ],
  ];
  for (const [tool, given, settings] of steps) {
    const { ok, output } = await run(tool, given, settings);
    if (!ok) throw new Error(`fuzz: ${tool} did not work\n${output}`);
  }
}
