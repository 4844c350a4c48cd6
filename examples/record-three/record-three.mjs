// Records a three.js scene: the box of every mesh in world coordinates.
// In your game: `const recorded = recordThree(scene)`, then `recorded.frame()` after each `renderer.render(…)`.
import { BroadPhase } from 'broadphase';
import { record } from 'broadphase/trace';
import { Box3 } from 'three';

/**
 * @param {import('three').Object3D} scene
 * @param {(object: import('three').Mesh) => boolean} chosen which meshes count: those that can touch something
 */
export function recordThree(scene, chosen = (mesh) => mesh.visible) {
  const space = new BroadPhase({ dimensions: 3 });
  const recording = record(space);
  const box = new Box3();
  let known = new Set();
  return {
    space,
    recording,
    frame() {
      const now = new Set();
      scene.updateMatrixWorld();
      scene.traverse((object) => {
        if (!object.isMesh || !chosen(object)) return;
        if (!object.geometry.boundingBox) object.geometry.computeBoundingBox();
        const { min, max } = box.copy(object.geometry.boundingBox).applyMatrix4(object.matrixWorld);
        if (box.isEmpty()) return;
        space.set(object.id, min.x, min.y, min.z, max.x, max.y, max.z);
        now.add(object.id);
      });
      for (const id of known) if (!now.has(id)) space.delete(id);
      known = now;
      space.update();
    },
    stop: () => recording.stop(),
    download: (name = 'three.trace') => recording.download(name),
  };
}
