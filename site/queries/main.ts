// The page of queries: moving boxes, one query in each frame, and its answer shown among the boxes. The query is
// aimed by dragging or with the arrow keys, and chosen by the URL.
import { BroadPhase } from 'broadphase';
import { Camera } from '../shared/camera.ts';
import { density } from '../shared/density.ts';
import { find, showPlaying } from '../shared/elements.ts';
import { formatCount } from '../shared/format.ts';
import { FrameLoop } from '../shared/loop.ts';
import { numberPanel } from '../shared/numbers.ts';
import { makePalette } from '../shared/palette.ts';
import { createRenderer, type RendererKind } from '../shared/renderer.ts';
import { type LiveScene, seededScene } from '../shared/scenes.ts';
import '../shared/stopped.ts';
import { Timings } from '../shared/timings.ts';
import type { Ask, Desk } from './ask.ts';
import { asks, setLayers } from './asks.ts';
import { Pen } from './pen.ts';

/** Milliseconds between two updates of text that changes all the time. */
const refresh = 200;
/** Answers before the first that is timed: the browser compiles what runs often. */
const warmUp = 30;
/** How far an arrow key moves, as a share of the world. */
const keyStep = 0.02;
/** A pointer that moves less, in pixels, does not drag. */
const leastDrag = 6;
const everyone = 7;

const view = find('view');
view.tabIndex = 0;
const canvas = find<HTMLCanvasElement>('boxes');
const upper = find<HTMLCanvasElement>('upper');
const call = find('call');
const countMenu = find<HTMLSelectElement>('count');
const sliders = { k: find<HTMLInputElement>('k'), radius: find<HTMLInputElement>('radius') };
const allBox = find<HTMLInputElement>('all');
const withinBox = find<HTMLInputElement>('within');
const write = numberPanel(document);
const kinds: readonly RendererKind[] = ['webgl2', 'canvas-2d'];
const wantedKind = new URLSearchParams(location.search).get('renderer');

const space = new BroadPhase({ events: true });
const camera = new Camera();
const pen = new Pen(upper, camera);
const renderer = createRenderer(
  canvas,
  () => draw(),
  kinds.find((kind) => kind === wantedKind),
);
const desk: { -readonly [Name in keyof Desk]: Desk[Name] } = {
  space,
  boxes: new Float32Array(),
  slots: new Uint8Array(),
  world: 1,
  aim: new Float64Array(4),
  aimed: true,
  k: 10,
  radius: 0,
  all: false,
  within: false,
  mask: everyone,
  pen,
};
let scene: LiveScene;
let ask: Ask = asks[0];
let found = 0;
const timings = new Timings();
let read = 0;

/** Finds the pairs of the current boxes. */
function update(): void {
  space.boxes(scene.count).set(scene.boxes);
  const started = performance.now();
  space.update();
  const ended = performance.now();
  if (!ask.ask) timings.add(ended, ended - started);
}

/** Makes the query and draws its answer. */
function answer(): void {
  desk.slots.fill(0);
  ask.prepare?.(desk);
  if (ask.ask) {
    const started = performance.now();
    ask.ask(desk);
    const ended = performance.now();
    timings.add(ended, ended - started);
  }
  found = ask.mark(desk);
  desk.aimed = false;
  draw();
}

function draw(): void {
  if (!scene) return;
  renderer.draw(scene.boxes, desk.slots, scene.count, camera);
  pen.begin(density());
  ask.draw(desk);
}

function report(): void {
  read = performance.now();
  call.textContent = ask.text(desk);
  write('found', formatCount(found));
  // There is no time of an update() before the first in which something has moved.
  write('time', timings.summarise() ? (1000 * timings.median).toFixed(timings.median < 0.01 ? 1 : 0) : '–');
}

let pending = 0;
/** Answers once before the next frame, and updates the text, after something was moved or chosen. */
function answerSoon(): void {
  cancelAnimationFrame(pending);
  pending = requestAnimationFrame(() => {
    answer();
    report();
  });
}

