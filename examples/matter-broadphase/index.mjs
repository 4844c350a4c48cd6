// npm i && npm start: milliseconds per step of Matter.js, as it is and with broadphase, in turns.
import Matter from 'matter-js';
import { useBroadPhase } from './matter-broadphase.mjs';
import { createHeap, createSwarm } from './scene.mjs';

const [rounds, steps] = [5, 20];
const median = (values) => values.toSorted((a, b) => a - b)[values.length >> 1];

console.log('                    as it is   with broadphase, ms a step (of that, finding collisions)');
for (const [name, createScene, count] of [
  ['heap', createHeap, 500],
  ['heap', createHeap, 2000],
  ['swarm', createSwarm, 500],
  ['swarm', createSwarm, 2000],
  ['swarm', createSwarm, 10000],
]) {
  const sides = [false, true].map((ours) => ({ ours, engine: createScene(count), step: [], detect: [] }));
  for (let round = 0; round < rounds; round++) {
    for (const { ours, engine, step, detect } of sides) {
      const undo = ours ? useBroadPhase(Matter) : () => {};
      const { collisions } = Matter.Detector;
      let detecting = 0;
      Matter.Detector.collisions = (detector) => {
        const started = performance.now();
        const found = collisions(detector);
        detecting += performance.now() - started;
        return found;
      };
      const started = performance.now();
      for (let k = 0; k < steps; k++) Matter.Engine.update(engine, 1000 / 60);
      step.push((performance.now() - started) / steps);
      detect.push(detecting / steps);
      Matter.Detector.collisions = collisions;
      undo();
    }
  }
  const text = ({ step, detect }) => `${median(step).toFixed(2)} (${median(detect).toFixed(2)})`.padStart(16);
  console.log(`${name.padEnd(6)}${String(count).padStart(6)}${text(sides[0])}${text(sides[1])}`);
}
