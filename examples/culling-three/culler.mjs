// What a camera of three.js sees of many instances, and which of them a ray meets first. One box is kept for each; those
// that move are told one by one, and the rest cost nothing.
import { BroadPhase } from 'broadphase';
import { Frustum, Matrix4, Vector3 } from 'three';

const { abs, fround: single } = Math; // float32 is as exact as the matrices are, and half the memory of doubles

export class Culler {
  #space = new BroadPhase({ dimensions: 3 });
  #planes = new Float64Array(24);
  #seen = { out: [] };
  #near = { out: [] };
  #frustum = new Frustum();
  #matrix = new Matrix4();

  /** For instances of a geometry whose matrices stand in an array, 16 numbers each. */
  constructor(geometry, matrices) {
    geometry.computeBoundingBox();
    this.middle = geometry.boundingBox.getCenter(new Vector3());
    this.half = geometry.boundingBox.getSize(new Vector3()).multiplyScalar(0.5);
    this.matrices = matrices;
    for (let id = 0; 16 * id < matrices.length; id++) {
      this.move(id);
      this.#space.setFilter(id, 1, 0); // no pairs are wanted, so none are looked for
    }
  }

  /** Instance `id` has got another matrix. */
  move(id) {
    const { matrices: m, middle: c, half: h } = this;
    const k = 16 * id;
    const x = m[k] * c.x + m[k + 4] * c.y + m[k + 8] * c.z + m[k + 12];
    const y = m[k + 1] * c.x + m[k + 5] * c.y + m[k + 9] * c.z + m[k + 13];
    const z = m[k + 2] * c.x + m[k + 6] * c.y + m[k + 10] * c.z + m[k + 14];
    const w = abs(m[k]) * h.x + abs(m[k + 4]) * h.y + abs(m[k + 8]) * h.z;
    const t = abs(m[k + 1]) * h.x + abs(m[k + 5]) * h.y + abs(m[k + 9]) * h.z;
    const d = abs(m[k + 2]) * h.x + abs(m[k + 6]) * h.y + abs(m[k + 10]) * h.z;
    this.#space.set(id, single(x - w), single(y - t), single(z - d), single(x + w), single(y + t), single(z + d));
  }

  /** The ids of what a camera sees: an array that is used again. */
  visible(camera) {
    const matrix = this.#matrix.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    this.#frustum.setFromProjectionMatrix(matrix, camera.coordinateSystem, camera.reversedDepth);
    this.#frustum.planes.forEach(({ normal, constant }, k) => {
      normal.toArray(this.#planes, 4 * k)[4 * k + 3] = constant;
    });
    return this.#space.update().queryPlanes(this.#planes, this.#seen);
  }

  /** The first instance whose box a ray (of a Raycaster) meets, with its distance; as of the last `visible`. */
  pick({ origin: o, direction: d }) {
    return this.#space.rayCast(o.x, o.y, o.z, d.x, d.y, d.z);
  }

  /** The ids of the instances that overlap a Box3: an array that is used again; as of the last `visible`. */
  within({ min, max }) {
    return this.#space.queryBox(min.x, min.y, min.z, max.x, max.y, max.z, this.#near);
  }
}
