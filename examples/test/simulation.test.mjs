// Entities handed to a zone that is lost meanwhile are remembered until it has had time for a snapshot.
import { expect, test } from 'vitest';
import { Simulation } from '../apart/world-colyseus/simulation.mjs';
import { cutInto, sight, world } from '../apart/world-colyseus/world.mjs';

test('who was handed to a zone that was long away is known for a while after it is back', () => {
  const simulation = new Simulation(cutInto(2), 0);
  const border = world.width / 2 + sight / 2;
  simulation.restart([{ id: 7, x: border - 1, y: 100, vx: 2, vy: 0 }]);
  const known = () => simulation.handedTo(1, -1).map(({ id }) => id);
  const step = (tick, isOpen) => {
    simulation.step(tick, () => isOpen);
    simulation.finish([], []);
  };
  step(0, true);
  expect([known(), simulation.entities.size]).toEqual([[7], 0]);
  for (let tick = 1; tick < 200; tick++) step(tick, false);
  for (let tick = 200; tick < 250; tick++) step(tick, true);
  expect(known()).toEqual([7]);
  for (let tick = 250; tick < 300; tick++) step(tick, true);
  expect(known()).toEqual([]);
});
