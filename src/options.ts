// The options of a space: their types, their checks, and how they reach the kernel.
import type { Dimensions } from './dimensions.ts';
import {
  badNumber,
  badValue,
  checkBoolean,
  checkBoxCount,
  checkOptions,
  checkWrap,
  isFinitePositive,
} from './errors.ts';
import type { Technique as LeanTechnique } from './generated/kernel-lean.ts';
import { KernelInstance } from './kernel/instance.ts';
import { builtDimensions } from './kernel/load.ts';
import { checkTechnique, isBuilt, type TechniqueName } from './techniques.ts';

/** The type of an option that only `broadphase/all` takes: elsewhere it has no value. */
type OfAll<Technique extends TechniqueName, Value> = (Record<LeanTechnique, never> &
  Record<Exclude<TechniqueName, LeanTechnique>, Value>)[Technique];

/** Options of {@link BroadPhase}, all optional. */
export interface BroadPhaseOptions<D extends Dimensions = 2, Technique extends TechniqueName = LeanTechnique> {
  /** 2 or 3. Default 2; in `broadphase/3d` 3. */
  dimensions?: D | undefined;
  /** One of {@link BroadPhase.techniques}. Default `'auto'`. */
  technique?: Technique | undefined;
  /**
   * For `spatial-grid`, `retained-grid` and `home-cell-grid`, in `broadphase/all`: the side of a cell, or one number
   * per axis, above 0. `auto` uses no grid, and ignores it. A size so small that boxes would be in very many cells is
   * doubled until they are not. Default: chosen from the boxes.
   */
  cellSize?: OfAll<Technique, number | readonly number[]> | undefined;
  /**
   * For `spatial-grid` and `retained-grid`, in `broadphase/all`: the part of the world that is divided into cells,
   * minima then maxima. Boxes outside are still found.
   */
  bounds?: OfAll<Technique, readonly number[]> | undefined;
  /**
   * The size of a world that wraps around, along each axis: what leaves it on one side enters on the other, as in
   * Asteroids. Boxes may be given anywhere; those from 0 to this size, or from minus half of it to half of it, cost
   * least. Two boxes are a pair if they overlap after being shifted by whole worlds. A box as long as the world, or
   * infinite, reaches all around. The numbers stay as they were given. Queries see a copy of each box in every
   * repetition of the world, and return each box once: see the guide to queries, also for worlds that wrap along one
   * axis only. Numbers above 0, up to 1e300. Default: the world is unbounded.
   */
  wrap?: readonly number[] | undefined;
  /**
   * Whether boxes that only touch overlap: in pairs, events, and, unless they say otherwise, queries about places.
   * Default true. If false, a box of zero size overlaps only the boxes it is inside of. A box that is as long as a world
   * that wraps around has no sides along that axis, so nothing merely touches it there.
   */
  touching?: boolean | undefined;
  /** Whether every update determines which pairs began and ended, for `began` and `ended`. Default false. */
  events?: boolean | undefined;
  /**
   * For `broadphase/all`: how far a box may move before the tree of `aabb-tree` changes, or before it leaves its place in
   * the lists of `auto` and `incremental`. Above 0. Default, and in other entry points always: chosen from the observed
   * motion.
   */
  margin?: OfAll<Technique, number> | undefined;
  /** A hint: how many boxes there will be, 0 … 2^24. Avoids growing while they are added. */
  capacity?: number | undefined;
}

/** The names of all options. */
export const optionNames: readonly (keyof BroadPhaseOptions)[] = [
  'dimensions',
  'technique',
  'cellSize',
  'bounds',
  'wrap',
  'touching',
  'events',
  'margin',
  'capacity',
];

/** The arguments of `new BroadPhase`: `dimensions` is required unless it is 2. */
export type ConstructorOptions<D extends Dimensions, Technique extends TechniqueName = LeanTechnique> = 2 extends D
  ? [options?: BroadPhaseOptions<D, Technique>]
  : [options: BroadPhaseOptions<D, Technique> & DimensionsSaid<D>];

