// A few queries in a frame in which all boxes have moved, such as what is under the pointer or ahead of the player:
// against a loop over all things in JavaScript, in turns on the same frames. The update is not timed.
//   npm run bench:few -- [boxes …]
import { bundle } from '../../scripts/bundle.mjs';
import { median, quantile } from '../harness/statistics.mjs';

const { BroadPhase, createRandom } = await import(await bundle('bench/library.ts', 'build/bench/library.mjs'));
const counts = process.argv.slice(2).map(Number);
const [warmUp, rounds] = [400, 400];

/** Each answers with a number that does not depend on the order of the boxes. */
const queries = {
  queryBox: {
    ours: (space, x, y) => space.queryBox(x, y, x + 5, y + 5).length,
    loop(things, x, y) {
      const found = [];
      for (let id = 0; id < things.length; id++) {
        const thing = things[id];
        if (thing.x <= x + 5 && x <= thing.x + 1 && thing.y <= y + 5 && y <= thing.y + 1) found.push(id);
      }
      return found.length;
    },
  },
  nearest: {
    ours: (space, x, y) => space.nearest(x, y, 1)[0],
    loop(things, x, y) {
      let [best, least] = [-1, Infinity];
      for (let id = 0; id < things.length; id++) {
        const thing = things[id];
        const dx = Math.max(thing.x - x, x - (thing.x + 1), 0);
        const dy = Math.max(thing.y - y, y - (thing.y + 1), 0);
        const far = dx * dx + dy * dy;
        if (far < least) [best, least] = [id, far];
      }
      return best;
    },
  },
  'rayCast, 10 long': {
    ours: (space, x, y) => space.rayCast(x, y, 0.6, 0.8, { maxDistance: 10 })?.id ?? -1,
    loop(things, x, y) {
      let [best, least] = [-1, 10];
      for (let id = 0; id < things.length; id++) {
        const thing = things[id];
        const enter = Math.max((thing.x - x) / 0.6, (thing.y - y) / 0.8, 0);
        const leave = Math.min((thing.x + 1 - x) / 0.6, (thing.y + 1 - y) / 0.8);
        if (enter <= leave && enter < least) [best, least] = [id, enter];
      }
      return best;
    },
  },
};

/** Plays the frames: the boxes move by up to a tenth of their size. Returns the times of each frame, in µs. */
function play({ ours, loop }, count, asked) {
  const random = createRandom(7);
  const side = 2 * Math.sqrt(count);
  const things = Array.from({ length: count }, () => ({ x: random() * side, y: random() * side }));
  const space = new BroadPhase();
  const ways = [(x, y) => ours(space, x, y), (x, y) => loop(things, x, y)];
  const times = ways.map(() => []);
  for (let frame = -warmUp; frame < rounds; frame++) {
    for (let id = 0; id < count; id++) {
      const thing = things[id];
      thing.x += (random() - 0.5) * 0.2;
      thing.y += (random() - 0.5) * 0.2;
      space.set(id, thing.x, thing.y, thing.x + 1, thing.y + 1);
    }
    space.update();
    const places = Array.from({ length: 2 * asked }, () => random() * side);
    const answers = [0, 1]
      .map((k) => (k + frame) & 1)
      .map((way) => {
        const start = performance.now();
        let sum = 0;
        for (let k = 0; k < 2 * asked; k += 2) sum += ways[way](places[k], places[k + 1]);
        if (frame >= 0) times[way].push(1000 * (performance.now() - start));
        return sum;
      });
    if (answers[0] !== answers[1]) throw new Error(`answers differ: ${answers.join(' and ')}`);
  }
  space.dispose();
  return times;
}

console.log(`2D, all boxes move, ${rounds} frames after ${warmUp}: medians, and the median of the ratios\n`);
for (const [name, query] of Object.entries(queries)) {
  for (const count of counts.length > 0 ? counts : [100, 1000, 10_000]) {
    for (const asked of [1, 3, 10]) {
      const [ours, loop] = play(query, count, asked);
      const ratio = median(loop.map((time, k) => time / ours[k]));
      const row = `${name}, ${count} boxes, ${asked} per frame`;
      const figures = [`${median(ours).toFixed(1)} µs`, `p95 ${quantile(ours, 0.95).toFixed(1)}`];
      console.log(
        `${row.padEnd(44)}${figures.join(', ').padEnd(24)}loop ${median(loop).toFixed(1)}`.padEnd(86),
        `${ratio.toFixed(1)}x`,
      );
    }
  }
}
