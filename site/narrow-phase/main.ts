// The page of the narrow phase: the worlds of examples/narrow-phase, drawn. Thin lines are the boxes of the broad phase
// and their pairs, as broadphase/draw shows them. Shapes in colour really touch.
import { drawSpace } from 'broadphase/draw';
import {
  type FastThing,
  fastBoxes,
  type MaskThing,
  masks,
  type ShapeThing,
  shapes,
  world,
} from '../../examples/narrow-phase/scenes.mjs';
import { density } from '../shared/density.ts';
import { find, showPlaying } from '../shared/elements.ts';
import { formatCount } from '../shared/format.ts';
import { FrameLoop } from '../shared/loop.ts';
import { numberPanel } from '../shared/numbers.ts';
import '../shared/stopped.ts';
import { Timings } from '../shared/timings.ts';

const refresh = 250;
/** Frames before the first one shown. */
const settling = 60;

const canvas = find<HTMLCanvasElement>('canvas');
const countMenu = find<HTMLSelectElement>('count');
const context = canvas.getContext('2d')!;
const write = numberPanel(document);
const broad = new Timings();
const narrow = new Timings();
const ink = { page: '', line: '', muted: '', accent: '', text: '' };

interface Kind {
  readonly make: (count: number) => ReturnType<typeof shapes> | ReturnType<typeof masks> | ReturnType<typeof fastBoxes>;
  readonly hint: string;
  readonly word: string;
  readonly code: string;
}

const kinds: Record<string, Kind> = {
  shapes: {
    make: shapes,
    hint: 'In colour: shapes that touch. Grey: boxes in a pair.',
    word: 'Separating axes, with SAT.js: two convex shapes are apart exactly if some line separates them. The answer contains the way out, so that shapes that touch can be pushed apart.',
    code: '// for each pair a, b:\nconst contact = contactOf(a, b);\nif (contact) pushApart(a, b, contact);',
  },
  masks: {
    make: masks,
    hint: 'In colour: pictures with a pixel in common. Grey: boxes in a pair.',
    word: 'Pixel masks: two pictures touch where both have a solid pixel. Only the overlap of the two boxes is checked.',
    code: '// for each pair a, b:\nif (masksTouch(a.mask, a.x, a.y, b.mask, b.x, b.y)) {\n  hit(a, b);\n}',
  },
  fast: {
    make: fastBoxes,
    hint: 'Grey: bounds of a bullet’s path, and its pairs. In colour: its path until it hits a box, and that box.',
    word: 'Swept boxes: a bullet that flies 40 times its width in a frame is stored as the bounds of its path, so its pairs are everything it may hit; the time of the hit is computed exactly.',
    code: 'space.setSwept(id, ...box, dx, dy);\n// for each pair a, b:\nconst met = meeting(a.box, a.way, b.box, b.way);\nif (met) hit(a, b, met.time);',
  },
};

let kind = kinds.shapes;
let scene = kind.make(Number(countMenu.value));
let read = 0;

function step(): void {
  scene.react();
  solve();
}

/** Moves things and finds what touches. To move them is not part of the broad phase. */
function solve(): void {
  scene.move();
  const started = performance.now();
  scene.broad();
  const between = performance.now();
  scene.narrow();
  const ended = performance.now();
  broad.add(between, between - started);
  narrow.add(ended, ended - between);
}

function report(): void {
  read = performance.now();
  write('pairs', formatCount(scene.space.pairCount));
  write('hits', formatCount(scene.hits.length / 2));
  if (broad.summarise()) write('broad', (1000 * broad.median).toFixed(0));
  if (narrow.summarise()) write('narrow', (1000 * narrow.median).toFixed(0));
}

const touching = new Set<number>();

function draw(): void {
  const { width, height } = canvas;
  const scale = Math.min(width, height) / world;
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.fillStyle = ink.page;
  context.fillRect(0, 0, width, height);
  context.setTransform(scale, 0, 0, scale, (width - scale * world) / 2, (height - scale * world) / 2);
  touching.clear();
  for (const id of scene.hits) touching.add(id);
  const sharpness = density();
  drawSpace(context, scene.space, { colors: { boxes: ink.line, pairs: ink.muted }, lineWidth: sharpness });
  const pixel = sharpness / scale;
  for (const [id, thing] of scene.things.entries()) {
    const touches = touching.has(id);
    context.fillStyle = ink.accent;
    context.globalAlpha = 1;
    if ('shape' in thing) drawShape(thing, touches, pixel);
    else if ('mask' in thing) drawMask(thing, touches);
    else drawFast(thing, touches, pixel);
    context.globalAlpha = 1;
  }
}

