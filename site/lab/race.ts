// The race: the same frames with several techniques, each in its own worker. In each frame they take turns, so that no
// two measure at once. One that takes far too long is dropped without blocking the page. Each has a tile that shows its
// cells over the boxes, and a bar for the median of its last frames.
import type { TechniqueName } from 'broadphase';
import { Camera, type World } from '../shared/camera.ts';
import { density } from '../shared/density.ts';
import { formatCount, formatMilliseconds } from '../shared/format.ts';
import { makePalette } from '../shared/palette.ts';
import { createRenderer } from '../shared/renderer.ts';
import type { Opened, Picture, Source } from './worker/messages.ts';
import { Pilot, TooSlow } from './worker/pilot.ts';

/** Milliseconds that a frame may take in a race. */
const patience = 3000;
/** The median is over this many frames, or fewer at first. */
const kept = 60;
/** More cells than this would be a haze in a tile, so only some are drawn. */
const mostCells = 3000;
const clearCells = 300;
const strongest = 0.6;
const faintest = 0.05;
/** Bars are logarithmic, from a thousandth of the longest on. */
const reach = 1000;

export interface Race {
  /** Runs one frame of all racers that are still in. */
  step(): Promise<void>;
  /** The leader's picture: its numbers are those of the frame. */
  readonly picture: Picture | undefined;
  end(): void;
}

interface Racer {
  technique: TechniqueName;
  pilot: Pilot;
  tile: HTMLElement;
  canvas: HTMLCanvasElement;
  said: HTMLElement;
  bar: HTMLElement;
  barText: HTMLElement;
  times: Float64Array;
  frames: number;
  median: number;
  picture: Picture | undefined;
  /** Why it has dropped out. */
  out: string | undefined;
}

/** Makes a racer, with a tile and a bar that say nothing yet. */
function makeRacer(technique: TechniqueName, tiles: HTMLElement, bars: HTMLElement): Racer {
  const tile = document.createElement('figure');
  tile.className = 'tile';
  tile.innerHTML = '<canvas role="img"></canvas><figcaption><b class="racer"></b><span>–</span></figcaption>';
  tile.querySelector('b')!.textContent = technique;
  tiles.append(tile);
  const item = document.createElement('li');
  item.innerHTML = '<span></span><span>–</span><span class="bar"></span>';
  const [name, barText, bar] = item.children as HTMLCollectionOf<HTMLElement>;
  name.textContent = technique;
  bars.append(item);
  const [canvas, said] = [tile.querySelector('canvas')!, tile.querySelector('span')!];
  canvas.setAttribute('aria-label', `The cells of ${technique}`);
  return {
    technique,
    pilot: new Pilot(patience),
    tile,
    canvas,
    said,
    bar,
    barText,
    times: new Float64Array(kept),
    frames: 0,
    median: 0,
    picture: undefined,
    out: undefined,
  };
}

function drop(racer: Racer, error: unknown): void {
  racer.out = error instanceof TooSlow ? 'given up: too slow' : String((error as Error).message);
  racer.pilot.end();
  racer.tile.classList.add('out');
  racer.picture = undefined;
}

/** Runs one frame of a racer; the first is the one that was opened. */
async function run(racer: Racer, boxes: boolean): Promise<void> {
  const { picture } = racer;
  racer.picture = await racer.pilot.ask('picture', {
    steps: racer.frames === 0 ? 0 : 1,
    boxes,
    structure: true,
    heat: false,
    pairs: false,
    chosen: undefined,
    spare: picture && { drawn: picture.drawn, slots: picture.slots },
  });
  racer.times[racer.frames++ % kept] = racer.picture.ms;
}

/**
 * Opens the scene for every racer, at a frame.
 * @param abandoned aborted when something else is to be shown: then the workers are stopped, and there is no race
 */
export async function createRace(
  places: { tiles: HTMLElement; bars: HTMLElement; note: HTMLElement },
  techniques: readonly TechniqueName[],
  source: Source,
  frame: number,
  abandoned: AbortSignal,
): Promise<Race | undefined> {
  const { tiles, bars, note } = places;
  tiles.replaceChildren();
  bars.replaceChildren();
  const racers = techniques.map((technique) => makeRacer(technique, tiles, bars));
  let ended = false;
  const end = () => {
    ended = true;
    for (const { pilot } of racers) pilot.end();
  };
  abandoned.addEventListener('abort', end);

  let opened: Opened | undefined;
  for (const racer of racers) {
    try {
      const found = await racer.pilot.ask('open', source, frame);
      await racer.pilot.ask('setup', { technique: racer.technique, cellSize: undefined });
      opened ??= found;
    } catch (error) {
      if (ended) return;
      drop(racer, error);
      if (!opened && !(error instanceof TooSlow)) {
        end();
        throw error; // what one cannot open, no other can
      }
    }
  }
  if (!opened) throw new TooSlow('no technique could open the scene in time');

  const pictures = new Pictures(tiles, opened);
  /** The first racer that is still in: only it sends the boxes. */
  let leader: Racer | undefined;
  return {
    get picture() {
      return leader?.picture;
    },
    async step() {
      leader = racers.find(({ out }) => out === undefined);
      for (const racer of racers) {
        if (racer.out !== undefined || ended) continue;
        try {
          await run(racer, racer === leader);
        } catch (error) {
          if (!ended) drop(racer, error);
        }
      }
      if (ended) return;
      pictures.draw(racers, leader?.picture);
      report(racers, note);
    },
    end,
  };
}

