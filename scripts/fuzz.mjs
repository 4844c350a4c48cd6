// Fuzzes the kernel: clang's libFuzzer makes up sequences of calls, guided by the lines they reach.
//
//   npm run fuzz                        a minute
//   npm run fuzz -- --seconds 3600      an hour
//   npm run fuzz -- --keep              afterwards reduces kernel/test/corpus to the smallest set with this coverage
//   npm run fuzz -- --coverage          instead of fuzzing, reports the coverage by native tests and corpus
//   npm run fuzz -- FILE                runs one sequence, such as one that failed
//
// New sequences are kept in build/fuzz/found for the next run. If clang has no libFuzzer, it says so.
import { mkdirSync, readdirSync, renameSync, rmSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { build, clangs, findCompiler, root, run, testSources, tests } from './native.mjs';

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    seconds: { type: 'string', default: '60' },
    keep: { type: 'boolean', default: false },
    coverage: { type: 'boolean', default: false },
  },
});

// Without tracing of comparisons, which would take half of the time: their operands are coordinates here.
const options = ['-O2', '-fsanitize=fuzzer,address,undefined', '-fno-sanitize-coverage=trace-cmp'];
const folder = join(root, 'build/fuzz');
const corpus = join(tests, 'corpus');
const found = join(folder, 'found');
const longest = 600; // bytes: about 60 calls
const slowest = 120; // seconds for one sequence; most take less than one, but the machine may be busy
const fewest = 0.95; // share of the kernel's lines that must be covered

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
  const limits = [
    `-max_len=${longest}`,
    '-len_control=0',
    '-entropic_scale_per_exec_time=1', // prefer fast sequences
    `-timeout=${slowest}`,
    `-artifact_prefix=${folder}/`,
  ];
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

/** The smallest set of sequences from the corpus and the new ones with the coverage of all. */
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

/** Runs the native tests, which run the corpus too, in a build that counts lines and branches. */
async function coverage() {
  const counting = ['-fprofile-instr-generate', '-fcoverage-mapping'];
  const program = await build(compiler, counting, testSources(), folder, 'coverage');
  const raw = join(folder, 'coverage.profraw');
  const data = join(folder, 'coverage.profdata');
  const profile = [program, `-instr-profile=${data}`, '-ignore-filename-regex=kernel/test/|/usr/'];
  const tool = (name) => compiler.replace('clang++', name);
  const must = async (program, given, settings) => {
    const { ok, output } = await run(program, given, settings);
    if (!ok) throw new Error(`fuzz: ${program} did not work\n${output}`);
    return output;
  };
  await must(program, [], { env: { LLVM_PROFILE_FILE: raw } });
  await must(tool('llvm-profdata'), ['merge', '-sparse', raw, '-o', data]);
  await must(tool('llvm-cov'), ['report', ...profile], { show: true });
  const { lines, branches } = JSON.parse(await must(tool('llvm-cov'), ['export', '-summary-only', ...profile])).data[0]
    .totals;
  const share = ({ covered, count }) => `${((100 * covered) / count).toFixed(2)} % (${covered} of ${count})`;
  console.log(`fuzz: native tests and corpus reach ${share(lines)} of the lines, ${share(branches)} of the branches`);
  if (lines.covered < fewest * lines.count) {
    console.error(`fuzz: fewer lines than ${100 * fewest} %`);
    process.exit(1);
  }
}
