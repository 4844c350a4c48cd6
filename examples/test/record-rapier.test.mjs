// Every contact of Rapier is among the pairs of the recording, its boxes contain its shapes, and it replays exactly.
import { describe, expect, test } from 'vitest';
import { checkRecording, installed, pairName, pairsOf } from './check.mjs';

describe.skipIf(!installed)('recording Rapier', () => {
  test('has the boxes of all colliders, and every contact among its pairs', async () => {
    const { recordRapier } = await import('../record-rapier/record-rapier.mjs');
    const { createScene } = await import('../record-rapier/scene.mjs');
    const world = await createScene(100);
    const recorded = recordRapier(world);
    let contacts = 0;
    for (let step = 0; step < 150; step++) {
      if (step === 100) world.removeCollider(world.getCollider(world.colliders.getAll().at(-1).handle), true);
      recorded.frame();
      world.step();
      // Contacts are found where the bodies were when the step began.
      const pairs = pairsOf(recorded.space);
      world.forEachCollider((a) => {
        world.contactPairsWith(a, (b) => {
          world.contactPair(a, b, (manifold) => {
            let touching = false;
            for (let k = 0; k < manifold.numContacts(); k++) touching ||= manifold.contactDist(k) <= 0;
            if (!touching) return;
            contacts++;
            expect(pairs).toContain(pairName(recorded.idOf(a), recorded.idOf(b)));
          });
        });
      });
    }
    await recorded.stop();
    expect(contacts).toBeGreaterThan(1000);
    const frames = checkRecording(recorded.recording.bytes());
    expect(frames.map(({ count }) => count)).toEqual([...Array(100).fill(102), ...Array(50).fill(101)]);
  });

  test('the box of each shape is the smallest that holds it', async () => {
    const { boxOf } = await import('../record-rapier/record-rapier.mjs');
    const RAPIER = await import('@dimforge/rapier3d-compat');
    await RAPIER.init();
    const world = new RAPIER.World({ x: 0, y: 0, z: 0 });
    const turned = { x: 0.36, y: 0.48, z: 0, w: 0.8 };
    const shapes = [
      RAPIER.ColliderDesc.cuboid(0.4, 0.2, 0.3),
      RAPIER.ColliderDesc.roundCuboid(0.4, 0.2, 0.3, 0.1),
      RAPIER.ColliderDesc.ball(0.3),
      RAPIER.ColliderDesc.capsule(0.3, 0.2),
      RAPIER.ColliderDesc.cylinder(0.2, 0.4),
      RAPIER.ColliderDesc.convexHull(Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1)),
    ];
    for (const shape of shapes) {
      const collider = world.createCollider(shape.setTranslation(1, 2, 3).setRotation(turned));
      const box = boxOf(collider);
      // Along each axis, a slab just inside the box touches the shape, and one just outside does not.
      for (let axis = 0; axis < 3; axis++) {
        expect(reaches(RAPIER, collider, box, axis, -0.02)).toBe(true);
        expect(reaches(RAPIER, collider, box, axis, 1e-3)).toBe(false);
      }
    }
  });
});

/** Whether a thin slab `outside` the upper face of a box along an axis touches the collider. */
function reaches(RAPIER, collider, box, axis, outside) {
  const [low, high] = [box.slice(0, 3), box.slice(3)];
  const half = high.map((side, k) => (side - low[k]) / 2);
  const middle = high.map((side, k) => (side + low[k]) / 2);
  half[axis] = 1e-4;
  middle[axis] = high[axis] + outside;
  const [x, y, z] = middle;
  const slab = new RAPIER.Cuboid(half[0] + 0.01, half[1] + 0.01, half[2] + 0.01);
  slab.halfExtents[['x', 'y', 'z'][axis]] = 1e-4;
  return collider.intersectsShape(slab, { x, y, z }, { x: 0, y: 0, z: 0, w: 1 });
}