const loop = new FrameLoop(() => {
  scene.step();
  update();
  answer();
  if (performance.now() - read > refresh) report();
});

/** Aims across the middle of the world, if possible from a place with room around it. */
function aimAnew(): void {
  const { world, aim } = desk;
  const room = world / 30;
  for (let place = 0; place < 400; place++) {
    const x = (0.25 + 0.01 * (place % 20)) * world;
    const y = (0.3 + 0.01 * Math.floor(place / 20)) * world;
    aim.set([x, y, x + 0.28 * world, y + 0.16 * world]);
    if (space.queryBox(x - room, y - room, x + room, y + room).length === 0) break;
  }
  desk.aimed = true;
}

function showScene(): void {
  const count = Number(countMenu.value);
  scene = seededScene('uniform2d', count);
  desk.boxes = scene.boxes;
  desk.slots = new Uint8Array(count);
  desk.world = scene.world[2];
  space.clear();
  camera.fit(scene.world);
  readOptions();
  layers();
  update();
  aimAnew();
  update(); // once more, so that the pairs there now have not just begun
  answerSoon();
}

/** Lets all layers meet, unless the query is about layers. */
function layers(): void {
  space.boxes(scene.count).set(scene.boxes);
  const meets = [0, 0, 0];
  for (const { value, checked } of document.querySelectorAll<HTMLInputElement>('[name=meet]')) {
    const [one, other] = value.split(' ').map(Number);
    if (!checked) continue;
    meets[one] |= 1 << other;
    meets[other] |= 1 << one;
  }
  setLayers(space, scene.count, ask.name === 'filters' ? meets : [everyone, everyone, everyone]);
}

function readOptions(): void {
  desk.k = sliders.k.valueAsNumber;
  desk.radius = (sliders.radius.valueAsNumber / 400) * desk.world;
  desk.all = allBox.checked;
  desk.within = withinBox.checked;
  desk.mask = 0;
  for (const { value, checked } of document.querySelectorAll<HTMLInputElement>('[name=mask]')) {
    if (checked) desk.mask |= Number(value);
  }
  for (const [name, slider] of Object.entries(sliders)) {
    const share = (slider.valueAsNumber - Number(slider.min)) / (Number(slider.max) - Number(slider.min));
    slider.style.setProperty('--filled', `${100 * share}%`);
    const text = name === 'k' ? slider.value : String(Math.round(desk.radius * 10) / 10);
    document.querySelector(`output[for=${name}]`)!.textContent = text;
  }
}

function choose(name: string): void {
  ask = asks.find((one) => one.name === name) ?? asks[0];
  for (const option of document.querySelectorAll<HTMLElement>('[data-option]')) {
    option.hidden = !ask.options.some((wanted) => wanted === option.dataset.option);
  }
  find('options').hidden = ask.options.length === 0;
  find('hint').textContent = ask.hint;
  find('found-label').textContent = ask.counts;
  canvas.setAttribute('aria-label', `${scene.count} boxes. ${ask.label}: ${ask.hint}`);
  find<HTMLInputElement>(`ask-${ask.name}`).checked = true;
  desk.aimed = true;
  space.technique = ask.technique ?? 'auto';
  layers();
  update();
  ask.prepare?.(desk);
  for (let n = 0; n < warmUp; n++) ask.ask?.(desk);
  find('time-label').textContent = ask.ask ? 'Answered in' : 'update() took';
  timings.clear();
  answerSoon();
}

function fillAsks(): void {
  for (const { name, label } of asks) {
    const input = document.createElement('input');
    Object.assign(input, { type: 'radio', name: 'ask', id: `ask-${name}`, value: name });
    const around = document.createElement('label');
    around.append(input, label);
    find('asks').append(around);
    input.addEventListener('change', () => {
      history.replaceState(null, '', `#${name}`);
      choose(name);
    });
  }
}

// Aiming. A drag sets both points; a press without one moves both, so that what was aimed keeps its shape.

