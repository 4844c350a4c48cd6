// Hours of churn (test/promises/soak.ts): boxes come and go, techniques are switched, states restored. After each
// update everything is compared with a model, crowds of thousands of boxes with strip-sweep. The memory of kernels and
// JavaScript must not grow.
//   npm run soak                            an hour
//   npm run soak -- --hours 12 --seed 5
import { parseArgs } from 'node:util';
import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { bundle } from './bundle.mjs';

const { values } = parseArgs({
  options: { hours: { type: 'string', default: '1' }, seed: { type: 'string', default: String(Date.now() % 2 ** 31) } },
});
const hours = Number(values.hours);
const seed = Number(values.seed);
if (!(hours > 0) || !Number.isInteger(seed))
  throw new RangeError('soak: --hours takes a number above 0, --seed an integer');
const { soak } = await import(await bundle('test/promises/soak.ts', 'build/soak/soak.mjs'));

setFlagsFromString('--expose-gc');
const collectGarbage = runInNewContext('gc');
const megabytes = (bytes) => `${(bytes / 2 ** 20).toFixed(1)} MiB`;
const slack = 4 * 2 ** 20; // allowed growth of the JavaScript heap, from the first half to the second

console.log(`soak: ${hours} hours, seed ${seed}`);
const started = performance.now();
const duration = hours * 3_600_000;
const heaps = [];
const show = (totals) => {
  collectGarbage();
  heaps.push(process.memoryUsage().heapUsed);
  const elapsed = ((performance.now() - started) / 3_600_000).toFixed(3);
  console.log(
    `  ${elapsed} h: ${totals.updates} updates, ${totals.calls} calls, ${totals.restores} restores, ` +
      `${totals.kept} answers from what was kept; ` +
      `wasm ${megabytes(totals.wasm)}, in use ${megabytes(totals.used)}, heap ${megabytes(heaps.at(-1))}`,
  );
};
const totals = soak(seed, started + duration, Math.max(1000, duration / 20), show);
show(totals);

const half = heaps.length >> 1;
const [early, late] = [heaps.slice(1, half), heaps.slice(half)].map((some) => Math.min(...some));
if (late > early + slack) {
  console.error(`soak: the JavaScript heap has grown from ${megabytes(early)} to ${megabytes(late)}`);
  process.exit(1);
}
console.log(`soak: ${totals.updates} updates and ${totals.pairs} pairs were as they should be; memory was flat`);
