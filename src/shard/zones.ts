// How a world is cut into zones: which zone owns a box, which ones must see it, and which one reports a pair. Idea: a
// zone sees every box that extends into it. Two boxes that overlap share the point whose coordinates are the larger of
// their two lower corners, so the zone with that point sees both, and it alone reports the pair. That point is chosen
// from given numbers, never computed, so all processes agree on it bit for bit. In a wrapped world, a lower corner is
// taken modulo the world, which may round; so zones see a little further.
import { badNumber, badValue, checkOptions, checkWrap, corners, isFinitePositive, show } from '../errors.ts';
import { isFloat32Array, isFloat64Array } from '../values.ts';

const names = ['x', 'y', 'z'] as const;

/** Where a world is cut: ascending coordinates along each divided axis, such as `{ x: [100, 200] }`. */
export type Borders = Partial<Record<'x' | 'y' | 'z', readonly number[]>>;

/** Options of {@link Zones}. */
export interface ZonesOptions {
  /** Where the world is cut. n borders along an axis make n + 1 zones; the outer ones are unbounded. */
  borders: Borders;
  /** 2 or 3. Default 2. */
  dimensions?: 2 | 3 | undefined;
  /** How far a box may move, along each axis, from one exchange to the next update but one. Default 0. */
  margin?: number | undefined;
  /** The size of a world that wraps around, as for `BroadPhase`. Borders are then between 0 and this size. */
  wrap?: readonly number[] | undefined;
}

/** The rounding error of a lower corner in a world that wraps around, relative to the world. */
const slack = 2 ** -48;

const optionNames: readonly (keyof ZonesOptions)[] = ['borders', 'dimensions', 'margin', 'wrap'];

/** What a Shard has to know of zones, hidden from users. */
interface Inside {
  /** The size of the world, if it wraps around. */
  wrap: readonly number[] | undefined;
  /** `reporterOf` without its checks, which would take as long again for every pair. */
  reporterOf: (a: ArrayLike<number>, b: ArrayLike<number>) => number;
}

/** Whatever is in here is a Zones. */
const insides = new WeakMap<Zones, Inside>();

/** One axis, whether it is cut or not. */
interface Cut {
  axis: number;
  /** Where each zone begins. */
  starts: readonly number[];
  /** The difference of the numbers of neighbouring zones along this axis. */
  stride: number;
  /** The size of the world, or 0 if it does not wrap around. */
  world: number;
  /** Zones within this distance of a box must see it. */
  reach: number;
}

/**
 * A world cut into zones along one axis or several. Zones are counted along x first: zone 0 has the lowest coordinates.
 * Zones are half-open: a border belongs to the zone above it. The object never changes; for other borders create
 * another.
 *
 * @example
 * const zones = new Zones({ borders: { x: [100, 200], y: [50] } });
 * zones.count; // → 6
 * zones.ownerOf([90, 60, 110, 70]); // → 3
 * zones.seenBy([90, 60, 110, 70]); // → [3, 4]
 */
export class Zones {
  /** How many zones there are. */
  readonly count: number;
  /** 2 or 3. */
  readonly dimensions: 2 | 3;
  readonly #cuts: Cut[] = [];

