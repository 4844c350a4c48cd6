// npm i && npm start: milliseconds per step of Planck, as it is and with broadphase, in turns.
import { World } from 'planck';
import { useBroadPhase } from './planck-broadphase.mjs';
import { fillHeap, fillSwarm } from './scene.mjs';

const [rounds, steps] = [5, 20];
const median = (values) => values.toSorted((a, b) => a - b)[values.length >> 1];

console.log('                 as it is   with broadphase, ms a step');
for (const [name, fill, count] of [
  ['heap', fillHeap, 500],
  ['heap', fillHeap, 2000],
  ['swarm', fillSwarm, 2000],
  ['swarm', fillSwarm, 10000],
]) {
  const sides = [false, true].map((ours) => {
    const world = new World();
    if (ours) useBroadPhase(world);
    fill(world, count);
    return { world, times: [] };
  });
  for (let round = 0; round < rounds; round++) {
    for (const { world, times } of sides) {
      const started = performance.now();
      for (let k = 0; k < steps; k++) world.step(1 / 60);
      times.push((performance.now() - started) / steps);
    }
  }
  const text = ({ times }) => median(times).toFixed(2).padStart(12);
  console.log(`${name.padEnd(6)}${String(count).padStart(6)}${text(sides[0])}${text(sides[1])}`);
}
