// In every step of a heap of bodies, it finds the same collisions as Matter's own detector.
import { describe, expect, test } from 'vitest';
import { installed, pairName } from './check.mjs';

describe.skipIf(!installed)('a broad phase for Matter.js', () => {
  test.each(['createHeap', 'createSwarm'])('finds the same collisions, step after step, in %s', async (name) => {
    const { default: Matter } = await import('matter-js');
    const { useBroadPhase } = await import('../matter-broadphase/matter-broadphase.mjs');
    const { [name]: createScene } = await import('../matter-broadphase/scene.mjs');
    const engine = createScene(300);
    const names = (collisions) => collisions.map(({ bodyA, bodyB }) => pairName(bodyA.id, bodyB.id)).sort();
    const original = Matter.Detector.collisions;
    let found = 0;
    for (let step = 0; step < 120; step++) {
      Matter.Engine.update(engine, 1000 / 60);
      if (step % 4) continue;
      const { bodies, pairs } = engine.detector;
      const own = names(original({ bodies: bodies.slice(), pairs, collisions: [] }));
      const undo = useBroadPhase(Matter);
      expect(names(Matter.Detector.collisions({ bodies, pairs, collisions: [] }))).toEqual(own);
      undo();
      found += own.length;
    }
    expect(Matter.Detector.collisions).toBe(original);
    expect(found).toBeGreaterThan(name === 'createHeap' ? 1000 : 30);
    useBroadPhase(Matter);
    for (let step = 0; step < 60; step++) Matter.Engine.update(engine, 1000 / 60);
    Matter.Detector.collisions = original;
    const heights = engine.world.bodies.filter(({ isStatic }) => !isStatic).map(({ position }) => position.y);
    if (name === 'createHeap') expect(Math.max(...heights)).toBeLessThan(0); // no body has fallen through the ground
  });
});
