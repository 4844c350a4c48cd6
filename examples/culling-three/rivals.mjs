// What people use today, with the same methods as `Culler`: they move instances and find those that a camera sees.
import { BVH, HybridBuilder, WebGLCoordinateSystem } from 'bvh.js';
import { Box3, Frustum, Matrix4, Sphere } from 'three';

/** Reports that `many` instances from `first` on have moved: all at once, if most have and the contender can. */
export function tell(contender, first, many) {
  const count = contender.matrices.length / 16;
  if (2 * many > count && contender.moveAll) contender.moveAll();
  else for (let k = 0; k < many; k++) contender.move((first + k) % count);
}

const frustum = new Frustum();
const matrix = new Matrix4();
const sphere = new Sphere();
const box = new Box3();

function frustumOf(camera) {
  matrix.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
  return frustum.setFromProjectionMatrix(matrix, camera.coordinateSystem, camera.reversedDepth);
}

/** Like BatchedMesh in each frame: tests the geometry's sphere, moved by each matrix, against the frustum. */
export class EachByThree {
  constructor(geometry, matrices) {
    geometry.computeBoundingSphere();
    this.sphere = geometry.boundingSphere;
    this.matrices = matrices;
    this.seen = [];
  }

  move() {}

  visible(camera) {
    const { matrices, seen } = this;
    const view = frustumOf(camera);
    seen.length = 0;
    for (let id = 0; 16 * id < matrices.length; id++) {
      sphere.copy(this.sphere).applyMatrix4(matrix.fromArray(matrices, 16 * id));
      if (view.intersectsSphere(sphere)) seen.push(id);
    }
    return seen;
  }
}

/** The loop that you write if that is too slow: spheres in a flat array, kept up to date. */
export class FlatSpheres {
  constructor(geometry, matrices) {
    geometry.computeBoundingSphere();
    this.sphere = geometry.boundingSphere;
    this.matrices = matrices;
    this.spheres = new Float32Array(matrices.length / 4);
    this.planes = new Float64Array(24);
    this.seen = [];
    for (let id = 0; 16 * id < matrices.length; id++) this.move(id);
  }

  move(id) {
    sphere.copy(this.sphere).applyMatrix4(matrix.fromArray(this.matrices, 16 * id));
    sphere.center.toArray(this.spheres, 4 * id)[4 * id + 3] = sphere.radius;
  }

  visible(camera) {
    const { spheres, planes, seen } = this;
    for (const [k, { normal, constant }] of frustumOf(camera).planes.entries()) {
      normal.toArray(planes, 4 * k)[4 * k + 3] = constant;
    }
    seen.length = 0;
    next: for (let k = 0; k < spheres.length; k += 4) {
      const [x, y, z, radius] = [spheres[k], spheres[k + 1], spheres[k + 2], spheres[k + 3]];
      for (let p = 0; p < 24; p += 4) {
        if (planes[p] * x + planes[p + 1] * y + planes[p + 2] * z + planes[p + 3] < -radius) continue next;
      }
      seen.push(k / 4);
    }
    return seen;
  }
}

/** The tree of @three.ez/instanced-mesh (the package bvh.js), built and updated as there: movers are moved in it. */
export class InstancedMeshTree {
  constructor(geometry, matrices) {
    geometry.computeBoundingBox();
    this.box = geometry.boundingBox;
    this.matrices = matrices;
    this.tree = new BVH(new HybridBuilder(), WebGLCoordinateSystem);
    this.nodes = [];
    this.seen = [];
    const ids = Uint32Array.from({ length: matrices.length / 16 }, (_, id) => id);
    const boxes = Array.from(ids, (id) => this.boxOf(id, new Float32Array(6)));
    this.tree.createFromArray(ids, boxes, (node) => {
      this.nodes[node.object] = node;
    });
  }

  boxOf(id, to) {
    const { min, max } = box.copy(this.box).applyMatrix4(matrix.fromArray(this.matrices, 16 * id));
    for (let axis = 0; axis < 3; axis++) {
      to[2 * axis] = min.getComponent(axis);
      to[2 * axis + 1] = max.getComponent(axis);
    }
    return to;
  }

  move(id) {
    this.boxOf(id, this.nodes[id].box);
    this.tree.move(this.nodes[id], 0);
  }

  visible(camera) {
    this.seen.length = 0;
    matrix.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    this.tree.frustumCulling(matrix.elements, (node) => this.seen.push(node.object));
    return this.seen;
  }
}
