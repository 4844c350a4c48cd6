// What a camera of three.js sees of many instances, and which of them a ray meets first. One box is kept for each; those
// that move are told one by one, and the rest cost nothing. Where most move, all are told at once.
import { BroadPhase } from 'broadphase';
import { Frustum, Matrix4, Vector3 } from 'three';

const { abs } = Math;

export class Culler {
  #space = new BroadPhase({ dimensions: 3 });
  #box = new Float32Array(6); // as exact as the matrices are, and half the memory of doubles
  #boxes;
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
    this.#boxes = new Float32Array((6 * matrices.length) / 16);
    this.moveAll();
    for (let id = 0; 16 * id < matrices.length; id++) this.#space.setFilter(id, 1, 0); // no pairs are looked for
  }

  /** Instance `id` has got another matrix. */
  move(id) {
    const box = this.#box;
    this.#write(id, box, 0);
    this.#space.set(id, box[0], box[1], box[2], box[3], box[4], box[5]);
  }

  /** Most of them have. */
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