/** The option that a space needs unless it is 2D. */
export interface DimensionsSaid<D extends Dimensions> {
  /** The number of dimensions: required unless it is 2. */
  dimensions: NoInfer<D>;
}

/** Refuses an unknown option. `where` says what the options were given to. */
export function checkNames(where: string, options: unknown): void {
  checkOptions(where, options, optionNames);
}

/** Creates a kernel instance with these options. */
export function open(options: BroadPhaseOptions<Dimensions, TechniqueName> = {}): KernelInstance {
  checkNames('new BroadPhase', options);
  const {
    dimensions = builtDimensions[0]!,
    technique = 'auto',
    cellSize,
    bounds,
    margin,
    wrap,
    touching = true,
    events = false,
    capacity = 0,
  } = options;
  checkDimensions(dimensions);
  const number = checkTechnique(technique);
  checkBoolean('events', events);
  checkBoolean('touching', touching);
  checkBoxCount('capacity', capacity);
  const cells = cellSize === undefined ? undefined : checkCellSize(cellSize, dimensions);
  if (bounds !== undefined) checkBounds(bounds, dimensions);
  if (margin !== undefined && !isFinitePositive(margin)) badNumber('margin', margin, 'a number above 0');
  checkOfAll({ cellSize, bounds, margin });
  if (wrap !== undefined) checkWrap(wrap, dimensions);

  const instance = new KernelInstance(dimensions, wrap && [...wrap], touching, events);
  instance.setTechnique(number);
  const { kernel } = instance;
  if (events) kernel.set_events();
  if (!touching) kernel.set_touching(0);
  const io = instance.io();
  if (cells) {
    io.set(cells);
    kernel.set_cell_size();
  }
  if (margin !== undefined) kernel.set_margin(margin);
  if (wrap) {
    io.set(wrap);
    kernel.set_wrap();
  }
  if (bounds) {
    io.set(bounds);
    kernel.set_bounds();
  }
  try {
    kernel.reserve(capacity);
  } catch (error) {
    instance.recover(error, 'capacity');
  }
  return instance;
}

function checkDimensions(dimensions: Dimensions): void {
  if (builtDimensions.includes(dimensions)) return;
  const more = builtDimensions.length > 1 ? '' : ": 'broadphase' has both 2 and 3";
  badValue('dimensions', dimensions, `${builtDimensions.join(' or ')}${more}`);
}

/** Refuses options of the techniques that only `broadphase/all` has. */
function checkOfAll(options: Record<string, unknown>): void {
  if (isBuilt('spatial-grid')) return;
  for (const [name, value] of Object.entries(options)) {
    if (value === undefined) continue;
    badValue(name, value, "it to be left out: only 'broadphase/all' takes this option");
  }
}

/** One positive number per axis. */
function checkCellSize(cellSize: number | readonly number[], dimensions: 2 | 3): readonly number[] {
  const sizes = Array.isArray(cellSize) ? cellSize : new Array<unknown>(dimensions).fill(cellSize);
  const expected = `a number above 0, or ${dimensions} of them, one per axis`;
  if (sizes.length !== dimensions) badValue('cellSize', cellSize, expected);
  for (const size of sizes) {
    if (!isFinitePositive(size)) badValue('cellSize', cellSize, expected, typeof size !== 'number');
  }
  return sizes as number[];
}

function checkBounds(bounds: readonly number[], dimensions: 2 | 3): void {
  const expected = `${2 * dimensions} finite numbers: minima, then larger maxima`;
  if (!Array.isArray(bounds)) badValue('bounds', bounds, expected, true);
  let good = bounds.length === 2 * dimensions && bounds.every(Number.isFinite);
  for (let a = 0; a < dimensions; a++) good &&= bounds[a]! < bounds[a + dimensions]!;
  if (!good) badValue('bounds', bounds, expected);
}
