// The lab: a scene, a technique, and what it costs. This file connects the parts; workers do the work.
// The state is in the URL, so that it can be sent to someone.
import type { TechniqueName } from 'broadphase';
import { find, showPlaying } from '../shared/elements.ts';
import { formatCount, formatMilliseconds, formatRate } from '../shared/format.ts';
import { numberPanel } from '../shared/numbers.ts';
import type { RendererKind } from '../shared/renderer.ts';
import { Timings } from '../shared/timings.ts';
import { Address } from './address.ts';
import { isTrace, mostBoxes, traces } from './catalog.ts';
import { takeFiles } from './files.ts';
import { createCellSize } from './panels/cell-size.ts';
import { createCharts } from './panels/charts.ts';
import {
  arrange,
  fillControls,
  layersChosen,
  racersChosen,
  rateMenu,
  sceneMenu,
  techniqueMenu,
} from './panels/controls.ts';
import { createCountSlider } from './panels/count-slider.ts';
import { createInspector } from './panels/inspector.ts';
import { describeParts } from './panels/parts.ts';
import { Playback } from './panels/playback.ts';
import { createRecorder } from './panels/recorder.ts';
import { createRace, type Race } from './race.ts';
import { defaults, type LabState, type Layer, latestFrame, type Rate, readState, writeState } from './state.ts';
import { type LabView, onClick } from './views/view.ts';
import { createFlatView } from './views/view-2d.ts';
import type { Opened, Picture, Requests, Source, Wanted } from './worker/messages.ts';
import { Pilot, TooSlow } from './worker/pilot.ts';

/** Milliseconds that a worker may take to answer. */
const patience = 10_000;
/** Brute force tests every pair of boxes: with more boxes a frame would take seconds. */
const mostByBruteForce = 20_000;
/** Limited, because every racer has all boxes in its own memory. */
const mostInRace = 100_000;
const refresh = 200;
const file = 'file';

const note = find('note');
const write = numberPanel(document);
const still = matchMedia('(prefers-reduced-motion: reduce)');

const { state: given, faults } = readState(location.search);
const state: LabState = given;
let source: Source;
let opened: Opened | undefined;
/** The file that is shown, if it is the user's own. */
let ownFile: File | undefined;
let view: LabView;
let picture: Picture | undefined;
let race: Race | undefined;

const pilot = new Pilot(patience);
const playback = new Playback(makeFrame);
const timings = new Timings();
const charts = createCharts(find('charts'));
const recorder = createRecorder({
  begin: () => ask('record'),
  bytes: () => ask('recording'),
  name: () => (ownFile ? 'recording' : state.scene),
  failed: (error) => say(`The recording stopped: ${reasonOf(error)}`, true),
});
const inspect = createInspector(find('chosen'), choose);
const slider = createCountSlider(find('count'), state.boxes, (count) => {
  state.boxes = count;
  openSoon();
});
const cellSize = createCellSize(find('cells'), setCell, (cell) => ask('cost', cell));
/** For comparison, the renderer of flat scenes can be chosen in the URL: ?renderer=canvas-2d. */
const kinds: readonly RendererKind[] = ['webgl2', 'canvas-2d'];
const wantedKind = new URLSearchParams(location.search).get('renderer');
const chosenKind = kinds.find((kind) => kind === wantedKind);
const flat = createFlatView(find('flat'), () => remember(), chosenKind);
view = flat;
let solid: Promise<LabView> | undefined;

/** Shows a message; an error more prominently. */
function say(text: string, bad = false): void {
  note.textContent = text;
  note.classList.toggle('bad', bad);
}

const reasonOf = (error: unknown) => (error instanceof Error ? error.message : String(error));

/** Asks the worker. If it had to be stopped, opens the same scene again, with the technique that never fails. */
async function ask<Name extends keyof Requests>(
  name: Name,
  ...args: Parameters<Requests[Name]>
): Promise<ReturnType<Requests[Name]>> {
  try {
    return await pilot.ask(name, ...args);
  } catch (error) {
    if (error instanceof TooSlow && name !== 'open') void revive(error);
    throw error;
  }
}

let reviving = false;
async function revive({ message }: TooSlow): Promise<void> {
  if (reviving) return;
  reviving = true;
  const what = state.cell === undefined ? state.technique : `${state.technique} with cells of ${state.cell}`;
  play(false);
  state.technique = 'auto';
  state.cell = undefined;
  techniqueMenu.value = 'auto';
  try {
    await open(0);
    say(`${what} was stopped: ${message}. The same boxes now run with auto.`, true);
  } finally {
    reviving = false;
  }
}

