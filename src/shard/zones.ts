// How a world is cut into zones: who owns a box, who must see it, and who reports a pair.
// Idea: a zone sees every box that reaches into it. Two boxes that overlap share the point whose coordinates are the
// larger of their two lower corners, so the zone with that point sees both, and it alone reports the pair. That point is
// never computed, only chosen, so all processes agree on it bit for bit.
// In a wrapped world a lower corner is taken modulo the world, which may round; zones see a little further for it.
import { badValue } from '../errors.ts';

/** Where a world is cut: ascending coordinates along each axis that is cut, such as `{ x: [100, 200] }`. */
export interface Borders {
  /** Left out: not cut along x. */
  x?: readonly number[];
  /** Left out: not cut along y. */
  y?: readonly number[];
  /** Left out: not cut along z. */
  z?: readonly number[];
}

/** Options of {@link Zones}. */
export interface ZonesOptions {
  /** Where the world is cut. n borders along an axis make n + 1 zones; the outer ones reach on without end. */
  borders: Borders;
  /** 2 or 3. Default 2. */
  dimensions?: 2 | 3;
  /** How far a box may move, along each axis, from one exchange to the next update but one. Default 0. */
  margin?: number;
  /** The size of a world that wraps around, as for `BroadPhase`. Borders are then between 0 and that. */
  wrap?: readonly number[];
}

const names = ['x', 'y', 'z'] as const;

/** One axis that is cut. */
interface Cut {
  axis: number;
  borders: readonly number[];
  /** The size of the world, or 0 where it does not wrap around. */
  world: number;
  /** How far a lower corner may be off, which is rounded in a world that wraps around. */
  slack: number;
  /** How much further than a box the zones are that must see it. */
  reach: number;
}

/**
 * A world cut into zones along one axis or several. Zones are counted along x first: zone 0 has the lowest coordinates.
 * Zones are half open: a border belongs to the zone above it. It never changes; for other borders make another.
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
  /** What it was made with. */
  readonly options: Readonly<ZonesOptions>;
  /** 2 or 3. */
  readonly dimensions: 2 | 3;
  readonly #cuts: readonly Cut[];

  /**
   * @throws RangeError or TypeError that names the option
   *
   * @example
   * new Zones({ borders: { x: [200, 100] } }); // throws RangeError: borders.x: got [200, 100]
   */
  constructor(options: ZonesOptions) {
    const { borders, dimensions = 2, margin = 0, wrap } = options;
    if (dimensions !== 2 && dimensions !== 3) badValue('dimensions', dimensions, '2 or 3');
    if (!(margin >= 0 && margin < Infinity)) badValue('margin', margin, 'a finite number, 0 or more');
    if (wrap && !(wrap.length === dimensions && wrap.every((size) => size > 0 && size <= 1e300))) {
      badValue('wrap', wrap, `${dimensions} numbers above 0, up to 1e300`);
    }
    if (typeof borders !== 'object' || borders === null) badValue('borders', borders, 'an object of arrays', true);
    for (const name of Object.keys(borders)) {
      const known: readonly string[] = names.slice(0, dimensions);
      if (!known.includes(name)) badValue('borders', name, `borders along ${known.join(', ')} in ${dimensions}D`);
    }
    this.#cuts = names.flatMap((name, axis) => {
      const along = borders[name];
      if (along === undefined) return [];
      const world = wrap?.[axis] ?? 0;
      const last = world || Infinity;
      const fit = along.every((at, k) => at >= (k > 0 ? along[k - 1] : world ? 0 : -Infinity) && at <= last);
      if (!fit) badValue(`borders.${name}`, along, `ascending numbers${world ? ` from 0 to ${world}` : ''}`);
      const slack = world * 2 ** -48;
      return [{ axis, borders: [...along], world, slack, reach: margin + 4 * slack }];
    });
    this.options = options;
    this.dimensions = dimensions;
    this.count = this.#cuts.reduce((count, cut) => count * (cut.borders.length + 1), 1);
  }

  /**
   * The zone that owns a box: the one with its lower corner.
   *
   * @example
   * new Zones({ borders: { x: [100] } }).ownerOf([100, 0, 120, 20]); // → 1
   */
  ownerOf(box: ArrayLike<number>): number {
    return this.reporterOf(box, box);
  }

  /**
   * The zones that must see a box, its owner too: those it reaches into when it grows by the margin on all sides.
   *
   * @example
   * new Zones({ borders: { x: [100] }, margin: 5 }).seenBy([80, 0, 96, 20]); // → [0, 1]
   */
  seenBy(box: ArrayLike<number>): number[] {
    const out = [0];
    let stride = 1;
    for (const { axis, borders, world, reach } of this.#cuts) {
      const size = borders.length + 1;
      const [low, high] = [box[axis], box[axis + this.dimensions]];
      const start = world > 0 ? modulo(modulo(low, world) - reach, world) : low - reach;
      const end = world > 0 ? start + (high - low) + 2 * reach : high + reach;
      const first = zoneAt(borders, start);
      let count = zoneAt(borders, end) - first + 1;
      if (world > 0 && !(end < world)) {
        count = end - world < start ? Math.min(size, size - first + zoneAt(borders, end - world) + 1) : size;
      }
      const known = out.length;
      for (let step = 1; step < count; step++) {
        for (let k = 0; k < known; k++) out.push(out[k] + stride * ((first + step) % size));
      }
      for (let k = 0; k < known; k++) out[k] += stride * first;
      stride *= size;
    }
    return out;
  }

  /**
   * The zone that reports a pair of boxes that overlap: the one with the larger of their two lower corners. It sees
   * both. Give the two always in the same order, such as that of their ids.
   *
   * @example
   * new Zones({ borders: { x: [100] } }).reporterOf([80, 0, 130, 20], [110, 0, 120, 20]); // → 1
   */
  reporterOf(a: ArrayLike<number>, b: ArrayLike<number>): number {
    let zone = 0;
    let stride = 1;
    for (const { axis, borders, world, slack } of this.#cuts) {
      let low = a[axis];
      const other = b[axis];
      if (world === 0) low = Math.max(low, other);
      else {
        // The lower corner of a, if it lies in b; else that of b, which then lies in a.
        low = modulo(low, world);
        const start = modulo(other, world);
        const within = modulo(low - start + slack, world) <= b[axis + this.dimensions] - other + 2 * slack;
        if (!within) low = start;
      }
      zone += stride * zoneAt(borders, low);
      stride *= borders.length + 1;
    }
    return zone;
  }
}

/** How many borders are at or below a coordinate. */
function zoneAt(borders: readonly number[], at: number): number {
  let zone = 0;
  while (zone < borders.length && borders[zone] <= at) zone++;
  return zone;
}

/** A coordinate in a world that wraps around: from 0 to below its size, rounded; 0 for what has no lower end. */
function modulo(at: number, world: number): number {
  let rest = at % world;
  if (rest < 0) rest += world;
  return rest < world ? rest : 0; // also where `at` is infinite
}
