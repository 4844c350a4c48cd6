// What runs in a worker of the lab: one scene, and one space that finds its pairs. Each frame moves the scene by one
// step, finds the pairs (this alone is timed), colours them, and packs arrays to draw. It knows nothing about
// messages or pages.
import { BroadPhase, type BroadPhaseOptions, findPairsBetween, type Stats } from 'broadphase';
import { type Frame, TraceWriter } from 'broadphase/trace';
import type { SceneName } from '../../../src/scenes/index.ts';
import { joined } from '../../../src/trace/bytes.ts';
import { pairsDigest } from '../../../src/trace/compare.ts';
import { begin, timeUpdate } from '../../../src/trace/replay.ts';
import { typicalSide, usesParameter } from '../../../src/trace/tune.ts';
import { cellSlot, chosenSlot, Groups, heatSlot, heats, partnerSlot } from '../../shared/groups.ts';
import { heapSize } from '../../shared/heap.ts';
import { type Feed, generate, play } from './feed.ts';
import type { CellSizes, Chosen, Cost, HotCell, Opened, Picture, Requests, Setup, Source, Wanted } from './messages.ts';

/** The most cells and pairs drawn: more cells would be a haze, and more pairs a tangle. */
const mostCells = 300_000;
const mostLines = 20_000;
/** Intervals of one axis reach across the whole view: all of them would hide it, and take most of a frame to draw. */
const mostIntervals = 40;
const partnersListed = 24;
const hottestListed = 3;
/** Milliseconds between two searches for hot cells: each takes time of its own. */
const heatEvery = 250;
/** A recording ends when it has this many bytes. */
const mostRecorded = 2 ** 28;
const costPasses = 3;

export class Engine implements Record<keyof Requests, unknown> {
  #feed: Feed | undefined;
  #space: BroadPhase<2 | 3> = new BroadPhase();
  #setup: Setup = { technique: 'auto', cellSize: undefined };
  /** Whether the pairs are not those of the current frame. */
  #stale = true;
  #fresh = true;
  /** The previous frame, once there is one. */
  #before: Frame | undefined;
  readonly #groups = new Groups();
  readonly #places = new Places();
  #heat = new Uint8Array();
  #hottest: HotCell[] = [];
  #heatAt = -Infinity;
  #recording: { writer: TraceWriter; pieces: Uint8Array[]; bytes: number; full: boolean } | undefined;

  /** @throws TraceError if a file is broken: the previous scene stays */
  async open(source: Source, frame: number): Promise<Opened> {
    const feed = await openSource(source, frame);
    this.#use(this.#makeSpace(this.#setup, feed));
    this.#feed = feed;
    this.#recording = this.#before = undefined;
    const { dimensions, world, frames } = feed;
    return { dimensions, world, frames, boxes: feed.frame.count };
  }

  /** @throws RangeError if no space can be made like that: the previous one stays */
  setup(setup: Setup): void {
    this.#use(this.#makeSpace(setup));
    this.#setup = setup;
  }