/** Makes and shows a frame: of the race, or of the scene. */
async function makeFrame(steps: number): Promise<void> {
  try {
    if (race) {
      await race.step();
      if (race?.picture) take(race.picture);
    } else if (opened && !state.race) {
      take(await ask('picture', wanted(steps)));
      view.show(picture!);
    }
  } catch (error) {
    if (error instanceof TooSlow) return; // already reported
    play(false);
    say(`This stopped: ${reasonOf(error)}`, true);
  }
}

/** The picture before the last, whose arrays can be reused. */
let spare: Wanted['spare'];

function wanted(steps: number): Wanted {
  const has = (layer: Layer) => state.show.includes(layer);
  const given = spare;
  spare = undefined;
  return {
    steps,
    boxes: true,
    structure: has('structure'),
    heat: has('heat'),
    pairs: has('pairs'),
    chosen: state.box,
    spare: given,
  };
}

function take(next: Picture): void {
  if (picture && !race && picture !== next) spare = { drawn: picture.drawn, slots: picture.slots };
  picture = next;
  if (Number.isNaN(next.ms)) return;
  timings.add(performance.now(), next.ms);
  charts.add(next);
}

// Opening: a scene, a trace, a file; the race opens its own.

const boxesWanted = () => {
  const most = race || state.race ? mostInRace : state.technique === 'brute-force' ? mostByBruteForce : mostBoxes;
  return Math.min(most, state.boxes);
};

function sourceOf(): Source {
  if (ownFile) return { kind: 'file', file: ownFile };
  if (isTrace(state.scene)) {
    return { kind: 'trace', url: new URL(traces[state.scene].url, location.href).href };
  }
  return { kind: 'scene', name: state.scene, boxes: boxesWanted() };
}

let opening = new AbortController();
/** Opens what is chosen, at a frame; cancels what was being opened. */
async function open(frame: number, look?: readonly number[]): Promise<void> {
  opening.abort();
  opening = new AbortController();
  const { signal } = opening;
  try {
    await openAt(frame, look, signal);
  } catch (error) {
    if (!signal.aborted) throw error;
  }
}

async function openAt(frame: number, look: readonly number[] | undefined, signal: AbortSignal): Promise<void> {
  source = sourceOf();
  if (race) {
    race.end();
    picture = spare = undefined; // its arrays may be on the way to a racer, and cannot be sent twice
  }
  race = undefined;
  // The worker forgets it when it opens something; not by ask(), which would open again if that takes too long.
  await recorder.end('Something else was opened. ', () => pilot.ask('recording'));
  signal.throwIfAborted();
  if (source.kind !== 'scene') say('Loading the recording.');
  else if (frame > 0) say(`Making the frames before frame ${formatCount(frame)}.`);
  const now = await pilot.ask('open', source, frame);
  signal.throwIfAborted();
  opened = now;
  await pilot.ask('setup', { technique: state.technique, cellSize: state.cell });
  await useView(now.dimensions);
  signal.throwIfAborted();
  view.fit(now.world);
  if (look) view.look = look;
  picture = spare = undefined;
  timings.clear();
  charts.clear();
  explain();
  if (state.race) await startRace(frame, signal);
  await playback.show(0);
  signal.throwIfAborted();
  lookAtCells();
  report();
  caption();
  remember();
}

/** Opens something else; if that fails, the old scene stays. */
async function change(next: { scene: string; own?: File }): Promise<void> {
  const before = { scene: state.scene, own: ownFile, opened };
  state.scene = next.scene;
  ownFile = next.own;
  state.box = undefined;
  const was = before.own ? file : before.scene;
  const rate = state.rate;
  if (isTrace(next.scene) || next.own) setRate('10');
  else if (isTrace(before.scene) || before.own) setRate(defaults.rate);
  try {
    await open(0);
    showFileInMenu();
    sceneMenu.value = ownFile ? file : state.scene;
  } catch (error) {
    state.scene = before.scene;
    ownFile = before.own;
    setRate(rate);
    sceneMenu.value = was;
    // Its worker may be gone, or may have a scene that cannot be shown.
    if (error instanceof TooSlow || opened !== before.opened) await open(0);
    const name = next.own ? next.own.name : next.scene;
    say(`${name} cannot be shown: ${reasonOf(error)}`, true);
  }
}

