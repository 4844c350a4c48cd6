// Entities handed to a zone that is lost meanwhile are remembered until it has had time for a snapshot.
import { expect, test } from 'vitest';
import { Simulation } from '../apart/world-colyseus/simulation.mjs';
import { cutInto, sight, world, zoneOf } from '../apart/world-colyseus/world.mjs';

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

test('nobody is handed to a zone that is missing: who is beyond its border comes back', () => {
  const zones = cutInto(3);
  const simulation = new Simulation(zones, 1);
  const [first, last] = [1, 2].map((zone) => (world.width * zone) / 3 + sight / 2);
  simulation.restart([
    { id: 7, x: first - 10, y: 100, vx: -2, vy: 0 },
    { id: 8, x: last + 10, y: 100, vx: 2, vy: 0 },
  ]);
  for (let tick = 0; tick < 20; tick++) {
    simulation.step(tick, () => false);
    simulation.finish([], []);
    const places = [...simulation.entities.values()];
    expect(places.map((entity) => [entity.id, zoneOf(zones, entity)])).toEqual([
      [7, 1],
      [8, 1],
    ]);
    expect([simulation.handedTo(0, -1), simulation.handedTo(2, -1)]).toEqual([[], []]);
  }
  simulation.step(20, () => true);
  expect(simulation.entities.size).toBe(2);
});