const place = { x: 0, y: 0 };
function toWorld(event: PointerEvent): void {
  const pixels = camera.width / view.clientWidth;
  const frame = view.getBoundingClientRect();
  place.x = camera.x + ((event.clientX - frame.left) * pixels - camera.width / 2) / camera.scale;
  place.y = camera.y - ((event.clientY - frame.top) * pixels - camera.height / 2) / camera.scale;
}

let pressed: { id: number; x: number; y: number } | undefined;
view.addEventListener('pointerdown', (event) => {
  if (!event.isPrimary || event.button !== 0) return;
  view.setPointerCapture(event.pointerId);
  toWorld(event);
  const { aim } = desk;
  pressed = { id: event.pointerId, x: event.clientX, y: event.clientY };
  const [dx, dy] = [aim[2] - aim[0], aim[3] - aim[1]];
  const alone = ['point', 'circle', 'fan', 'nearest', 'partners', 'spaces'].includes(ask.name);
  if (alone) aim.set([place.x - dx, place.y - dy, place.x, place.y]);
  else aim.set([place.x, place.y, place.x + dx, place.y + dy]);
  desk.aimed = true;
  answerSoon();
});
view.addEventListener('pointermove', (event) => {
  if (pressed?.id !== event.pointerId) return;
  if (Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) < leastDrag) return;
  toWorld(event);
  desk.aim[2] = place.x;
  desk.aim[3] = place.y;
  desk.aimed = true;
  answerSoon();
});
const release = () => {
  pressed = undefined;
};
view.addEventListener('pointerup', release);
view.addEventListener('pointercancel', release);

const arrows: Record<string, readonly [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};
view.addEventListener('keydown', (event) => {
  const way = arrows[event.key];
  if (!way || event.altKey || event.ctrlKey || event.metaKey) return;
  event.preventDefault();
  const { aim, world } = desk;
  desk.aimed = true;
  const first = event.shiftKey ? 2 : 0;
  for (let axis = 0; axis < 2; axis++) {
    // Both points move equally far, also at the border, so that what was aimed keeps its shape.
    const [low, high] = [Math.min(aim[first + axis], aim[2 + axis]), Math.max(aim[first + axis], aim[2 + axis])];
    const wish = way[axis] * keyStep * world;
    // What a pointer has aimed outside stays there, and can come back.
    const by = wish < 0 ? Math.max(wish, Math.min(0, -low)) : Math.min(wish, Math.max(0, world - high));
    for (let k = first + axis; k < 4; k += 2) aim[k] += by;
  }
  answerSoon();
});

function play(playing: boolean): void {
  loop.playing = playing;
  showPlaying(playing);
  report(); // so that the numbers match the picture, even if it stops between two reports
}
find('play').addEventListener('click', () => play(!loop.playing));
find('step').addEventListener('click', () => {
  play(false);
  scene.step();
  update();
  answer();
  report();
});
countMenu.addEventListener('change', () => {
  showScene();
  choose(ask.name);
});
find('options').addEventListener('input', () => {
  readOptions();
  if (ask.name === 'filters') {
    layers();
    update();
  }
  answerSoon();
});
addEventListener('hashchange', () => choose(location.hash.slice(1)));

const dark = matchMedia('(prefers-color-scheme: dark)');
function dress(): void {
  const style = getComputedStyle(view);
  renderer.setPalette(makePalette(dark.matches, style.getPropertyValue('--page').trim()));
  pen.dress(style);
  draw();
}
dark.addEventListener('change', dress);

function fitCanvas(): void {
  const width = Math.round(canvas.clientWidth * density());
  const height = Math.round(canvas.clientHeight * density());
  for (const each of [canvas, upper]) {
    each.width = width;
    each.height = height;
  }
  camera.resize(width, height);
  draw();
}

fillAsks();
showScene();
dress();
new ResizeObserver(fitCanvas).observe(canvas);
fitCanvas();
choose(location.hash.slice(1));
loop.watch(view);
const still = matchMedia('(prefers-reduced-motion: reduce)');
still.addEventListener('change', () => play(!still.matches));
play(!still.matches);