async function useView(dimensions: 2 | 3): Promise<void> {
  if (dimensions === 3) {
    // three.js is fetched only for a solid scene.
    solid ??= import('./views/view-3d.ts').then(({ createSolidView }) => {
      find('solid').hidden = false;
      const made = createSolidView(find('solid'), () => remember());
      listen(made);
      return made;
    });
    solid.catch(() => {
      solid = undefined; // so that it can be tried again: the network may be back
      find('solid').hidden = true;
    });
  }
  view = dimensions === 3 ? await solid! : flat;
  arrange(state.race?.length, view.element.id);
}

async function startRace(frame: number, signal: AbortSignal): Promise<void> {
  const places = { tiles: find('race'), bars: find('bars'), note: find('race-note') };
  if (state.race!.length === 0) {
    for (const place of Object.values(places)) place.replaceChildren(); // those of the race before
    write('frame', '–');
    return say('Choose who races.');
  }
  const made = await createRace(places, state.race!, source, frame, signal);
  signal.throwIfAborted();
  race = made;
}

async function lookAtCells(): Promise<void> {
  if (state.race) return;
  const { signal } = opening;
  const sizes = await ask('cellSizes').catch(() => undefined);
  if (sizes && !signal.aborted && !state.race) cellSize.begin(sizes, state.cell);
}

/** Explains what is shown if it is not what was chosen. */
function explain(): void {
  const asked = isTrace(state.scene) || ownFile ? 0 : state.boxes;
  const fewer = opened!.boxes < asked;
  slider.show(opened!.boxes, asked > 0);
  write('boxes', formatCount(opened!.boxes));
  if (fewer && state.race)
    say(`A race stops at ${formatCount(opened!.boxes)} boxes: every racer keeps its own copy of them.`);
  else if (fewer) say(`Brute force stops here at ${formatCount(opened!.boxes)} boxes.`);
  else if (opened!.frames)
    say(`${ownFile?.name ?? traces[state.scene].label}: ${formatCount(opened!.frames)} frames, again and again.`);
  else say('');
}

// Controls.

function setRate(rate: Rate): void {
  state.rate = rate;
  playback.rate = Number(rate);
  rateMenu.value = rate;
}

function setCell(cell: number | undefined): void {
  state.cell = cell;
  void setUp();
}

/** Another technique or cell size for the same scene. */
async function setUp(): Promise<void> {
  if (opened && boxesWanted() !== opened.boxes && source.kind === 'scene') return open(0);
  await ask('setup', { technique: state.technique, cellSize: state.cell }).catch(() => {});
  timings.clear();
  charts.clear();
  await playback.show(0);
  report();
  remember();
}

function choose(id: number | undefined): void {
  state.box = id;
  const hides = id === undefined && find('chosen').contains(document.activeElement);
  if (hides) view.element.focus({ preventScroll: true }); // the focus would be lost with the button that was pressed
  void playback.show(0).then(report);
  remember();
}

function showFileInMenu(): void {
  sceneMenu.querySelector(`option[value=${file}]`)?.remove();
  if (ownFile) sceneMenu.add(new Option(ownFile.name, file), 0);
}

const address = new Address(() => {
  const query = writeState({
    ...state,
    scene: ownFile ? file : state.scene,
    frame: playback.playing ? undefined : picture?.index,
    view: state.race ? undefined : view.look,
  });
  return chosenKind ? `${query}&renderer=${chosenKind}` : query;
});
const remember = () => address.writeSoon();

/** Writes the live numbers. */
function report(): void {
  if (!picture) return;
  const { stats, touching, boxes, recorded } = picture;
  write('boxes', formatCount(boxes));
  write('frame', formatCount(picture.index) + (opened?.frames ? ` / ${formatCount(opened.frames - 1)}` : ''));
  write('technique', stats.technique);
  write('ran', !race && stats.technique !== state.technique ? stats.technique : '');
  write('pairs', formatCount(stats.pairs));
  write('touching', formatCount(touching));
  write('tests', formatCount(stats.tests));
  write('cells', formatCount(stats.cells));
  const drawn = state.show.includes('structure');
  const tooSmall = drawn && !race && view.cellsTooSmall;
  write('parts', describeParts(stats.technique, stats.cells, drawn ? picture.cells : stats.cells, tooSmall));
  if (timings.summarise()) {
    write('median', formatMilliseconds(timings.median));
    write('rate', playback.playing ? formatRate(timings.rate) : '–');
  }
  if (!race) {
    inspect(picture, state.box);
    charts.draw();
  }
  recorder.show(recorded);
}

