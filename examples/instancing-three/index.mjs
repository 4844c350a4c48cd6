// npm i && npm start: a cloud of 20,000 boxes as one InstancedMesh. broadphase finds which overlap, and those glow.
// ?boxes=5000 in the URL changes the number.
import {
  AmbientLight,
  BoxGeometry,
  Color,
  DirectionalLight,
  DynamicDrawUsage,
  InstancedMesh,
  MeshLambertMaterial,
  PerspectiveCamera,
  Scene,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { Cloud } from './cloud.mjs';
import { playButton, stopwatch } from './page/page.mjs';

const count = Number(new URLSearchParams(location.search).get('boxes') ?? 20_000);
const cloud = new Cloud(count);
const stage = document.getElementById('stage');
stage.tabIndex = 0; // so that it gets the keys
const search = stopwatch();

const scene = new Scene();
const sun = new DirectionalLight(0xffffff, 2.2);
sun.position.set(1, 3, 2);
scene.add(new AmbientLight(0xffffff, 1.4), sun);
const camera = new PerspectiveCamera(45, 1, 0.1, 20 * cloud.reach);
const renderer = new WebGLRenderer({ antialias: true, alpha: true });
stage.append(renderer.domElement);
const controls = new OrbitControls(camera, renderer.domElement);
controls.maxDistance = 6 * cloud.reach;

const mesh = new InstancedMesh(new BoxGeometry(), new MeshLambertMaterial(), count);
mesh.instanceMatrix.setUsage(DynamicDrawUsage);
mesh.frustumCulled = false; // the cloud as a whole is always in view
scene.add(mesh);
for (let id = 0; id < count; id++) {
  // The size of a box, on the diagonal of its matrix, never changes. Its place is in the last column.
  for (let axis = 0; axis < 3; axis++) mesh.instanceMatrix.array[16 * id + 5 * axis] = 2 * cloud.halves[3 * id + axis];
  mesh.instanceMatrix.array[16 * id + 15] = 1;
  mesh.setColorAt(id, new Color());
}

const dark = matchMedia('(prefers-color-scheme: dark)');
const cold = new Color();
const hot = new Color(0xff7a1a);

/** Writes places and colours into the mesh, and shows it. */
function draw() {
  cold.set(dark.matches ? 0x5a6bc4 : 0xb9c3ee);
  const matrices = mesh.instanceMatrix.array;
  const colours = mesh.instanceColor.array;
  for (let id = 0; id < count; id++) {
    const heat = cloud.heat[id];
    colours[3 * id] = cold.r + heat * (hot.r - cold.r);
    colours[3 * id + 1] = cold.g + heat * (hot.g - cold.g);
    colours[3 * id + 2] = cold.b + heat * (hot.b - cold.b);
    for (let axis = 0; axis < 3; axis++) matrices[16 * id + 12 + axis] = cloud.middles[3 * id + axis];
  }
  mesh.instanceMatrix.needsUpdate = true;
  mesh.instanceColor.needsUpdate = true;
  renderer.render(scene, camera);
}

let frames = 0;
function step(elapsed) {
  cloud.move(Math.min(2, (elapsed * 60) / 1000));
  search.time(() => cloud.find());
  cloud.glow();
  draw();
  frames++;
}

const numbers = document.getElementById('numbers');
const whole = new Intl.NumberFormat('en', { maximumFractionDigits: 0 });
function report(rate) {
  const { pairCount } = cloud.space;
  numbers.innerHTML = `<b>${search.mean().toFixed(2)} ms</b> to find <b>${whole.format(pairCount)}</b> pairs among ${whole.format(count)} boxes${rate ? ` · ${whole.format(rate)} frames a second` : ''}`;
}
let reported = performance.now();
setInterval(() => {
  if (frames === 0) return;
  const now = performance.now();
  report((1000 * frames) / (now - reported));
  reported = now;
  frames = 0;
}, 500);

new ResizeObserver(() => {
  const { clientWidth, clientHeight } = stage;
  renderer.setPixelRatio(Math.min(2, devicePixelRatio));
  renderer.setSize(clientWidth, clientHeight);
  camera.aspect = clientWidth / clientHeight;
  // Far enough for the cloud to fill the narrower side.
  const distance = (2.8 * cloud.reach) / Math.min(1.3, camera.aspect);
  camera.position.setLength(distance || 1);
  camera.updateProjectionMatrix();
  draw();
}).observe(stage);
camera.position.set(0, 0.6, 1);
camera.lookAt(0, 0, 0);

/** Keys turn and zoom like the pointer. */
stage.addEventListener('keydown', ({ key }) => {
  const { position } = camera;
  if (key === 'ArrowLeft') position.applyAxisAngle(camera.up, -0.1);
  else if (key === 'ArrowRight') position.applyAxisAngle(camera.up, 0.1);
  else if (key === 'ArrowUp') position.y += 0.1 * position.length();
  else if (key === 'ArrowDown') position.y -= 0.1 * position.length();
  else if (key === '+' || key === '=') position.multiplyScalar(0.9);
  else if (key === '-') position.multiplyScalar(1.1);
  else return;
  controls.update();
  draw();
});
controls.addEventListener('change', draw);
dark.addEventListener('change', draw);

let last = 0;
const frame = (now) => {
  step(last ? now - last : 16);
  last = now;
};
cloud.glow();
search.time(() => cloud.find());
report();
playButton(document.getElementById('play'), (playing) => {
  last = 0;
  renderer.setAnimationLoop(playing ? frame : null);
});
globalThis.example = { cloud, camera }; // for the test
