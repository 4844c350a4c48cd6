// Every collision that Matter.js finds is among the pairs of the recording, and the recording replays exactly.
import { describe, expect, test } from 'vitest';
import { bits, checkGroups, checkRecording, groupsInTime, installed, pairName, pairsOf } from './check.mjs';

describe.skipIf(!installed)('recording Matter.js', () => {
  test('has the boxes of all bodies, and every collision among its pairs', async () => {
    const { default: Matter } = await import('matter-js');
    const { recordMatter } = await import('../record-matter/record-matter.mjs');
    const { createScene } = await import('../record-matter/scene.mjs');
    const engine = createScene(120);
    const recorded = recordMatter(engine);
    let collisions = 0;
    for (let step = 0; step < 150; step++) {
      if (step === 100) Matter.Composite.remove(engine.world, engine.world.bodies.at(-1));
      Matter.Engine.update(engine, 1000 / 60);
      const pairs = pairsOf(recorded.space);
      for (const { bodyA, bodyB, isActive } of engine.pairs.list) {
        if (!isActive) continue;
        collisions++;
        expect(pairs).toContain(pairName(bodyA.id, bodyB.id));
      }
    }
    await recorded.stop();
    Matter.Engine.update(engine, 1000 / 60); // no longer recorded
    expect(collisions).toBeGreaterThan(1000);
    const frames = checkRecording(recorded.recording.bytes());
    expect(frames.map(({ count }) => count)).toEqual([...Array(100).fill(147), ...Array(50).fill(146)]);
    expect(frames[50].rules.filter((number, k) => k % 3 === 2 && number === 1)).toHaveLength(27);
    expect(frames[50].changed).toBeGreaterThan(100);
  });

  test('has the pairs that may collide, by bits and by groups, which change', async () => {
    const { default: Matter } = await import('matter-js');
    const { recordMatter } = await import('../record-matter/record-matter.mjs');
    const engine = Matter.Engine.create({ gravity: { scale: 0 } });
    const bodies = bits.map(() => Matter.Bodies.rectangle(0, 0, 10, 10, { isSensor: true }));
    Matter.Composite.add(engine.world, bodies);
    const recorded = recordMatter(engine);
    for (const groups of groupsInTime) {
      for (const [k, { collisionFilter }] of bodies.entries()) {
        const [category, mask] = bits[k];
        Object.assign(collisionFilter, { category, mask, group: groups[k] });
      }
      Matter.Engine.update(engine, 1000 / 60);
      const mayMeet = (a, b) => Matter.Detector.canCollide(bodies[a].collisionFilter, bodies[b].collisionFilter);
      checkGroups(recorded.space, groups, (k) => bodies[k].id, mayMeet);
    }
    await recorded.stop();
    checkRecording(recorded.recording.bytes());
  });
});