  picture(wanted: Wanted): Picture {
    const feed = this.#need();
    const begun = performance.now();
    for (let k = 0; k < wanted.steps; k++) {
      this.#keep(feed);
      feed.step();
      this.#stale = true;
      this.#record();
    }
    const stepped = performance.now();
    const ms = this.#stale ? this.#solve(feed) : Number.NaN;
    const space = this.#space;
    const { frame } = feed;
    const pairs = this.#places.ofPairs(frame.ids, space.pairs);
    if (wanted.boxes) this.#groups.update(pairs, space.pairCount, frame.count);
    const chosen = wanted.chosen === undefined ? undefined : this.#look(feed, wanted.chosen);

    const width = 2 * feed.dimensions;
    const all = wanted.structure || wanted.heat || chosen ? space.structure() : none;
    if (wanted.heat && begun - this.#heatAt > heatEvery) {
      this.#findHeat(feed, all);
      this.#heatAt = begun;
    }
    const { drawn, slots, cells } = this.#draw(wanted, feed, all, chosen);
    if (chosen) this.#mark(frame.ids, chosen, slots.subarray(cells));
    return {
      index: feed.index,
      boxes: frame.count,
      ms,
      stepMs: stepped - begun,
      otherMs: performance.now() - stepped - (ms || 0),
      stats: { ...space.stats } as Stats,
      digest: pairsDigest(space.pairs),
      touching: this.#groups.touching,
      cells,
      drawn,
      slots,
      lines: wanted.pairs ? linesOf(pairs, frame.boxes, width) : undefined,
      chosen,
      hottest: wanted.heat ? this.#hottest : [],
      heap: heapSize(),
      recorded: this.#recording && {
        frames: this.#recording.writer.frames,
        bytes: this.#recording.bytes,
        full: this.#recording.full,
      },
    };
  }

  pick(place: readonly number[], reach: number): number | undefined {
    const feed = this.#need();
    if (this.#stale) this.#solve(feed);
    const space = this.#space;
    if (feed.dimensions === 3) {
      const [x, y, z, dx, dy, dz] = place;
      return space.rayCast(x, y, z, dx, dy, dz)?.id;
    }
    const [x, y] = place;
    // The smallest of several boxes on top of each other, since it could not be clicked otherwise.
    let best: number | undefined;
    let smallest = Infinity;
    space.queryPoint(x, y, {
      visit(id) {
        const [minX, minY, maxX, maxY] = space.get(id)!;
        const size = (maxX - minX) * (maxY - minY);
        if (size < smallest || best === undefined) [best, smallest] = [id, size];
      },
    });
    return best ?? space.nearest(x, y, 1, { maxDistance: reach })[0];
  }

  cellSizes(): CellSizes {
    const { frame, dimensions } = this.#need();
    const heeded =
      frame.count > 0 && usesParameter({ technique: this.#setup.technique }, 'cellSize', dimensions, [frame]);
    return { heeded, typical: frame.count > 0 ? typicalSide(frame, dimensions) : 1 };
  }

  cost(cellSize: number): Cost {
    const { frame } = this.#need();
    const space = this.#makeSpace({ ...this.#setup, cellSize });
    let ms = Infinity;
    for (let pass = 0; pass < costPasses; pass++) {
      if (this.#before) timeUpdate(space, this.#before);
      else begin(space, frame, pass === 0);
      ms = Math.min(ms, timeUpdate(space, frame));
    }
    const { tests } = space.stats;
    space.dispose();
    return { cellSize, ms, tests };
  }

  record(): void {
    const writer = new TraceWriter(this.#need().dimensions);
    this.#recording = { writer, pieces: [writer.header()], bytes: 0, full: false };
    this.#record();
  }

  recording(): Uint8Array<ArrayBuffer> {
    if (!this.#recording) throw new Error('nothing is being recorded');
    const { writer, pieces } = this.#recording;
    this.#recording = undefined;
    return joined([...pieces, writer.end()]);
  }

  #need(): Feed {
    if (!this.#feed) throw new Error('no scene is open');
    return this.#feed;
  }

  #use(space: BroadPhase<2 | 3>): void {
    this.#space.dispose();
    this.#space = space;
    this.#stale = this.#fresh = true;
    this.#heatAt = -Infinity;
  }

  #makeSpace({ technique, cellSize }: Setup, feed = this.#feed): BroadPhase<2 | 3> {
    const { dimensions = 2, frame } = feed ?? {};
    const options = { dimensions, technique, cellSize, wrap: frame?.wrap, touching: frame?.touching };
    return new BroadPhase(options as BroadPhaseOptions<2 | 3>); // undefined options count as missing
  }

  /** Keeps the current frame as the previous one of the next: in the same array, if it fits. */
  #keep({ frame }: Feed): void {
    const { boxes, ids, rules } = frame;
    const room = this.#before?.boxes;
    const same = room?.length === boxes.length && room.constructor === boxes.constructor;
    const kept = same ? room : boxes.slice();
    if (same) kept.set(boxes);
    this.#before = { ...frame, boxes: kept, ids: ids?.slice(), rules: rules?.slice() };
  }

  #solve({ frame }: Feed): number {
    if (this.#fresh) begin(this.#space, frame, true);
    const ms = timeUpdate(this.#space, frame);
    this.#stale = this.#fresh = false;
    return ms;
  }

  #record(): void {
    const recording = this.#recording;
    if (!recording || recording.full) return;
    const { frame } = this.#need();
    const piece = recording.writer.frame(frame.boxes, frame.ids, frame.rules, frame);
    recording.pieces.push(piece);
    recording.bytes += piece.length;
    recording.full = recording.bytes > mostRecorded;
  }

  #look({ frame, dimensions }: Feed, id: number): Chosen | undefined {
    const place = this.#places.of(frame.ids, id, frame.count);
    if (place === undefined) return undefined;
    const width = 2 * dimensions;
    const partners = this.#space.collisionsOf(id);
    return {
      id,
      box: Array.from(frame.boxes.subarray(place * width, (place + 1) * width)),
      partnerCount: partners.length,
      partners,
      cells: 0,
    };
  }

  /** Colours a chosen box and its partners, and keeps as many of these as are listed. */
  #mark(ids: Uint32Array | undefined, chosen: Chosen, slots: Uint8Array): void {
    if (slots.length > 0) {
      for (const id of chosen.partners) slots[this.#places.of(ids, id, slots.length)!] = partnerSlot;
      slots[this.#places.of(ids, chosen.id, slots.length)!] = chosenSlot;
    }
    chosen.partners.length = Math.min(partnersListed, chosen.partners.length);
  }

  /** Cells, then boxes, with their colours. */
  #draw(wanted: Wanted, { frame, dimensions }: Feed, all: Float32Array, chosen: Chosen | undefined) {
    const width = 2 * dimensions;
    const there = Math.min(mostCells, all.length / width);
    // The intervals are in order, so those that are drawn are spread over all boxes.
    const every = this.#space.stats.technique === 'sweep-and-prune' ? Math.ceil(there / mostIntervals) : 1;
    const { spare } = wanted;
    const count = wanted.boxes ? frame.count : 0;
    const room = there + count;
    const enough = spare && spare.drawn.length >= room * width && spare.slots.length >= room;
    const drawn = enough ? spare.drawn : new Float32Array(Math.ceil(1.25 * room) * width);
    const slots = enough ? spare.slots : new Uint8Array(Math.ceil(1.25 * room));
    let cells = 0;
    for (let cell = 0; cell < there; cell++) {
      const from = cell * width;
      const holds = chosen !== undefined && overlap(all, from, chosen.box, dimensions);
      if (holds) chosen.cells++;
      const heat = wanted.heat ? this.#heat[cell] : 0;
      if (!(((wanted.structure || heat > 0) && cell % every === 0) || holds)) continue;
      slots[cells] = holds ? partnerSlot : heat > 0 ? heatSlot + heat - 1 : cellSlot;
      for (let k = 0; k < width; k++) drawn[cells * width + k] = all[from + k];
      cells++;
    }
    if (count > 0) {
      drawn.set(frame.boxes, cells * width);
      slots.set(this.#groups.slots.subarray(0, count), cells);
    }
    return { drawn, slots, cells };
  }

  /**
   * Counts the boxes in each cell. A box counts in the smallest cell that contains its lower corner, so that the nested
   * nodes of a tree are not all as hot as what is in them.
   */
  #findHeat({ frame, dimensions }: Feed, cells: Float32Array): void {
    const width = 2 * dimensions;
    const count = cells.length / width;
    const corners = new Float32Array(frame.count * width);
    for (let at = 0; at < corners.length; at++) corners[at] = frame.boxes[at - ((at / dimensions) & 1) * dimensions];
    const sizes = new Float64Array(count).fill(1);
    for (let cell = 0; cell < count; cell++) {
      for (let k = cell * width; k < cell * width + dimensions; k++) sizes[cell] *= cells[k + dimensions] - cells[k];
    }
    const home = new Int32Array(frame.count).fill(-1);
    const meetings = findPairsBetween(cells, corners, { dimensions });
    for (let k = 0; k < meetings.length; k += 2) {
      const [cell, box] = [meetings[k], meetings[k + 1]];
      if (home[box] < 0 || sizes[cell] < sizes[home[box]]) home[box] = cell;
    }
    const held = new Uint32Array(count);
    for (const cell of home) if (cell >= 0) held[cell]++;
    const order = Array.from(held.keys()).filter((cell) => held[cell] > 1);
    order.sort((a, b) => held[b] - held[a]);
    const most = held[order[0]] ?? 0;
    // Cells with less than half as many boxes as the hottest are not coloured.
    this.#heat = Uint8Array.from(held, (boxes) =>
      boxes > 1 ? Math.max(0, Math.ceil((heats * (2 * boxes - most)) / most)) : 0,
    );
    this.#hottest = order.slice(0, hottestListed).map((cell) => ({
      boxes: held[cell],
      box: Array.from(cells.subarray(cell * width, (cell + 1) * width)),
    }));
  }
}

