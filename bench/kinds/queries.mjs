// Queries between frames: 1,000 per frame, on boxes at rest, and right after an update of all boxes, when most
// libraries must build an index first. Our update also finds all pairs then, with a full rebuild. Boxes move little, so
// that no ray comes to begin in a box, for which libraries give different answers.
import { readdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';

export const title = 'Queries: 1,000 a frame';

const path = (file) => fileURLToPath(new URL(file, import.meta.url));
const asked = ['queryBox', 'queryLarge', 'nearest', 'rayCast'];
const [speed, plan] = [0.02, { warmUp: 40, timed: 60 }];

export async function rows({ names, counts, dimensions = [2, 3], full }) {
  const askers = await askersThereAre();
  const wanted = counts ?? (full === false ? [10_000] : [10_000, 100_000]);
  return dimensions
    .flatMap((d) =>
      asked.flatMap((asks) =>
        [true, false].flatMap((still) =>
          wanted.map((count) => {
            const query = asks === 'queryLarge' ? 'queryBox' : asks;
            const name = `${asks}${d}d${still ? '' : '-moved'}`;
            const of = { asks, query, still, scene: `uniform${d}d`, speed, dimensions: d, count };
            const able = askers.filter(({ dimensions, answers }) => dimensions.includes(d) && answers.includes(query));
            return { kind: 'queries', name, ...of, numbers: 'float32', seed: 1, plan, budget: 700, contenders: able };
          }),
        ),
      ),
    )
    .filter(({ name }) => !names || names.includes(name));
}

/** Ours comes first. */
async function askersThereAre() {
  const files = readdirSync(path('../askers'))
    .filter((file) => file.endsWith('.mjs'))
    .map((file) => file.slice(0, -'.mjs'.length));
  const names = ['broadphase', ...files.filter((name) => name !== 'broadphase').sort()];
  const found = [];
  for (const name of names) {
    const { dimensions, answers } = await import(`../askers/${name}.mjs`);
    found.push({ name, peer: name, module: path('../contenders/asker.mjs'), variant: name, dimensions, answers });
  }
  return found;
}
