// What a space costs that has more than boxes: a few of them go off and on, get another filter, group or reach, or are
// removed and added in each frame; or it has events, ids of its own, a wrapped world. A share of the boxes moves little.
// `auto` against `strip-sweep`, a full rebuild in each frame, and against `auto` in a space with nothing but the boxes,
// in turns on the same frames:
//   npm run bench:changes -- [boxes] [name]
import { bundle } from '../../scripts/bundle.mjs';
import { median, quantile } from '../harness/statistics.mjs';

const { BroadPhase } = await import(await bundle('bench/library.ts', 'build/bench/library.mjs'));
const count = Number(process.argv[2] ?? 20_000);
const only = process.argv[3];
const [warmUp, rounds] = [40, 80];
const some = 20;

let state;
function random() {
  state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
  return state / 2 ** 32;
}

const off = (space, now, before) => {
  for (const id of before) space.setEnabled(id, true);
  for (const id of now) space.setEnabled(id, false);
};

/**
 * `before` and `now`: other ids in each frame, and those of the frame before. `first` happens once. `options`: of the
 * space, given the size of its world. `idOf`: the id of the k-th box.
 */
const changes = {
  nothing: {},
  'one off, one on': { each: (space, now, before) => off(space, now.slice(0, 1), before.slice(0, 1)) },
  '20 off, 20 on': { each: off },
  'a pool, a quarter off': {
    first: (space) => {
      for (let id = 0; id < count; id += 4) space.setEnabled(id, false);
    },
    each: (space, now, before) => {
      for (const id of before) space.setEnabled(id - (id % 4), false);
      for (const id of now) space.setEnabled(id - (id % 4), true);
    },
  },
  '20 meet nobody': {
    each: (space, now, before) => {
      for (const id of before) space.setFilter(id, 1, 1);
      for (const id of now) space.setFilter(id, 0, 0);
    },
  },
  '20 change layers': {
    first: (space) => {
      for (let id = 0; id < count; id++) space.setFilter(id, 1 + (id % 2), 2 - (id % 2));
    },
    each: (space, now) => {
      for (const id of now) space.setFilter(id, space.filterOf(id).layer === 1 ? 2 : 1, 3);
    },
  },
  'four kinds that meet some': {
    first: (space) => {
      for (let id = 0; id < count; id++) space.setFilter(id, 1 << (id % 4), [0b0111, 0b0011, 0b1101, 0b0100][id % 4]);
    },
  },
  'all in groups, 20 change': {
    first: (space) => {
      for (let id = 0; id < count; id++) space.setGroup(id, 1 + (id >> 3));
    },
    each: (space, now) => {
      for (const id of now) space.setGroup(id, count + id);
    },
  },
  'all reach': {
    first: (space) => {
      for (let id = 0; id < count; id++) space.setReach(id, 0.1);
    },
  },
  '20 removed and added': {
    each: (space, now, _before, box) => {
      for (const id of now) space.delete(id);
      for (const id of now) space.set(id, ...box(id));
    },
  },
  'ids of its own': { idOf: (id) => 3 * id + 1 },
  events: { options: () => ({ events: true }) },
  'touching: false': { options: () => ({ touching: false }) },
  'a wrapped world': { options: (wrap) => ({ wrap }) },
  'a snapshot': { each: (space) => void space.snapshot() },
};

/** Plays the frames: in each, a share of the boxes moves by up to a fiftieth of its size. */
function play(change, dimensions, share, numbers) {
  state = 7;
  const side = 2 * count ** (1 / dimensions);
  const options = { dimensions, ...change.options?.(Array(dimensions).fill(side)) };
  const places = Float64Array.from({ length: count * dimensions }, () => random() * side);
  const box = (id) => {
    const low = Array.from(places.subarray(id * dimensions, (id + 1) * dimensions));
    const all = [...low, ...low.map((at) => at + 1)];
    return numbers === 'float32' ? all.map(Math.fround) : all;
  };
  const spaces = ['auto', 'strip-sweep'].map((technique) => new BroadPhase({ technique, ...options }));
  const changed = [...spaces];
  spaces.push(new BroadPhase({ dimensions }));
  const idIn = (space, id) => (change.idOf && changed.includes(space) ? change.idOf(id) : id);
  for (const space of spaces) for (let id = 0; id < count; id++) space.set(idIn(space, id), ...box(id));
  for (const space of changed) change.first?.(space);
  const times = spaces.map(() => []);
  let before = [];
  for (let frame = -warmUp; frame < rounds; frame++) {
    const moved = [];
    for (let id = 0; id < count; id++) {
      if (id % 100 >= share) continue;
      for (let k = 0; k < dimensions; k++) places[id * dimensions + k] += (random() - 0.5) * 0.04;
      moved.push(id);
    }
    const now = Array.from({ length: some }, (_, k) => ((frame + warmUp) * 7919 + k * 31) % count);
    spaces.forEach((space, k) => {
      for (const id of moved) space.set(idIn(space, id), ...box(id));
      if (changed.includes(space)) change.each?.(space, now, before, box);
      const start = performance.now();
      space.update();
      if (frame >= 0) times[k].push(performance.now() - start);
    });
    before = now;
    if (spaces[0].pairCount !== spaces[1].pairCount)
      throw new Error(`${spaces[0].pairCount} pairs by auto, ${spaces[1].pairCount} by strip-sweep`);
  }
  const [auto, rebuild, plain] = times;
  const ratioTo = (others) => `${median(auto.map((time, k) => time / others[k])).toFixed(2)}x`;
  const figures = [
    `${median(auto).toFixed(3)} ms`,
    `p95 ${quantile(auto, 0.95).toFixed(3)}`,
    `rebuild ${median(rebuild).toFixed(3)}`,
    ratioTo(rebuild),
    `boxes alone ${median(plain).toFixed(3)}`,
    ratioTo(plain),
  ];
  for (const space of spaces) space.dispose();
  return figures.map((figure) => figure.padEnd(20)).join('');
}

console.log(`${count} boxes, ${rounds} updates after ${warmUp}: medians, and the median of the ratios\n`);
for (const [name, change] of Object.entries(changes)) {
  if (only && name !== only) continue;
  for (const dimensions of [2, 3]) {
    for (const share of [5, 100]) {
      for (const numbers of ['float32', 'double']) {
        const row = `${name}, ${dimensions}D, ${share} % move, ${numbers}`;
        console.log(`${row.padEnd(56)}${play(change, dimensions, share, numbers)}`);
      }
    }
  }
}
