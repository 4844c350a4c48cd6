// node bench.mjs: milliseconds per frame to report the movers and cull, in turns, on the same frames. Each contender is
// checked once for each number of stones: none may miss a stone with a corner in view.
import { IcosahedronGeometry, PerspectiveCamera } from 'three';
import { Belt } from './belt.mjs';
import { Culler } from './culler.mjs';
import { missing } from './missing.mjs';
import { EachByThree, FlatSpheres, InstancedMeshTree, tell } from './rivals.mjs';

const makers = {
  broadphase: Culler,
  'each, as BatchedMesh does': EachByThree,
  'a loop over spheres': FlatSpheres,
  'the tree of instanced-mesh': InstancedMeshTree,
};
/** With more movers, the tree of instanced-mesh, which moves them one by one, takes seconds per frame. */
const mostInTree = 20_000;
const frames = 15;
const warmUp = 5;
const median = (times) => times.sort((a, b) => a - b)[times.length >> 1];

console.log(`| stones | move | in view | ${Object.keys(makers).join(' | ')} |`);
console.log('| --- | --- | --- | --- | --- | --- | --- |');
for (const count of [20_000, 100_000, 500_000]) {
  const stone = new IcosahedronGeometry(1, 0);
  const belt = new Belt(count);
  const contenders = Object.values(makers).map((Maker) => new Maker(stone, belt.matrices));
  const camera = new PerspectiveCamera(50, 1.6, 0.5, 320);
  camera.position.set(belt.radius, 0, 0);
  for (const share of [0, 0.01, 0.1, 1]) {
    const times = contenders.map(() => []);
    let inView = 0;
    for (let frame = 0; frame < warmUp + frames; frame++) {
      camera.rotation.set(-0.08, 0.02 * frame, 0, 'YXZ');
      camera.updateMatrixWorld();
      const { first, many } = belt.move(share);
      for (const [k, contender] of contenders.entries()) {
        if (contender instanceof InstancedMeshTree && many > mostInTree) continue;
        const started = performance.now();
        tell(contender, first, many);
        const seen = contender.visible(camera);
        if (frame >= warmUp) times[k].push(performance.now() - started);
        if (k === 0) inView = seen.length;
        if (frame === warmUp && share === 1 && missing(seen, stone, belt.matrices, camera).length > 0)
          throw new Error(`${contender.constructor.name}: a stone is missing`);
      }
    }
    const taken = times.map(median);
    const cells = taken.map((each) => (each ? `${each.toPrecision(3)} (${(each / taken[0]).toFixed(1)}x)` : '–'));
    console.log(`| ${[count, `${100 * share} %`, inView, ...cells].join(' | ')} |`);
  }
}
