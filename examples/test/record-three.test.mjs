// The boxes of the recording are those that three.js itself computes for the meshes, and it replays exactly.
import { describe, expect, test } from 'vitest';
import { checkRecording, installed } from './check.mjs';

describe.skipIf(!installed)('recording three.js', () => {
  test('has the box of every mesh, also within groups that move', async () => {
    const { Box3, Mesh } = await import('three');
    const { recordThree } = await import('../record-three/record-three.mjs');
    const { createScene } = await import('../record-three/scene.mjs');
    const { scene, belt, step } = createScene(80);
    const recorded = recordThree(scene);
    const expected = [];
    for (let frame = 0; frame < 60; frame++) {
      step(frame);
      if (frame === 30) belt.children[0].visible = false;
      recorded.frame();
      const boxes = new Map();
      for (const rock of belt.children) {
        const { min, max } = new Box3().setFromObject(rock);
        if (rock instanceof Mesh && rock.visible) boxes.set(rock.id, [...min.toArray(), ...max.toArray()]);
      }
      expected.push(boxes);
    }
    await recorded.stop();
    const frames = checkRecording(recorded.recording.bytes());
    expect(frames).toHaveLength(60);
    for (const { index, ids, boxes, count } of frames) {
      expect(count).toBe(expected[index].size);
      ids.forEach((id, place) => {
        const box = expected[index].get(id);
        for (let k = 0; k < 6; k++) expect(boxes[6 * place + k]).toBeCloseTo(box[k], 9);
      });
    }
    expect(new Set(frames.map(({ count }) => count))).toEqual(new Set([80, 79, 78, 77, 76]));
  });
});