/** What the tiles show: the boxes, drawn once for all, and each one's cells. Solid scenes are seen from the front. */
class Pictures {
  readonly #tiles: HTMLElement;
  readonly #dimensions: 2 | 3;
  readonly #backdrop = document.createElement('canvas');
  readonly #renderer = createRenderer(this.#backdrop, () => {}, 'canvas-2d');
  readonly #camera = new Camera();
  readonly #dark = matchMedia('(prefers-color-scheme: dark)');

  constructor(tiles: HTMLElement, { dimensions, world }: Opened) {
    this.#tiles = tiles;
    this.#dimensions = dimensions;
    this.#camera.fit(dimensions === 2 ? (world as World) : [world[0], world[1], world[3], world[4]]);
  }

  /** @param shown the picture that has the boxes */
  draw(racers: readonly Racer[], shown: Picture | undefined): void {
    const style = getComputedStyle(this.#tiles);
    this.#renderer.setPalette(makePalette(this.#dark.matches, style.getPropertyValue('--page').trim()));
    const side = Math.round((this.#tiles.firstElementChild?.clientWidth ?? 200) * density());
    const [backdrop, camera] = [this.#backdrop, this.#camera];
    if (backdrop.width !== side || backdrop.height !== side) {
      backdrop.width = backdrop.height = side;
      camera.resize(side, side);
    }
    if (!shown) return;
    const { drawn, slots, cells, boxes } = shown;
    const flat = this.#dimensions === 2 ? drawn : flattened(drawn, cells + boxes);
    this.#renderer.draw(flat.subarray(4 * cells), slots.subarray(cells), boxes, camera);
    const accent = style.getPropertyValue('--accent').trim();
    for (const { canvas, picture } of racers) {
      if (canvas.width !== side || canvas.height !== side) canvas.width = canvas.height = side;
      const ctx = canvas.getContext('2d')!;
      ctx.globalAlpha = 1;
      ctx.drawImage(backdrop, 0, 0);
      if (picture) drawCells(ctx, picture, this.#dimensions, camera, accent);
    }
  }
}

/** Writes the medians, the bars in the order of the racers, and whether all agree. */
function report(racers: readonly Racer[], note: HTMLElement): void {
  for (const racer of racers) {
    const some = racer.times.subarray(0, Math.min(kept, racer.frames)).slice().sort();
    racer.median = some[some.length >> 1] ?? 0;
  }
  const running = racers.filter(({ out, frames }) => out === undefined && frames > 0);
  const fastest = Math.min(...running.map(({ median }) => median));
  const slowest = Math.max(...running.map(({ median }) => median));
  const order = [...racers].sort((a, b) => Number(!!a.out) - Number(!!b.out) || a.median - b.median);
  for (const racer of racers) {
    const { technique, picture, out, said, bar, barText, median } = racer;
    const ran = picture && picture.stats.technique !== technique ? ` (${picture.stats.technique})` : '';
    const text = out ?? `${formatMilliseconds(median)} ms`;
    said.textContent = text + (out ? '' : ran);
    barText.textContent = out ?? `${text}, ${fastest > 0 ? (median / fastest).toFixed(1) : '1.0'}×`;
    const share = out || median <= 0 ? 0 : 1 + Math.log(median / slowest) / Math.log(reach);
    bar.style.setProperty('--share', Math.max(0.02, share).toFixed(3));
    const item = bar.parentElement!;
    item.style.order = String(order.indexOf(racer));
    item.classList.toggle('first', racer === order[0] && !out);
  }
  const digests = new Set(running.map(({ picture }) => picture?.digest));
  const measured = Math.min(kept, ...running.map(({ frames }) => frames));
  const pairs = running[0]?.picture?.stats.pairs ?? 0;
  note.textContent =
    digests.size > 1
      ? 'They disagree on the pairs: that is a bug in the library. Please report it.'
      : `Median of ${measured} ${measured === 1 ? 'frame' : 'frames'}, on a logarithmic scale. They take turns, and all find the same ${formatCount(pairs)} pairs.`;
}

function flattened(boxes: Float32Array, count: number): Float32Array {
  const flat = new Float32Array(4 * count);
  for (let k = 0; k < count; k++) {
    flat[4 * k] = boxes[6 * k];
    flat[4 * k + 1] = boxes[6 * k + 1];
    flat[4 * k + 2] = boxes[6 * k + 3];
    flat[4 * k + 3] = boxes[6 * k + 4];
  }
  return flat;
}

function drawCells(
  ctx: CanvasRenderingContext2D,
  { drawn, cells }: Picture,
  dimensions: 2 | 3,
  { x, y, scale, width, height }: Camera,
  color: string,
): void {
  const stride = Math.ceil(cells / mostCells) * 2 * dimensions;
  const clamp = (value: number, most: number) => Math.min(most + 9, Math.max(-9, value));
  ctx.strokeStyle = color;
  // Many cells are drawn faintly, so that the boxes show through.
  ctx.globalAlpha = Math.min(strongest, Math.max(faintest, (strongest * clearCells) / cells));
  ctx.lineWidth = 1;
  ctx.beginPath();
  for (let at = 0; at < cells * 2 * dimensions; at += stride) {
    const left = clamp(width / 2 + (drawn[at] - x) * scale, width);
    const right = clamp(width / 2 + (drawn[at + dimensions] - x) * scale, width);
    const bottom = clamp(height / 2 - (drawn[at + 1] - y) * scale, height);
    const top = clamp(height / 2 - (drawn[at + dimensions + 1] - y) * scale, height);
    ctx.rect(left, top, right - left, bottom - top);
  }
  ctx.stroke();
}
