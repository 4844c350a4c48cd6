// Prints what each technique weighs: what it adds to a kernel with none, and what all techniques weigh without it, since
// techniques share much. The kernel is compiled twice for each: takes minutes.
import { gzipSync } from 'node:zlib';
import { compile, only, techniqueNames } from './compile.mjs';

const names = techniqueNames().filter((name) => name !== 'auto');
const weigh = async (techniques) =>
  gzipSync(await compile('kernel/abi.cpp', [only(techniques), '-DTWINS']), { level: 9 }).length;
const kilobytes = (bytes) => (bytes / 1000).toFixed(1).padStart(5);

const none = await weigh([]);
const all = await weigh(names);
console.log(`none ${kilobytes(none)} kB, all ${kilobytes(all)} kB gzipped\n`);
console.log('| technique | alone | in all |\n| --- | ---: | ---: |');
for (const name of names) {
  const alone = (await weigh([name])) - none;
  const among = all - (await weigh(names.filter((other) => other !== name)));
  console.log(`| \`${name}\` | ${kilobytes(alone)} kB | ${kilobytes(among)} kB |`);
}
