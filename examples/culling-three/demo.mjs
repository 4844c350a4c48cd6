// A showcase: half a million stones orbit in a belt, a camera flies among them, and only those in view are drawn. The
// same boxes serve to pick the one under the pointer, and to show those nearby on a map.
import {
  Box3,
  Color,
  DirectionalLight,
  Fog,
  HemisphereLight,
  IcosahedronGeometry,
  InstancedMesh,
  Mesh,
  MeshLambertMaterial,
  PerspectiveCamera,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
} from 'three';
import { Belt } from './belt.mjs';
import { Culler } from './culler.mjs';
import { time } from './page/showcase.mjs';
import { moveView } from './page/view.mjs';
import { EachByThree, FlatSpheres, InstancedMeshTree, tell } from './rivals.mjs';

/** With more stones, the tree of instanced-mesh takes seconds to build and to move. */
const mostInTree = 20_000;
/** How far the camera sees. */
const sight = 320;
/** At most this many are drawn. */
const mostDrawn = 40_000;
/** How fast the camera flies along the belt, in radians per frame. */
const flight = 0.0004;
const [closest, widest] = [15, 75];
const mapSize = 148;

const whole = new Intl.NumberFormat('en');
const makers = { broadphase: Culler, each: EachByThree, flat: FlatSpheres, tree: InstancedMeshTree };

/** The scene without the stones: see `beltDemo`. */
function makeScene() {
  const scene = new Scene();
  const sun = new DirectionalLight(0xfff0dd, 2.6);
  sun.position.set(1, 0.8, 0.3);
  scene.fog = new Fog(0, sight / 3, sight);
  scene.add(new HemisphereLight(0xdde6ff, 0x554433, 1.3), sun);
  return scene;
}

/** The canvas of the map, in a corner of the stage. */
function makeMap(stage) {
  const map = Object.assign(document.createElement('canvas'), { width: 2 * mapSize, height: 2 * mapSize });
  map.setAttribute('aria-hidden', 'true');
  const look = { position: 'absolute', left: '12px', bottom: '12px', width: `${mapSize}px`, height: `${mapSize}px` };
  Object.assign(map.style, look, { borderRadius: '50%', pointerEvents: 'none' });
  stage.append(map);
  return map.getContext('2d');
}

