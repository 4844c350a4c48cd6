// npm i && npm start: boxes flying in three dimensions, drawn by the helper of space-helper.mjs alone.
import { BroadPhase } from 'broadphase/all'; // has techniques with cells to show
import { PerspectiveCamera, Scene, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { playButton } from './page/page.mjs';
import { SpaceHelper } from './space-helper.mjs';

const count = 150;
const reach = 10; // centres stay within this distance of the origin, on each axis
const half = 0.7;

const space = new BroadPhase({ dimensions: 3, technique: 'quadtree' });
/** A pseudorandom number from -1 to 1, the same in each run. */
const chance = (k) => 2 * ((43758.5453 * (1 + Math.sin(12.9898 * (k + 1)))) % 1) - 1;
const middles = Float64Array.from({ length: 3 * count }, (_, k) => reach * chance(k));
const speeds = Float64Array.from({ length: 3 * count }, (_, k) => 0.06 * chance(k + 0.5));

function move() {
  for (let k = 0; k < middles.length; k++) {
    middles[k] += speeds[k];
    if (Math.abs(middles[k]) > reach) speeds[k] = -Math.sign(middles[k]) * Math.abs(speeds[k]);
  }
}

const scene = new Scene();
const helper = new SpaceHelper(space, ['boxes', 'touching', 'pairs', 'cells']);
scene.add(helper);
const stage = document.getElementById('stage');
const camera = new PerspectiveCamera(45, 1, 0.1, 200);
const renderer = new WebGLRenderer({ antialias: true, alpha: true });
stage.append(renderer.domElement);
const controls = new OrbitControls(camera, renderer.domElement);
const cells = document.getElementById('cells');
const numbers = document.getElementById('numbers');

function draw() {
  for (let id = 0; id < count; id++) {
    const [x, y, z] = middles.subarray(3 * id);
    space.setCentred(id, x, y, z, half, half, half);
  }
  space.update();
  helper.getObjectByName('cells').visible = cells.checked;
  helper.update();
  renderer.render(scene, camera);
  numbers.innerHTML = `<b>${space.pairCount}</b> pairs of ${count} boxes`;
}

new ResizeObserver(() => {
  const { clientWidth, clientHeight } = stage;
  renderer.setPixelRatio(Math.min(2, devicePixelRatio));
  renderer.setSize(clientWidth, clientHeight);
  camera.aspect = clientWidth / clientHeight;
  camera.position.setLength(42 / Math.min(1, camera.aspect));
  camera.updateProjectionMatrix();
  draw();
}).observe(stage);
camera.position.set(1, 0.7, 2);
camera.lookAt(0, 0, 0);
controls.addEventListener('change', draw);
cells.addEventListener('change', draw);

playButton(document.getElementById('play'), (playing) => {
  const frame = () => {
    move();
    draw();
  };
  renderer.setAnimationLoop(playing ? frame : null);
});
globalThis.example = { space, helper }; // for the test
