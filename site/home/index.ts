// The first page: boxes that move, their pairs found every frame, and what that costs.
// Choices are in the URL, so that a view can be sent to someone.
import { BroadPhase, type TechniqueName } from 'broadphase';
import rain from '../../recordings/rain.trace.gz?url';
import type { SceneName } from '../../src/scenes/index.ts';
import { find, showPlaying } from '../shared/elements.ts';
import { Figure } from '../shared/figure.ts';
import { formatCount, formatMilliseconds, formatRate, formatShare } from '../shared/format.ts';
import { numberPanel } from '../shared/numbers.ts';
import type { RendererKind } from '../shared/renderer.ts';
import { fetchRecording, type LiveScene, recordedScene, seededScene } from '../shared/scenes.ts';
import '../shared/stopped.ts';

/** The scenes of the menu: name, label, and a short description. */
const scenes: readonly (readonly [SceneName | 'rain', string, string])[] = [
  ['uniform2d', 'Uniform', 'All of one size, evenly spread.'],
  ['mixed2d', 'Mixed sizes', 'From 2 to 2,000 wide: no cell size of a plain grid suits them all.'],
  ['clustered2d', 'Clusters', 'Twenty crowds in an empty world.'],
  ['giants2d', 'A few giants', 'One in a thousand is a hundred times as wide as the others.'],
  ['dense2d', 'Dense', 'Everything touches many others.'],
  ['sparse2d', 'Sparse', 'Hardly anything touches.'],
  ['static2d', 'Mostly still', 'One in twenty moves.'],
  ['skewed2d', 'Long and thin', '200 by 1, along either axis.'],
  ['rain', 'Rain (Box2D)', 'Real input: every shape of a Box2D world, recorded; in slow motion, back and forth.'],
];

const fewest = 100;
const most = 200_000;
/** Brute force tests every pair of boxes: with more boxes a frame would take seconds. */
const mostByBruteForce = 20_000;
/** The number of boxes until the visitor chooses one: the largest of these that runs smoothly on this machine. */
const greetings = [100_000, 50_000, 20_000, 10_000, 5_000];
/** Frames per second. */
const smooth = 28;
/** Milliseconds of play in which this is measured. */
const trial = 1500;
const frameBudget = 1000 / 60;
const refresh = 250;

const slider = find<HTMLInputElement>('count');
const sceneMenu = find<HTMLSelectElement>('scene');
const techniqueMenu = find<HTMLSelectElement>('technique');
const note = find('note');
const meter = find('meter');
const canvas = find('boxes');
const write = numberPanel(document);

/** For comparison, the renderer can be chosen in the URL: ?renderer=canvas-2d. */
const kinds: readonly RendererKind[] = ['webgl2', 'canvas-2d'];
const address = new URLSearchParams(location.search);
const space = new BroadPhase();
const figure = new Figure(
  find('view'),
  space,
  kinds.find((kind) => kind === address.get('renderer')),
);
let recording: Promise<LiveScene> | undefined;
let shown = 0;
/** How the number of boxes moves here that the page has chosen; undefined once the visitor has chosen something. */
let greeting: 'unknown' | 'smooth' | 'slow' | undefined = address.has('boxes') ? undefined : 'unknown';
/** When the scene began to move. */
let movingSince = 0;

// The slider is logarithmic; counts are rounded to two digits.

function boxesAt(position: number): number {
  const count = fewest * (most / fewest) ** position;
  const digit = 10 ** (Math.floor(Math.log10(count)) - 1);
  return Math.round(count / digit) * digit;
}

const positionOf = (count: number) => Math.log(count / fewest) / Math.log(most / fewest);

/** The number of boxes on the slider, or fewer if it is too many for the technique. */
function wanted(): number {
  const count = boxesAt(slider.valueAsNumber / Number(slider.max));
  return space.technique === 'brute-force' ? Math.min(count, mostByBruteForce) : count;
}

/** Shows the chosen scene with the chosen technique and number of boxes. */
async function show(): Promise<void> {
  const turn = ++shown;
  space.technique = techniqueMenu.value as TechniqueName;
  const recorded = sceneMenu.value === 'rain';
  let scene: LiveScene;
  if (recorded) {
    note.textContent = 'Loading the recording.';
    recording ??= fetchRecording(rain).then(recordedScene);
    scene = await recording;
    if (turn !== shown) return;
  } else {
    scene = seededScene(sceneMenu.value as SceneName, wanted());
  }
  slider.disabled = recorded;
  slider.style.setProperty('--filled', `${(100 * slider.valueAsNumber) / Number(slider.max)}%`);
  slider.setAttribute('aria-valuetext', `${formatCount(scene.count)} boxes`);
  figure.show(scene);
  if (!figure.loop.playing) {
    // A paused page shows one update: of moved boxes, as all others are, not the first of a scene.
    figure.timings.clear();
    figure.step();
  }
  describe(scene, recorded);
  movingSince = performance.now();
  report();
  remember(scene.count);
}

