// Every collision that Matter.js finds is among the pairs of the recording, and the recording replays exactly.
import { describe, expect, test } from 'vitest';
import { checkRecording, installed, pairName, pairsOf } from './check.mjs';

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
});
