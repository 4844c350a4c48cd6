// A camera sees the boxes that three.js itself finds visible, and no visible stone is missing. A ray and a map find
// what a loop over all stones finds. All this while stones move.
import { Box3, BoxGeometry, Frustum, Matrix4, PerspectiveCamera, Ray, Vector3 } from 'three';
import { describe, expect, test } from 'vitest';
import { Belt, seeded } from '../culling-three/belt.mjs';
import { Culler } from '../culling-three/culler.mjs';
import { missing } from '../culling-three/missing.mjs';
import { EachByThree, FlatSpheres, InstancedMeshTree, tell } from '../culling-three/rivals.mjs';

const count = 1000;
/** Off its own centre, so that the test covers that. */
const brick = new BoxGeometry(1.5, 0.5, 1).translate(0.4, 0, -0.2);
/** Larger than the rounding error of a coordinate. */
const slack = 1e-3;

function look(belt, random) {
  const camera = new PerspectiveCamera(30 + 60 * random(), 0.5 + random(), 0.5, 40 + 80 * random());
  const angle = 6 * random();
  camera.position.set(belt.radius * Math.cos(angle), 0, belt.radius * Math.sin(angle));
  camera.rotation.set(random() - 0.5, 6 * random(), random() - 0.5, 'YXZ');
  camera.updateMatrixWorld();
  return camera;
}

const boxesOf = ({ matrices }) =>
  Array.from({ length: count }, (_, id) =>
    new Box3()
      .setFromBufferAttribute(brick.attributes.position)
      .applyMatrix4(new Matrix4().fromArray(matrices, 16 * id)),
  );

describe.each([0, 0.01, 0.1, 1])('a share of %d moves', (share) => {
  test('all see what shows; ours sees exactly the boxes that three.js does', () => {
    const random = seeded(3);
    const belt = new Belt(count);
    const makers = [Culler, EachByThree, FlatSpheres, InstancedMeshTree];
    const contenders = makers.map((Maker) => new Maker(brick, belt.matrices));
    let shown = 0;
    for (let frame = 0; frame < 8; frame++) {
      const camera = look(belt, random);
      const { first, many } = belt.move(share);
      for (const contender of contenders) {
        tell(contender, first, many);
        expect(missing(contender.visible(camera), brick, belt.matrices, camera)).toEqual([]);
      }
      const matrix = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
      const view = new Frustum().setFromProjectionMatrix(matrix);
      const seen = new Set(contenders[0].visible(camera));
      for (const [id, box] of boxesOf(belt).entries()) {
        if (seen.has(id)) expect(view.intersectsBox(box.expandByScalar(slack))).toBe(true);
        else expect(view.intersectsBox(box.expandByScalar(-slack))).toBe(false);
      }
      shown += seen.size;
    }
    expect(shown).toBeGreaterThan(100);
  });
});

test('a ray meets the first box, and a map has those around', () => {
  const random = seeded(5);
  const belt = new Belt(count);
  const culler = new Culler(brick, belt.matrices);
  culler.visible(look(belt, random));
  const boxes = boxesOf(belt);
  let met = 0;
  for (let k = 0; k < 60; k++) {
    const angle = 6 * random();
    const origin = new Vector3(1.2 * belt.radius * Math.cos(angle), 0, 1.2 * belt.radius * Math.sin(angle));
    const ray = new Ray(origin, new Vector3(0, 0.04 * (random() - 0.5), 0).sub(origin).normalize());
    const distance = (box) => ray.intersectBox(box, new Vector3())?.distanceTo(origin) ?? Infinity;
    // For a ray that begins inside, three.js returns where it leaves; ours returns 0.
    const distances = boxes.map((box) => (box.containsPoint(origin) ? 0 : distance(box)));
    const nearest = Math.min(...distances);
    const hit = culler.pick(ray);
    if (nearest < Infinity) met++;
    expect(hit?.distance ?? Infinity).toBeCloseTo(nearest, 2);

    const around = new Box3().setFromCenterAndSize(origin.multiplyScalar(0.85), new Vector3(40, 40, 40));
    const expected = boxes.flatMap((box, id) => (box.intersectsBox(around) ? [id] : []));
    expect([...culler.within(around)].sort((a, b) => a - b)).toEqual(expected);
  }
  expect(met).toBeGreaterThan(5);
});
