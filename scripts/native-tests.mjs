// Builds the kernel's native tests with AddressSanitizer and UndefinedBehaviorSanitizer and runs them.
// Without a compiler it says so, and succeeds; a compiler whose sanitizers do not work is a failure only in CI. `npm
// run test:native -- ids` runs the tests with `ids` in their name; CXX chooses the compiler.
import { join } from 'node:path';
import { techniqueNames } from './compile.mjs';
import { build, clangs, findCompiler, flags, root, run, testSources } from './native.mjs';

const options = ['-fsanitize=address,undefined'];
const folder = join(root, 'build/native');

// A program with what the kernel needs: SSE4.1, vector shuffles, and a sanitizer that runs on this machine.
const probe = `#include <smmintrin.h>
typedef float f32x4 __attribute__((vector_size(16)));
int main(int count, char**) {
  f32x4 v = {float(count), 0, 0, 0};
  int* on_heap = new int(int(__builtin_shufflevector(v, v, 0, 4, 1, 5)[0]));
  int result = *on_heap - count;
  delete on_heap;
  return result;
}
`;

const names = process.env.CXX ? [process.env.CXX] : [...clangs, 'g++'];
const { compiler, reasons } = await findCompiler(names, options, probe, folder);
if (!compiler) {
  const why = reasons.length ? `no compiler here can build them\n  ${reasons.join('\n  ')}` : 'no C++ compiler found';
  console.log(
    `native tests: skipped, ${why}\n  Install g++ or clang with its sanitizers (Debian: apt-get install g++).`,
  );
  process.exit(process.env.CI && reasons.length ? 1 : 0);
}

const program = await build(compiler, options, testSources(), folder, 'tests').catch(({ message }) => {
  console.error(message);
  process.exit(1);
});
// Any number of techniques can be left out: `scripts/technique-sizes.mjs` leaves out all.
const none = [...flags, '-w', '-DTECHNIQUES=0', '-fsyntax-only', join(root, 'kernel/abi.cpp')];
const without = await run(compiler, none);
if (!without.ok) {
  console.error(`the kernel without techniques: not compiled\n${without.output}`);
  process.exit(1);
}

// A build with `auto`, but without the techniques it uses, would find no pairs: it must not compile.
const auto = 1 << techniqueNames().indexOf('auto');
const alone = await run(compiler, [...none.filter((flag) => flag !== '-DTECHNIQUES=0'), `-DTECHNIQUES=${auto}`]);
if (alone.ok || !alone.output.includes('a build with it has all three')) {
  console.error(`a kernel with auto alone: expected its static_assert to fail, got\n${alone.output || 'a kernel'}`);
  process.exit(1);
}

const { ok } = await run(program, process.argv.slice(2), {
  show: true,
  env: { UBSAN_OPTIONS: 'print_stacktrace=1' },
});
process.exit(ok ? 0 : 1);