/** Describes the scene, or why it has fewer boxes than one would expect. */
function describe({ count }: LiveScene, recorded: boolean): void {
  const boxes = `${formatCount(count)} boxes`;
  const reach = `the slider goes to ${formatCount(most)}.`;
  if (!recorded && count < boxesAt(slider.valueAsNumber / Number(slider.max)))
    note.textContent = `Brute force stops here at ${boxes}: that is ${formatCount(possible(count))} tests per frame.`;
  else if (recorded || !greeting || count === greetings[0]) note.textContent = scenes[sceneMenu.selectedIndex][2];
  else if (greeting === 'smooth') note.textContent = `${boxes}, as many as this device moves smoothly; ${reach}`;
  else if (greeting === 'slow') note.textContent = `This device does not move even ${boxes} smoothly; ${reach}`;
  else note.textContent = `${boxes}, because this device does not move ${formatCount(greetings[0])} smoothly; ${reach}`;
}

function remember(count: number): void {
  address.set('scene', sceneMenu.value);
  address.set('technique', techniqueMenu.value);
  if (sceneMenu.value !== 'rain' && !greeting) address.set('boxes', String(count));
  history.replaceState(null, '', `?${address}`);
}

/** Shows fewer boxes if those of the greeting do not run smoothly here. Drawing them is most of the work. */
function greet(): void {
  const { timings, loop, scene } = figure;
  if (greeting !== 'unknown' || !loop.playing || !scene || slider.disabled || performance.now() - movingSince < trial)
    return;
  const can = (scene.count * timings.rate) / smooth;
  const fewer = greetings.filter((count) => count < scene.count);
  if (timings.rate >= smooth || fewer.length === 0) {
    greeting = timings.rate >= smooth ? 'smooth' : 'slow';
    describe(scene, false);
    return;
  }
  slide(fewer.find((count) => count <= can) ?? fewer.at(-1)!);
  void show();
}

const possible = (count: number) => (count * (count - 1)) / 2;

/** Writes the live numbers. */
function report(): void {
  const { scene, timings, groups, loop } = figure;
  if (!scene || !timings.summarise()) return;
  const { stats } = space;
  const share = timings.median / frameBudget;
  write('median', formatMilliseconds(timings.median));
  write('p95', formatMilliseconds(timings.p95));
  write('budget', formatShare(share));
  meter.style.setProperty('--share', Math.min(1, share).toFixed(3));
  write('boxes', formatCount(scene.count));
  write('hero', formatCount(scene.count));
  write('pairs', formatCount(space.pairCount));
  write('touching', formatCount(groups.touching));
  write('tests', formatCount(stats.tests));
  write('share', formatShare(stats.tests / possible(scene.count)));
  write('technique', stats.technique);
  write('rate', loop.playing ? formatRate(timings.rate) : '–');
}

function play(playing: boolean): void {
  figure.loop.playing = playing;
  movingSince = performance.now();
  showPlaying(playing);
  if (playing) figure.timings.clear();
  report();
  caption();
}

/** Describes the picture for people who cannot see it: updated when it stops, not while it runs. */
function caption(): void {
  const { scene } = figure;
  if (!scene) return;
  canvas.setAttribute(
    'aria-label',
    `${formatCount(scene.count)} boxes, ${figure.loop.playing ? 'moving' : 'paused'}, with ${formatCount(space.pairCount)} overlapping pairs. Boxes that touch share a colour.`,
  );
}

function fillMenus(): void {
  for (const [name, label] of scenes) sceneMenu.add(new Option(label, name));
  for (const name of BroadPhase.techniques) techniqueMenu.add(new Option(name, name));
  const scene = address.get('scene');
  sceneMenu.value = scenes.find(([name]) => name === scene)?.[0] ?? 'mixed2d';
  const technique = address.get('technique');
  techniqueMenu.value = BroadPhase.techniques.find((name) => name === technique) ?? 'auto';
  slide(Math.min(most, Math.max(fewest, Number(address.get('boxes')) || greetings[0])));
}

function slide(boxes: number): void {
  slider.value = String(Math.round(positionOf(boxes) * Number(slider.max)));
}

let pending = 0;
/** Shows before the next frame: a slider that is dragged builds at most one scene per frame. */
const showSoon = () => {
  cancelAnimationFrame(pending);
  pending = requestAnimationFrame(() => void show());
};
for (const control of [slider, sceneMenu, techniqueMenu]) {
  control.addEventListener('input', () => {
    greeting = undefined;
    showSoon();
  });
}
find('play').addEventListener('click', () => play(!figure.loop.playing));
find('step').addEventListener('click', () => {
  if (figure.loop.playing) play(false);
  figure.step();
  report();
  caption();
});
for (const [id, act] of [
  ['zoom-in', () => figure.camera.zoom(1.5)],
  ['zoom-out', () => figure.camera.zoom(1 / 1.5)],
  ['fit', () => figure.camera.fit()],
] as const) {
  find(id).addEventListener('click', () => {
    act();
    figure.redraw();
  });
}
addEventListener('keydown', (event) => {
  if (event.key !== ' ' || (event.target as Element).closest('button, select, input')) return;
  event.preventDefault();
  play(!figure.loop.playing);
});
addEventListener('unhandledrejection', ({ reason }) => {
  note.textContent = `This stopped: ${reason instanceof Error ? reason.message : String(reason)}`;
});

const still = matchMedia('(prefers-reduced-motion: reduce)');
still.addEventListener('change', () => play(!still.matches));
setInterval(() => {
  report();
  greet();
}, refresh);
fillMenus();
await show();
// With reduced motion one update stands for all: not one of the first, in which the browser compiles and memory grows.
for (let k = 0; still.matches && k < 5; k++) await show();
play(!still.matches);