  /**
   * @throws RangeError or TypeError that names the option
   *
   * @example
   * new Zones({ borders: { x: [200, 100] } }); // throws RangeError: borders.x: got [200, 100]
   */
  constructor(options: ZonesOptions) {
    checkOptions('new Zones', options, optionNames);
    const { borders, dimensions = 2, margin = 0, wrap }: Partial<ZonesOptions> = options ?? {};
    if (dimensions !== 2 && dimensions !== 3) badValue('dimensions', dimensions, '2 or 3');
    if (!isFinitePositive(margin, 0)) badNumber('margin', margin, 'a finite number, 0 or more');
    if (wrap !== undefined) checkWrap(wrap, dimensions);
    const cut = checkBorders(borders, dimensions);
    this.dimensions = dimensions;
    this.count = 1;
    for (const [axis, name] of names.slice(0, dimensions).entries()) {
      const world = wrap?.[axis] ?? 0;
      const starts = [world > 0 ? 0 : -Infinity, ...checkCuts(name, cut[name], world)];
      this.#cuts.push({ axis, starts, stride: this.count, world, reach: margin + 4 * slack * world });
      this.count *= starts.length;
    }
    insides.set(this, { wrap: wrap && [...wrap], reporterOf: (a, b) => this.#zoneOf(a, b) });
  }

  /**
   * The zone that owns a box: the one that contains its lower corner.
   *
   * @example
   * new Zones({ borders: { x: [100] } }).ownerOf([100, 0, 120, 20]); // → 1
   */
  ownerOf(box: ArrayLike<number>): number {
    checkPlace('ownerOf', box, this.dimensions);
    return this.#zoneOf(box, box);
  }

  /**
   * The zones that must see a box, its owner included: those that it overlaps when enlarged by the margin on all sides.
   *
   * @example
   * new Zones({ borders: { x: [100] }, margin: 5 }).seenBy([80, 0, 96, 20]); // → [0, 1]
   */
  seenBy(box: ArrayLike<number>): number[] {
    checkPlace('seenBy', box, this.dimensions);
    const seers = [0];
    for (const { axis, starts, stride, world, reach } of this.#cuts) {
      const [low, high] = [box[axis], box[axis + this.dimensions]];
      const first = zoneAt(starts, modulo(modulo(low, world) - reach, world));
      const count = seers.length;
      for (let step = 1; step < starts.length; step++) {
        const zone = (first + step) % starts.length;
        if (!isWithin(starts[zone], low, high, reach, world)) continue;
        for (let k = 0; k < count; k++) seers.push(seers[k] + stride * zone);
      }
      for (let k = 0; k < count; k++) seers[k] += stride * first;
    }
    return seers;
  }

  /**
   * The zone that reports a pair of overlapping boxes: the one that contains the larger of their two lower corners. It
   * sees both. Always pass the two in the same order, such as that of their ids.
   *
   * @example
   * new Zones({ borders: { x: [100] } }).reporterOf([80, 0, 130, 20], [110, 0, 120, 20]); // → 1
   */
  reporterOf(a: ArrayLike<number>, b: ArrayLike<number>): number {
    checkPlace('reporterOf', a, this.dimensions);
    checkPlace('reporterOf', b, this.dimensions);
    return this.#zoneOf(a, b);
  }

  #zoneOf(a: ArrayLike<number>, b: ArrayLike<number>): number {
    let zone = 0;
    for (const { axis, starts, stride, world } of this.#cuts) {
      const [low, other] = [a[axis], b[axis]];
      // Along each axis, the lower bound of a if it lies in b; else that of b, which then lies in a.
      const lies = isWithin(low, other, b[axis + this.dimensions], slack * world, world);
      zone += stride * zoneAt(starts, modulo(lies ? low : other, world));
    }
    return zone;
  }
}

/** Throws unless this is a Zones. */
export function checkZones(where: string, zones: unknown): asserts zones is Zones {
  if (!insides.has(zones as Zones)) badValue(where, zones, 'a Zones of the same import', true);
}

/** Throws unless a world has as many dimensions, and wraps around alike: `where` says whose it is, `as` what it must fit. */
export function checkWorld(where: string, dimensions: number, wrap: unknown, zones: Zones, as: string): void {
  const expected = show(insideOf(zones).wrap);
  if (dimensions !== zones.dimensions) badValue(`${where}.dimensions`, dimensions, `${zones.dimensions}, ${as}`);
  if (show(wrap) !== expected) badValue(`${where}.wrap`, wrap, `${expected}, ${as}`);
}

/** What a Shard has to know of zones that passed `checkZones`. */
export const insideOf = (zones: Zones): Inside => insides.get(zones)!;

/** Throws unless this is the number of a zone. */
export function checkZone(where: string, zone: unknown, count: number): void {
  const isZone = Number.isInteger(zone) && Number(zone) >= 0 && Number(zone) < count;
  if (!isZone) badNumber(where, zone, `an integer from 0 to ${count - 1}`);
}

/** Throws unless this is the number of a zone, but not of this one. */
export function checkOther(where: string, other: unknown, zone: number, count: number): void {
  checkZone(where, other, count);
  if (other === zone) badValue(where, other, 'another zone than this one');
}

function checkBorders(borders: unknown, dimensions: 2 | 3): Borders {
  const isObject = typeof borders === 'object' && borders !== null && !Array.isArray(borders);
  if (!isObject) badValue('borders', borders, 'an object of arrays', true);
  const known: readonly string[] = names.slice(0, dimensions);
  for (const [name, value] of Object.entries(borders)) {
    if (value === undefined || known.includes(name)) continue;
    badValue('borders', name, `borders along ${known.join(', ')} in ${dimensions}D`);
  }
  return borders;
}

/** The borders along one axis. */
function checkCuts(name: string, cuts: unknown, world: number): readonly number[] {
  const expected = `ascending numbers${world ? ` from 0 to ${world}` : ''}`;
  if (cuts === undefined) return [];
  const isArray = Array.isArray(cuts) || isFloat32Array(cuts) || isFloat64Array(cuts);
  const starts: unknown[] = isArray ? [...cuts] : [];
  const areNumbers = isArray && starts.every((at) => typeof at === 'number');
  if (!areNumbers) badValue(`borders.${name}`, cuts, `an array of ${expected}`, true);
  const [first, last] = world ? [0, world] : [-Infinity, Infinity];
  const fit = starts.every((at, k) => at >= (starts[k - 1] ?? first) && at <= last);
  if (!fit) badValue(`borders.${name}`, cuts, expected);
  return starts;
}

/** Throws unless this is a box in these dimensions. */
function checkPlace(where: string, box: ArrayLike<unknown>, dimensions: 2 | 3): void {
  let isGood = box?.length === 2 * dimensions;
  for (let k = 0; isGood && k < dimensions; k++) {
    const [low, high] = [box[k], box[k + dimensions]];
    isGood = typeof low === 'number' && typeof high === 'number' && low <= high;
  }
  if (isGood) return;
  const numbers = Array.isArray(box) || ArrayBuffer.isView(box) ? Array.from(box) : undefined;
  const wrongType = !numbers?.every((value) => typeof value === 'number');
  badValue(where, numbers ?? box, `a box: ${corners[dimensions].join(', ')}`, wrongType);
}

/** The last zone that begins at or below a coordinate. */
function zoneAt(starts: readonly number[], at: number): number {
  let zone = starts.length - 1;
  while (zone > 0 && starts[zone] > at) zone--;
  return zone;
}

/** Whether a coordinate lies between two others, or within a distance of them, also around a wrapped world. */
function isWithin(at: number, low: number, high: number, near: number, world: number): boolean {
  if (world === 0) return at >= low - near && at <= high + near;
  return !(modulo(modulo(at, world) - modulo(low, world) + near, world) > high - low + 2 * near);
}

/** A coordinate in a world that wraps around: from 0 to below its size, rounded; 0 for -Infinity. */
function modulo(at: number, world: number): number {
  if (world === 0) return at;
  const rest = at % world;
  const up = rest < 0 ? rest + world : rest;
  return up < world ? up : 0; // also where `at` is infinite
}
