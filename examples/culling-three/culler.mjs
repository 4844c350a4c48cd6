// Finds the instances that a three.js camera sees, and the first one that a ray hits. Each instance has a box. Report
// those that move one by one; the others cost nothing. If most move, report all at once.
import { BroadPhase } from 'broadphase';
import { Frustum, Matrix4, Vector3 } from 'three';

const { abs } = Math;

export class Culler {
  #space = new BroadPhase({ dimensions: 3 });
  #box = new Float32Array(6); // as exact as the matrices, with half the memory of doubles
  #boxes;
  #planes = new Float64Array(24);
  #seen = { out: [] };
  #near = { out: [] };
  #frustum = new Frustum();
  #matrix = new Matrix4();

  /** For instances of a geometry, with their matrices in an array, 16 numbers each. */
  constructor(geometry, matrices) {
    geometry.computeBoundingBox();
    this.middle = geometry.boundingBox.getCenter(new Vector3());
    this.half = geometry.boundingBox.getSize(new Vector3()).multiplyScalar(0.5);
    this.matrices = matrices;
    this.#boxes = new Float32Array((6 * matrices.length) / 16);
    this.moveAll();
    for (let id = 0; 16 * id < matrices.length; id++) this.#space.setFilter(id, 1, 0); // so no pairs are found
  }

  /** Call it when the matrix of instance `id` has changed. */
  move(id) {
    const box = this.#box;
    this.#write(id, box, 0);
    this.#space.set(id, box[0], box[1], box[2], box[3], box[4], box[5]);
  }

  /** Call it when most matrices have changed. */
  moveAll() {
    for (let id = 0; 16 * id < this.matrices.length; id++) this.#write(id, this.#boxes, 6 * id);
    this.#space.setAll(this.#boxes);
  }

  #write(id, to, at) {
    const { matrices: m, middle: c, half: h } = this;
    for (let k = 16 * id; k < 16 * id + 3; k++, at++) {
      const middle = m[k] * c.x + m[k + 4] * c.y + m[k + 8] * c.z + m[k + 12];
      const half = abs(m[k]) * h.x + abs(m[k + 4]) * h.y + abs(m[k + 8]) * h.z;
      to[at] = middle - half;
      to[at + 3] = middle + half;
    }
  }

  /** The ids of the instances that a camera sees, in an array that is reused. */
  visible(camera) {
    const matrix = this.#matrix.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    this.#frustum.setFromProjectionMatrix(matrix, camera.coordinateSystem, camera.reversedDepth);
    this.#frustum.planes.forEach(({ normal, constant }, k) => {
      normal.toArray(this.#planes, 4 * k)[4 * k + 3] = constant;
    });
    return this.#space.update().queryPlanes(this.#planes, this.#seen);
  }

  /** The first instance whose box the ray of a Raycaster hits, with its distance; as of the last `visible`. */
  pick({ origin: o, direction: d }) {
    return this.#space.rayCast(o.x, o.y, o.z, d.x, d.y, d.z);
  }

  /** The ids of the instances that overlap a Box3, in an array that is reused; as of the last `visible`. */
  within({ min, max }) {
    return this.#space.queryBox(min.x, min.y, min.z, max.x, max.y, max.z, this.#near);
  }
}
