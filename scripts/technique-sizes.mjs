// Prints the size of each technique: what it adds to a kernel with none, and what a kernel with all saves without it,
// since techniques share much. Compiles the kernel twice for each, which takes minutes.
import { gzipSync } from 'node:zlib';
import { compile, only, techniqueNames } from './compile.mjs';

const names = techniqueNames().filter((name) => name !== 'auto');
/** It cannot be built without that one, so it is measured on top of it, and left out with it. */
const base = { incremental: 'strip-sweep' };
const weigh = async (techniques) =>
  gzipSync(await compile('kernel/abi.cpp', [only(techniques), '-DTWINS']), { level: 9 }).length;
const kilobytes = (bytes) => (bytes / 1000).toFixed(1).padStart(5);

const none = await weigh([]);
const all = await weigh(names);
console.log(`none ${kilobytes(none)} kB, all ${kilobytes(all)} kB gzipped\n`);
console.log('| technique | alone | in all |\n| --- | ---: | ---: |');
for (const name of names) {
  const alone = (await weigh([name, base[name] ?? []].flat())) - (base[name] ? await weigh([base[name]]) : none);
  const others = names.filter((other) => other !== name);
  const apart = others.filter((other) => base[other] !== name);
  const among = (apart.length < others.length ? await weigh([...apart, name]) : all) - (await weigh(apart));
  console.log(`| \`${name}\` | ${kilobytes(alone)} kB | ${kilobytes(among)} kB |`);
}