/** The showcase, with this many stones: see examples/page/showcase.mjs. */
export const beltDemo =
  (count) =>
  (stage, { wake, say }) => {
    const belt = new Belt(count);
    const stone = new IcosahedronGeometry(1, 0);
    const culler = new Culler(stone, belt.matrices);
    let user = culler;
    let [share, flying, angle, yaw, pitch] = [0.01, false, 0, 0, -0.08];

    const scene = makeScene();
    const camera = new PerspectiveCamera(50, 1, 0.5, sight);
    const renderer = new WebGLRenderer({ antialias: true });
    renderer.domElement.setAttribute('aria-hidden', 'true');
    stage.append(renderer.domElement);
    const mesh = new InstancedMesh(stone, new MeshLambertMaterial({ flatShading: true }), mostDrawn);
    mesh.frustumCulled = false; // it has only stones in view
    const marked = new Mesh(stone, new MeshLambertMaterial({ color: 0xff7a1a, flatShading: true }));
    marked.matrixAutoUpdate = marked.frustumCulled = marked.visible = false;
    scene.add(mesh, marked);
    const map = makeMap(stage);
    const around = new Box3();
    const ray = new Raycaster();
    let picked = -1;

    function aim() {
      camera.position.set(belt.radius * Math.cos(angle), 0, belt.radius * Math.sin(angle));
      camera.rotation.set(pitch, -angle - yaw, 0, 'YXZ');
      camera.updateMatrixWorld();
    }
    function move() {
      const { first, many } = belt.move(share);
      tell(culler, first, many);
      if (user !== culler) tell(user, first, many);
    }
    function drawMap(seen) {
      const dot = (id) => {
        const at = (axis) =>
          mapSize * (1 + (belt.matrices[16 * id + 12 + axis] - camera.position.getComponent(axis)) / sight);
        map.fillRect(at(0) - 1, at(2) - 1, 2, 2);
      };
      const { color } = getComputedStyle(stage);
      map.clearRect(0, 0, 2 * mapSize, 2 * mapSize);
      map.fillStyle = `color-mix(in srgb, ${color} 12%, transparent)`;
      map.fillRect(0, 0, 2 * mapSize, 2 * mapSize);
      map.fillStyle = `color-mix(in srgb, ${color} 35%, transparent)`;
      const reach = new Vector3(sight, sight, sight);
      for (const id of culler.within(around.setFromCenterAndSize(camera.position, reach.multiplyScalar(2)))) dot(id);
      map.fillStyle = '#ff7a1a';
      for (const id of seen) dot(id);
    }
    function draw() {
      aim();
      const ours = culler.visible(camera); // also for the map and the pointer
      const seen = user === culler ? ours : user.visible(camera);
      mesh.count = Math.min(seen.length, mostDrawn);
      const to = mesh.instanceMatrix.array;
      for (let k = 0; k < mesh.count; k++) {
        for (let n = 0; n < 16; n++) to[16 * k + n] = belt.matrices[16 * seen[k] + n];
      }
      mesh.instanceMatrix.needsUpdate = true;
      marked.visible = picked >= 0;
      if (picked >= 0) marked.matrix.fromArray(belt.matrices, 16 * picked).scale(new Vector3(1.05, 1.05, 1.05));
      const page = new Color(getComputedStyle(document.body).backgroundColor);
      scene.fog.color = scene.background = page;
      mesh.material.color.set(page.getHSL({}).l < 0.5 ? 0x8f9bd8 : 0x7f88b4);
      renderer.render(scene, camera);
      drawMap(seen);
      const pick = picked < 0 ? '' : `; stone ${whole.format(picked)} is under the pointer`;
      say(
        `${whole.format(seen.length)} of ${whole.format(count)} stones in view, ${whole.format(Math.round(share * count))} move in each frame${pick}`,
      );
    }
    let request = 0;
    const drawSoon = () => {
      cancelAnimationFrame(request);
      request = requestAnimationFrame(draw);
    };
    const setShare = (wanted) => () => {
      share = wanted;
      wake();
    };
    stage.tabIndex = 0;
    moveView(stage, {
      pan(dx, dy) {
        yaw -= 0.004 * dx;
        pitch = Math.max(-1.2, Math.min(1.2, pitch + 0.004 * dy));
        drawSoon();
      },
      zoom(factor) {
        camera.fov = Math.max(closest, Math.min(widest, camera.fov / factor));
        camera.updateProjectionMatrix();
        drawSoon();
      },
      point(x, y) {
        ray.setFromCamera(new Vector2((2 * x) / stage.clientWidth - 1, 1 - (2 * y) / stage.clientHeight), camera);
        const hit = culler.pick(ray.ray);
        picked = hit && hit.distance < sight ? hit.id : -1;
        drawSoon();
      },
    });
    new ResizeObserver(() => {
      renderer.setPixelRatio(Math.min(2, devicePixelRatio));
      renderer.setSize(stage.clientWidth, stage.clientHeight);
      camera.aspect = stage.clientWidth / Math.max(1, stage.clientHeight);
      camera.updateProjectionMatrix();
      drawSoon();
    }).observe(stage);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', drawSoon);
    return {
      legend: 'A frame’s culling, without the drawing, by',
      contenders: {
        broadphase: 'broadphase',
        each: 'each, as BatchedMesh does',
        flat: 'a loop over spheres',
        ...(count <= mostInTree && { tree: 'the tree of instanced-mesh' }),
      },
      use(key) {
        user = key === 'broadphase' ? culler : new makers[key](stone, belt.matrices);
        drawSoon();
      },
      race(key) {
        const contender = key === 'broadphase' ? culler : new makers[key](stone, belt.matrices);
        let moved;
        const prepare = () => {
          moved = belt.move(share);
          if (contender !== culler) tell(culler, moved.first, moved.many);
        };
        return time(() => {
          tell(contender, moved.first, moved.many);
          contender.visible(camera);
        }, prepare);
      },
      actions: {
        Fly() {
          flying = true;
          wake();
        },
        'None move': setShare(0),
        '1 % move': setShare(0.01),
        '10 % move': setShare(0.1),
        'All move': setShare(1),
      },
      step() {
        move();
        if (flying) angle += flight;
        draw();
        return flying;
      },
      settle() {
        move();
        if (flying) angle += 20 * flight;
        flying = false;
        draw();
      },
      stop() {
        flying = false;
      },
      get state() {
        return { belt, camera, culler, count: mesh.count, picked };
      },
    };
  };
