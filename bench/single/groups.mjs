// Ragdolls in a pile: 1,000 of 20 boxes each, of which the boxes of one are never to be a pair. Each ragdoll a group,
// against the same space without groups whose pairs are looked through in JavaScript; in one process, in turns:
//   npm run bench:groups -- [ragdolls]
import { bundle } from '../../scripts/bundle.mjs';
import { median } from '../harness/statistics.mjs';

const { BroadPhase } = await import(await bundle('bench/library.ts', 'build/bench/library.mjs'));
const ragdolls = Number(process.argv[2] ?? 1000);
const parts = 20;
const count = ragdolls * parts;
const rounds = 60;
const warmUp = 20;

let state = 1;
function random() {
  state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
  return state / 2 ** 32;
}

/**
 * Ragdolls of boxes of side 1 in a heap, each in a ball around its middle: a box meets about as many of its own as of
 * others.
 */
function pile(dimensions) {
  const boxes = new Float32Array(count * 2 * dimensions);
  const side = (ragdolls * 12) ** (1 / dimensions);
  for (let doll = 0; doll < ragdolls; doll++) {
    const middle = Array.from({ length: dimensions }, () => random() * side);
    for (let k = 0; k < parts; k++) {
      const at = (doll * parts + k) * 2 * dimensions;
      for (let a = 0; a < dimensions; a++) {
        boxes[at + a] = middle[a] + (random() - 0.5) * 4;
        boxes[at + dimensions + a] = boxes[at + a] + 1;
      }
    }
  }
  return boxes;
}

const motions = { 'at rest': 0, trembling: 0.01, 'all jump': 3 };

/** Moves every box by up to this much, along all axes. */
function move(boxes, by, to) {
  for (let k = 0; k < boxes.length; k++) to[k] = boxes[k];
  if (by === 0) return;
  const width = boxes.length / count;
  for (let at = 0; at < boxes.length; at += width) {
    for (let a = 0; a < width / 2; a++) {
      const shift = (random() - 0.5) * 2 * by;
      to[at + a] += shift;
      to[at + a + width / 2] += shift;
    }
  }
}

const groupOf = (id) => 1 + Math.floor(id / parts);

/** The number of pairs of different ragdolls. */
function betweenRagdolls(pairs) {
  let between = 0;
  for (let k = 0; k < pairs.length; k += 2) {
    between += Number(((pairs[k] / parts) | 0) !== ((pairs[k + 1] / parts) | 0));
  }
  return between;
}

/** An update, and everything else until the pairs are the wanted ones. */
const contenders = {
  groups: (space) => space.update().pairCount,
  'no groups, pairs looked through': (space) => betweenRagdolls(space.update().pairs),
};

console.log(`${ragdolls} ragdolls of ${parts} boxes: medians of ${rounds} updates after ${warmUp}\n`);
for (const dimensions of [2, 3]) {
  const boxes = pile(dimensions);
  for (const [motion, by] of Object.entries(motions)) {
    const spaces = Object.keys(contenders).map(() => new BroadPhase({ dimensions }).setAll(boxes));
    for (let id = 0; id < count; id++) spaces[0].setGroup(id, groupOf(id));
    const times = spaces.map(() => []);
    const moved = boxes.slice();
    let found = [];
    for (let round = -warmUp; round < rounds; round++) {
      move(boxes, by, moved);
      found = Object.values(contenders).map((run, k) => {
        spaces[k].setAll(moved);
        const start = performance.now();
        const pairs = run(spaces[k]);
        if (round >= 0) times[k].push(performance.now() - start);
        return pairs;
      });
      if (found[0] !== found[1]) throw new Error(`${found[0]} pairs with groups, ${found[1]} without`);
    }
    Object.keys(contenders).forEach((name, k) => {
      const { tests, pairs, reason } = spaces[k].stats;
      const row = [`${dimensions}D ${motion}, ${name}`.padEnd(48), `${median(times[k]).toFixed(3)} ms`.padStart(10)];
      console.log(`${row.join('')}  ${tests} tests, ${pairs} pairs reported; ${reason}`);
    });
  }
}