function play(playing: boolean): void {
  playback.playing = playing;
  showPlaying(playing);
  if (playing) timings.clear();
  report();
  caption();
  remember();
}

/** Describes the picture for people who cannot see it: updated when it stops, not while it runs. */
function caption(): void {
  if (!picture) return;
  view.element
    .querySelector('canvas')!
    .setAttribute(
      'aria-label',
      `${formatCount(picture.boxes)} boxes, ${playback.playing ? 'moving' : 'paused'}, with ${formatCount(picture.stats.pairs)} overlapping pairs. Boxes that touch share a colour.`,
    );
}

async function share(): Promise<void> {
  const held = ownFile ? ' It does not hold your file.' : '';
  try {
    await navigator.clipboard.writeText(address.write());
    say(`Link copied.${held}`);
  } catch {
    say(`The address of this page is the link: copy it from the address bar.${held}`);
  }
}

function listen({ element }: LabView): void {
  onClick(element, async (x, y) => {
    const { place, reach } = view.place(x, y);
    const id = await ask('pick', place, reach).catch(() => undefined);
    choose(id);
  });
}

let pending = 0;
/** Opens before the next frame: a slider that is dragged makes at most one scene per frame. */
const openSoon = () => {
  cancelAnimationFrame(pending);
  pending = requestAnimationFrame(() => void open(0).catch(failed));
};
const failed = (reason: unknown) => say(`This stopped: ${reasonOf(reason)}`, true);

/** If the scene of the address cannot be shown, the first of the menu is. */
async function openFirst(reason: unknown): Promise<void> {
  if (state.scene === defaults.scene) return failed(reason);
  const wanted = state.scene;
  await change({ scene: defaults.scene });
  say(`${wanted} cannot be shown: ${reasonOf(reason)}`, true);
}

sceneMenu.addEventListener('change', () => {
  if (sceneMenu.value !== file) void change({ scene: sceneMenu.value });
});
techniqueMenu.addEventListener('change', () => {
  state.technique = techniqueMenu.value as TechniqueName;
  state.cell = undefined;
  void setUp().then(() => {
    explain();
    lookAtCells();
  });
});
rateMenu.addEventListener('change', () => {
  setRate(rateMenu.value as Rate);
  remember();
});
find('layers').addEventListener('change', () => {
  state.show = layersChosen();
  void playback.show(0).then(report);
  remember();
});
find('race-mode').addEventListener('click', () => {
  state.race = state.race ? undefined : racersChosen();
  openSoon();
});
find('racer-list').addEventListener('change', () => {
  state.race = racersChosen();
  openSoon();
});
find('play').addEventListener('click', () => play(!playback.playing));
find('step').addEventListener('click', async () => {
  if (playback.playing) play(false);
  await playback.show(1);
  report();
  caption();
  remember();
});
for (const [id, factor] of [
  ['zoom-in', 1.5],
  ['zoom-out', 1 / 1.5],
] as const) {
  find(id).addEventListener('click', () => view.zoom(factor));
}
find('fit').addEventListener('click', () => {
  view.look = undefined;
  remember();
});
find('share').addEventListener('click', () => void share());
find('controls').addEventListener('submit', (event) => event.preventDefault());
takeFiles(find('choose'), find<HTMLInputElement>('file'), (chosen) => void change({ scene: state.scene, own: chosen }));
addEventListener('keydown', (event) => {
  if (event.key !== ' ' || (event.target as Element).closest('button, select, input, label')) return;
  event.preventDefault();
  find('play').click(); // unless there is nothing to play
});
// Without an error it is only a notice, such as that elements were resized twice in a frame.
addEventListener('error', (event) => event.error && failed(event.error));
addEventListener('unhandledrejection', (event) => failed(event.reason));
still.addEventListener('change', () => play(!still.matches));

listen(flat);
fillControls(state);
setRate(state.rate);
setInterval(report, refresh);
const beginning = Math.min(state.frame ?? 0, latestFrame(state.boxes));
await open(beginning, state.view).catch(openFirst);
if (faults.length > 0) say(`In the address, ${faults.join('; ')}.`, true);
if (!reviving) play(!still.matches && state.frame === undefined);
