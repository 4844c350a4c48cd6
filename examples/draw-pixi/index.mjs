// npm i && npm start: flying boxes, and a ray from the middle to the pointer, drawn by the overlay of space-overlay.mjs
// alone.
import { BroadPhase } from 'broadphase/all'; // has techniques with cells to show
import { Application } from 'pixi.js';
import { playButton } from './page/page.mjs';
import { SpaceOverlay } from './space-overlay.mjs';

const count = 120;
const half = 12;

const stage = document.getElementById('stage');
const app = new Application();
await app.init({
  resizeTo: stage,
  backgroundAlpha: 0,
  autoStart: false,
  autoDensity: true,
  resolution: devicePixelRatio,
});
stage.append(app.canvas);

const space = new BroadPhase({ technique: 'quadtree' });
const overlay = new SpaceOverlay(space);
app.stage.addChild(overlay);
const cells = document.getElementById('cells');
const numbers = document.getElementById('numbers');

/** A pseudorandom number from 0 to 1, the same in each run. */
const chance = (k) => (43758.5453 * (1 + Math.sin(12.9898 * (k + 1)))) % 1;
/** Places, as shares of the stage. */
const places = Float64Array.from({ length: 2 * count }, (_, k) => chance(k));
const speeds = Float64Array.from({ length: 2 * count }, (_, k) => 0.004 * (chance(k + 0.5) - 0.5));
const aim = [1, 0.4];

function move() {
  for (let k = 0; k < places.length; k++) {
    places[k] += speeds[k];
    if (places[k] < 0 || places[k] > 1) speeds[k] = Math.sign(0.5 - places[k]) * Math.abs(speeds[k]);
  }
}

function draw() {
  const { width, height } = app.screen;
  for (let id = 0; id < count; id++) {
    space.setCentred(id, places[2 * id] * width, places[2 * id + 1] * height, half, half);
  }
  space.update();
  overlay.cells = cells.checked;
  overlay.rays = [[width / 2, height / 2, ...aim]];
  overlay.update();
  app.render();
  numbers.innerHTML = `<b>${space.pairCount}</b> pairs of ${count} boxes`;
}

app.renderer.on('resize', draw);
cells.addEventListener('change', draw);
stage.addEventListener('pointermove', ({ offsetX, offsetY }) => {
  aim[0] = offsetX - app.screen.width / 2;
  aim[1] = offsetY - app.screen.height / 2;
  draw();
});

draw();
let request = 0;
function frame() {
  move();
  draw();
  request = requestAnimationFrame(frame);
}
playButton(document.getElementById('play'), (playing) => {
  cancelAnimationFrame(request);
  if (playing) request = requestAnimationFrame(frame);
});
globalThis.example = { space, overlay }; // for the test
