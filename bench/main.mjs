// The benchmark: what a game does in a frame, in the same frames for all. See README.md.
//   npm run bench -- --motions [flock,hail] [--set tune|check] [--count 10000] [--dimensions 2] [--by set|boxes]
//     [--frames 2000] [--playings 3]
import { parseArgs } from 'node:util';
import { bundle } from '../scripts/bundle.mjs';
import { machine } from './machine.mjs';

const { values: options, positionals } = parseArgs({
  allowPositionals: true,
  strict: false,
  options: {
    motions: { type: 'boolean' },
    set: { type: 'string' },
    count: { type: 'string' },
    dimensions: { type: 'string' },
    by: { type: 'string' },
    frames: { type: 'string' },
    playings: { type: 'string', default: '3' },
  },
});
const list = (text) => text?.split(',').filter(Boolean);
const numbers = (text) => list(text)?.map(Number);

if (options.motions) {
  await bundle('bench/library.ts', 'build/bench/library.mjs');
  const { motionRows, playMotion } = await import('./motions/rows.mjs');
  const { motionCells, motionTitles } = await import('./report/motions.mjs');
  const { textLine } = await import('./report/words.mjs');
  console.log(`Milliseconds of an update. ${machine.cpu}, ${machine.system}, Node ${machine.node}.\n`);
  const rows = motionRows({
    names: positionals.length > 0 ? positionals.flatMap(list) : undefined,
    set: options.set,
    counts: numbers(options.count),
    dimensions: numbers(options.dimensions),
    by: list(options.by),
    frames: options.frames && Number(options.frames),
  });
  console.log(textLine(motionTitles, motionTitles));
  const settings = { budget: 60_000, playings: Number(options.playings) };
  for (const row of rows) console.log(textLine(motionTitles, motionCells(await playMotion(row, settings))));
} else await import('./run.mjs');
