// npm i && npm start: 100,000 sprites. Only those in view are drawn (queryBox), and the one under the pointer is found
// (queryPoint).
import { BroadPhase } from 'broadphase';
import { Application, Container, Graphics, Sprite, Texture } from 'pixi.js';
import { stopwatch } from './page/page.mjs';
import { moveView } from './page/view.mjs';

const count = 100_000;
/** The golden angle: tiles are arranged like the seeds of a sunflower. */
const turn = Math.PI * (3 - Math.sqrt(5));
const spacing = 21;
const [closest, farthest] = [4, 0.05];

const stage = document.getElementById('stage');
stage.tabIndex = 0; // so that it gets the keys
const app = new Application();
await app.init({
  resizeTo: stage,
  backgroundAlpha: 0,
  autoStart: false,
  autoDensity: true,
  resolution: devicePixelRatio,
});
stage.append(app.canvas);

const world = new Container();
const marker = new Graphics();
app.stage.addChild(world);
const space = new BroadPhase();
const sprites = Array.from({ length: count }, (_, id) => {
  const reach = spacing * Math.sqrt(id + 0.5);
  const [x, y] = [reach * Math.cos(turn * id), reach * Math.sin(turn * id)];
  const [width, height] = [12 + 20 * Math.sin(0.37 * id) ** 2, 12 + 20 * Math.cos(0.23 * id) ** 2];
  const sprite = new Sprite({ texture: Texture.WHITE, anchor: 0.5, x, y, width, height, visible: false });
  sprite.tint = `hsl(${(200 + reach / 40 + 40 * Math.sin(turn * id * 21)) % 360} 62% 60%)`;
  space.set(id, x - width / 2, y - height / 2, x + width / 2, y + height / 2);
  return sprite;
});
space.update(); // queries see the boxes of the last update
for (const sprite of sprites) world.addChild(sprite);
world.addChild(marker);

const whole = new Intl.NumberFormat('en');
const numbers = document.getElementById('numbers');
const picked = document.getElementById('picked');
const cull = document.getElementById('cull');
const search = stopwatch();
const drawing = stopwatch();

/** The ids in view, in one array that is reused. */
const view = { out: [] };

function draw() {
  const [left, top] = toWorld(0, 0);
  const [right, bottom] = toWorld(app.screen.width, app.screen.height);
  for (const id of view.out) sprites[id].visible = false;
  if (cull.checked) search.time(() => space.queryBox(left, top, right, bottom, view));
  else view.out = sprites.map((_, id) => id);
  for (const id of view.out) sprites[id].visible = true;
  drawing.time(() => app.render());
  const found = cull.checked ? `, found in <b>${search.mean().toFixed(2)} ms</b>` : '';
  numbers.innerHTML = `<b>${whole.format(view.out.length)}</b> of ${whole.format(count)} drawn${found}; drawn in <b>${drawing.mean().toFixed(1)} ms</b>`;
}

let request = 0;
const drawSoon = () => {
  cancelAnimationFrame(request);
  request = requestAnimationFrame(draw);
};

/** Converts a place on the screen to one in the world. */
const toWorld = (x, y) => [(x - world.x) / world.scale.x, (y - world.y) / world.scale.y];

/** Marks the topmost tile at a place on the screen: the one drawn last, which has the largest id. */
function pick(x, y) {
  const id = Math.max(-1, ...space.queryPoint(...toWorld(x, y)));
  marker.clear();
  picked.textContent = id < 0 ? 'No tile is here.' : `Tile ${whole.format(id)}`;
  if (id >= 0) {
    const [minX, minY, maxX, maxY] = space.get(id);
    marker.rect(minX, minY, maxX - minX, maxY - minY).stroke({ width: 4, color: 0xff7a1a });
  }
  drawSoon();
}

function zoom(factor, x, y) {
  const scale = Math.min(closest, Math.max(farthest, world.scale.x * factor));
  const [worldX, worldY] = toWorld(x, y);
  world.scale.set(scale);
  world.position.set(x - worldX * scale, y - worldY * scale);
  drawSoon();
}

function pan(dx, dy) {
  world.position.set(world.x + dx, world.y + dy);
  drawSoon();
}

moveView(stage, { pan, zoom, point: pick });
cull.addEventListener('change', drawSoon);
app.renderer.on('resize', drawSoon);
world.position.set(app.screen.width / 2, app.screen.height / 2);
draw();
drawSoon(); // the first frame allocates, so it takes longer than all others
globalThis.example = { app, space, sprites, world }; // for the test
