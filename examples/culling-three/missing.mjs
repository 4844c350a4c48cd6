// The check of all contenders: tests every corner of every instance.
import { Frustum, Matrix4, Vector3 } from 'three';

/** The ids of instances with a corner in the camera's view that are not in `seen`. */
export function missing(seen, geometry, matrices, camera) {
  const known = new Set(seen);
  const matrix = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
  const view = new Frustum().setFromProjectionMatrix(matrix);
  const { position } = geometry.attributes;
  const corner = new Vector3();
  const lost = [];
  for (let id = 0; 16 * id < matrices.length; id++) {
    if (known.has(id)) continue;
    matrix.fromArray(matrices, 16 * id);
    for (let k = 0; k < position.count; k++) {
      corner.fromBufferAttribute(position, k).applyMatrix4(matrix);
      // Ignores the rounding of float32 matrices.
      if (!view.planes.every((plane) => plane.distanceToPoint(corner) > 1e-3)) continue;
      lost.push(id);
      break;
    }
  }
  return lost;
}
