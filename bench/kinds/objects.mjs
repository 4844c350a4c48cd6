// A whole frame of a game, from objects in doubles: boxes are given, pairs found, and both objects of each pair read.
import { readdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { byHand, ours } from '../contenders/objects.mjs';
import { framesFor } from '../harness/frames.mjs';

const path = (file) => fileURLToPath(new URL(file, import.meta.url));
const counts = [20, 50, 100, 200, 500, 1000, 2000, 10_000, 100_000];
/** How much moves: all, or one in twenty. */
const scenes = { 'all move': 'uniform2d', '5 % move': 'static2d' };

export const title = 'A whole frame, from objects';

/** Counts for few moving boxes, in a run of everything. */
const someCounts = [100, 1000, 10_000, 100_000];

export async function rows({ names, counts: wanted = counts, full }) {
  const packages = (await packagesOf(2)).filter(({ npm }) => npm !== null);
  const own = [...ours, ...byHand].map((variant) => ({
    name: variant,
    peer: byHand.includes(variant) ? 'by hand' : 'broadphase',
    module: path('../contenders/objects.mjs'),
    variant,
  }));
  return wanted.flatMap((count) =>
    Object.entries(scenes)
      .filter(([name]) => !names || names.includes(name))
      .filter(([name]) => full !== false || name === 'all move' || someCounts.includes(count))
      .map(([name, scene]) => {
        const row = { kind: 'objects', name, scene, dimensions: 2, count, numbers: 'double', objects: true, seed: 1 };
        // If all move, boxes are set in one way only.
        const contenders = [
          ...own.filter(({ name }) => name !== 'set movers' || scene === 'static2d'),
          ...packages.map((each) => ({
            ...each,
            module: path('../contenders/package-of-objects.mjs'),
            variant: { peer: each.peer, variant: each.variant },
          })),
        ];
        return { ...row, plan: framesFor(count), budget: count > 10_000 ? 2000 : 600, contenders };
      }),
  );
}

/** The packages that find pairs in these dimensions; each way to use one is a contender. */
export async function packagesOf(dimensions) {
  const found = [];
  for (const file of readdirSync(path('../peers'))
    .filter((name) => name.endsWith('.mjs'))
    .sort()) {
    const peer = file.slice(0, -'.mjs'.length);
    const module = path(`../peers/${file}`);
    const { dimensions: able, variants = [undefined], npm } = await import(module);
    if (!able.includes(dimensions)) continue;
    for (const variant of variants)
      found.push({ name: variant ? `${peer} (${variant})` : peer, peer, npm, module, variant });
  }
  return found;
}