const none = new Float32Array();

async function openSource(source: Source, frame: number): Promise<Feed> {
  if (source.kind === 'scene') return generate(source.name as SceneName, source.boxes, frame);
  if (source.kind === 'file') return play(new Uint8Array(await source.file.arrayBuffer()), frame);
  const response = await fetch(source.url);
  if (!response.ok) throw new Error(`${source.url}: ${response.status} ${response.statusText}`);
  return play(new Uint8Array(await response.arrayBuffer()), frame);
}

/** The places of boxes with ids of their own in their frame. */
class Places {
  #ids: Uint32Array | undefined;
  #at = new Map<number, number>();
  #pairs = new Uint32Array();

  of(ids: Uint32Array | undefined, id: number, count: number): number | undefined {
    if (!ids) return id < count ? id : undefined;
    this.#learn(ids);
    return this.#at.get(id);
  }

  /** Converts pairs of ids to pairs of places. */
  ofPairs(ids: Uint32Array | undefined, pairs: Uint32Array): Uint32Array {
    if (!ids) return pairs;
    this.#learn(ids);
    if (this.#pairs.length < pairs.length) this.#pairs = new Uint32Array(pairs.length);
    for (let k = 0; k < pairs.length; k++) this.#pairs[k] = this.#at.get(pairs[k])!;
    return this.#pairs.subarray(0, pairs.length);
  }

  #learn(ids: Uint32Array): void {
    const known = this.#ids;
    if (known && known.length === ids.length && known.every((id, place) => id === ids[place])) return;
    this.#ids = ids.slice();
    this.#at = new Map(Array.from(ids, (id, place) => [id, place]));
  }
}

function overlap(cells: Float32Array, at: number, box: readonly number[], dimensions: number): boolean {
  for (let axis = 0; axis < dimensions; axis++) {
    if (cells[at + axis] > box[dimensions + axis] || cells[at + dimensions + axis] < box[axis]) return false;
  }
  return true;
}

function linesOf(pairs: Uint32Array, boxes: ArrayLike<number>, width: number): Float32Array<ArrayBuffer> {
  const dimensions = width / 2;
  const ends = Math.min(pairs.length, 2 * mostLines);
  const lines = new Float32Array(ends * dimensions);
  for (let k = 0; k < ends; k++) {
    for (let axis = 0; axis < dimensions; axis++) {
      const at = pairs[k] * width + axis;
      const middle = (boxes[at] + boxes[at + dimensions]) / 2;
      lines[k * dimensions + axis] = Number.isFinite(middle) ? middle : 0;
    }
  }
  return lines;
}