function drawShape({ shape: { pos, r, calcPoints } }: ShapeThing, touches: boolean, pixel: number): void {
  context.beginPath();
  if (r !== undefined) context.arc(pos.x, pos.y, r, 0, 2 * Math.PI);
  for (const { x, y } of calcPoints ?? []) context.lineTo(pos.x + x, pos.y + y);
  context.closePath();
  context.setLineDash([]);
  context.lineWidth = 2 * pixel;
  context.strokeStyle = touches ? ink.accent : ink.muted;
  if (touches) {
    context.globalAlpha = 0.45;
    context.fill();
    context.globalAlpha = 1;
  }
  context.stroke();
}

function drawMask({ mask: { width, solid }, left, top }: MaskThing, touches: boolean): void {
  context.fillStyle = touches ? ink.accent : ink.muted;
  context.globalAlpha = touches ? 0.75 : 0.4;
  for (let k = 0; k < solid.length; k++) {
    if (solid[k]) context.fillRect(left + (k % width), top + Math.floor(k / width), 1, 1);
  }
}

function drawFast(thing: FastThing, touches: boolean, pixel: number): void {
  const [minX, minY, maxX, maxY] = thing.box;
  context.setLineDash([]);
  context.lineWidth = 2 * pixel;
  if (!thing.isBullet) {
    context.strokeStyle = touches ? ink.accent : ink.muted;
    context.strokeRect(minX, minY, maxX - minX, maxY - minY);
    if (!touches) return;
    context.globalAlpha = 0.45;
    context.fillRect(minX, minY, maxX - minX, maxY - minY);
    return;
  }
  const [x, y] = [(minX + maxX) / 2, (minY + maxY) / 2];
  const line = (from: number, to: number, colour: string, dashed: boolean) => {
    context.strokeStyle = colour;
    context.setLineDash(dashed ? [5 * pixel, 4 * pixel] : []);
    context.beginPath();
    context.moveTo(x + from * thing.way[0], y + from * thing.way[1]);
    context.lineTo(x + to * thing.way[0], y + to * thing.way[1]);
    context.stroke();
  };
  line(0, thing.time, ink.accent, false);
  if (thing.first >= 0) line(thing.time, 1, ink.line, true);
  context.fillStyle = ink.text;
  context.fillRect(minX, minY, maxX - minX, maxY - minY);
}

function show(name: string): void {
  const chosen = Object.hasOwn(kinds, name) ? name : 'shapes';
  kind = kinds[chosen];
  find<HTMLInputElement>(`kind-${chosen}`).checked = true;
  find('hint').textContent = kind.hint;
  find('word').textContent = kind.word;
  find('code').textContent = kind.code;
  scene = kind.make(Number(countMenu.value));
  // Pushes apart what overlaps at first, and lets the browser compile what runs often.
  for (let frame = 0; frame < settling; frame++) step();
  broad.clear();
  narrow.clear();
  step();
  // A still picture should show something that touches.
  for (let frame = 0; frame < settling && scene.hits.length === 0; frame++) step();
  draw();
  report();
}

const loop = new FrameLoop(() => {
  step();
  draw();
  if (performance.now() - read > refresh) report();
});
loop.watch(canvas);

function play(playing: boolean): void {
  loop.playing = playing;
  showPlaying(playing);
  report(); // so that the numbers match the picture, even if it stops between two reports
}
find('play').addEventListener('click', () => play(!loop.playing));
find('step').addEventListener('click', () => {
  play(false);
  step();
  draw();
  report();
});
find('kinds').addEventListener('change', (event) => {
  const { value } = event.target as HTMLInputElement;
  history.replaceState(null, '', `#${value}`);
  show(value);
});
countMenu.addEventListener('change', () => show(location.hash.slice(1)));
addEventListener('hashchange', () => show(location.hash.slice(1)));

function dress(): void {
  const style = getComputedStyle(canvas);
  for (const name of Object.keys(ink) as (keyof typeof ink)[]) ink[name] = style.getPropertyValue(`--${name}`).trim();
  draw();
}
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', dress);

function fitCanvas(): void {
  canvas.width = Math.round(canvas.clientWidth * density());
  canvas.height = Math.round(canvas.clientHeight * density());
  draw();
}

show(location.hash.slice(1));
dress();
new ResizeObserver(fitCanvas).observe(canvas);
const still = matchMedia('(prefers-reduced-motion: reduce)');
still.addEventListener('change', () => play(!still.matches));
play(!still.matches);
