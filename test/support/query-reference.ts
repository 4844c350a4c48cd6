// The reference for all queries: each tests every box, in doubles.
import { type Entry, touches } from './model.ts';

export type Entries = ReadonlyMap<number, Entry>;

export interface Asked {
  mask?: number;
  ignore?: number | readonly number[];
  within?: boolean;
  maxDistance?: number;
}

export interface Ranked {
  id: number;
  rank: number;
  normal: number[];
}

function* wanted(entries: Entries, { mask, ignore }: Asked): Generator<[number, Entry]> {
  for (const [id, entry] of entries) {
    if (
      entry.isOff ||
      id === ignore ||
      (typeof ignore === 'object' && ignore.includes(id)) ||
      (mask !== undefined && mask !== 0xffffffff && (entry.layer & mask) === 0)
    )
      continue;
    yield [id, entry];
  }
}

const ascending = (ids: number[]) => ids.sort((a, b) => a - b);

const inOrder = (hits: Ranked[]) => hits.sort((a, b) => a.rank - b.rank || a.id - b.id);

export function inBox(entries: Entries, box: readonly number[], asked: Asked): number[] {
  const d = box.length / 2;
  const holds = (inner: readonly number[]) => inner.every((x, k) => (k < d ? box[k] <= x : x <= box[k]));
  const found = [...wanted(entries, asked)].filter(([, e]) => (asked.within ? holds(e.box) : touches(box, e)));
  return ascending(found.map(([id]) => id));
}

/** Boxes that are not wholly behind any of the planes: by id, whether the box is wholly inside. */
export function inPlanes(
  entries: Entries,
  planes: readonly (readonly number[])[],
  asked: Asked,
): { id: number; inside: boolean }[] {
  const far = (box: readonly number[], plane: readonly number[], foremost: boolean) => {
    const dimensions = box.length / 2;
    let sum = 0;
    for (let a = 0; a < dimensions; a++) {
      if (plane[a] !== 0) sum += plane[a] * box[plane[a] > 0 === foremost ? a + dimensions : a];
    }
    return sum + plane[dimensions];
  };
  return [...wanted(entries, asked)]
    .filter(([, { box }]) => !planes.some((plane) => far(box, plane, true) < 0))
    .map(([id, { box }]) => ({ id, inside: planes.every((plane) => far(box, plane, false) >= 0) }))
    .sort((a, b) => a.id - b.id);
}

/** The gaps between a box and an entry along each axis: 0 if they overlap, or if a number is NaN. */
function gaps(box: readonly number[], entry: Entry): number[] {
  const d = box.length / 2;
  return Array.from({ length: d }, (_, k) => {
    if (entry.box[k] > box[k + d]) return entry.box[k] - box[k + d];
    return box[k] > entry.box[k + d] ? box[k] - entry.box[k + d] : 0;
  });
}

const squared = (away: readonly number[], unit = 1) => away.reduce((sum, x) => sum + x * unit * (x * unit), 0);

/** A power of two: if numbers are multiplied by it, their squares neither overflow nor lose digits. */
function unitOf(square: number): number {
  if (square > 1e-280 && square < 1e300) return 1;
  return square < 1 ? 2 ** 600 : 2 ** -600;
}

export function inCircle(entries: Entries, centre: readonly number[], radius: number, asked: Asked): number[] {
  const unit = unitOf(radius * radius);
  const near = [...wanted(entries, asked)].filter(
    ([, entry]) => squared(gaps([...centre, ...centre], entry), unit) <= squared([radius], unit),
  );
  return ascending(near.map(([id]) => id));
}

/** The distance from a point; see `apart`. */
export function distance(point: readonly number[], entry: Entry): number {
  return apart([...point, ...point], entry);
}

/** The distance from a box. Its square may be too large for a double, or too small. */
export function apart(box: readonly number[], entry: Entry): number {
  const away = gaps(box, entry);
  const unit = unitOf(squared(away));
  return Math.sqrt(squared(away, unit)) / unit;
}

export function near(entries: Entries, point: readonly number[], k: number, asked: Asked): Ranked[] {
  return nearBox(entries, [...point, ...point], k, asked);
}

/** The entries nearest to a box; for `near` the box is a point. */
export function nearBox(entries: Entries, box: readonly number[], k: number, asked: Asked): Ranked[] {
  const { maxDistance = Infinity } = asked;
  const all = [...wanted(entries, asked)].map(([id, entry]) => ({ id, rank: apart(box, entry), normal: [] }));
  return inOrder(all.filter(({ rank }) => rank <= maxDistance)).slice(0, k);
}

/**
 * The entries that a box meets when it moves by `way`, with the time of the hit as for a sweep. If `length` is given,
 * with the distance as for a ray. Entries that are only met at a corner come after all others of the same time.
 */
export function ahead(
  entries: Entries,
  box: readonly number[],
  way: readonly number[],
  limit: number,
  asked: Asked,
  length?: number,
): Ranked[] {
  const hits: (Ranked & { corner: boolean })[] = [];
  for (const [id, entry] of wanted(entries, asked)) {
    const met = meeting(box, way, entry.box, length === undefined);
    const rank = met ? met.time * (length ?? 1) : Infinity;
    if (met && rank <= limit) hits.push({ id, rank, normal: met.normal, corner: met.corner });
  }
  hits.sort((a, b) => a.rank - b.rank || Number(a.corner) - Number(b.corner) || a.id - b.id);
  return hits.map(({ id, rank, normal }) => ({ id, rank, normal }));
}

const touch = 2 ** -48;
const roundings = 2 ** -51;
const sizeOf = (x: number) => (Number.isFinite(x) ? Math.abs(x) : 0);
const isSingle = (x: number) => Math.fround(x) === x || Number.isNaN(x);
const bits = new BigUint64Array(1);
const double = new Float64Array(bits.buffer);

function below(x: number): number {
  double[0] = x;
  bits[0]!--;
  return double[0]!;
}

/** The share of the path along one axis after which lo … hi touches a face. */
function timeTo(lo: number, hi: number, face: number, along: number, stops: boolean): number {
  const forth = along > 0;
  let gap = Math.max(0, forth ? face - hi : lo - face);
  if (!stops || gap === Infinity) return gap / Math.abs(along);
  if (lo < hi && !(isSingle(lo) && isSingle(hi) && isSingle(face))) {
    const error = roundings * (gap + sizeOf(lo) + sizeOf(hi) + sizeOf(face));
    const other = forth ? face - (hi - lo) : face + (hi - lo);
    if (error > touch * Math.max(sizeOf(face), sizeOf(other))) gap = Math.max(0, gap - error);
  }
  let time = gap / Math.abs(along);
  while (time > 0 && time < Infinity && (forth ? hi + along * time > face : lo + along * time < face)) {
    time = below(time);
  }
  return time;
}

export function meeting(moving: readonly number[], way: readonly number[], still: readonly number[], stops: boolean) {
  const d = way.length;
  const touched: { axis: number; time: number }[] = [];
  const leaves: number[] = [];
  let edge = false;
  for (let a = 0; a < d; a++) {
    const [lo, hi, from, to, along] = [moving[a], moving[a + d], still[a], still[a + d], way[a]];
    const slack = Math.min(touch * Math.max(sizeOf(lo), sizeOf(hi)), (hi - lo) / 4);
    const before = hi < from || (hi <= from + slack && Number.isFinite(hi));
    const past = lo > to || (lo >= to - slack && Number.isFinite(lo));
    leaves[a] = Infinity;
    if (along === 0) {
      if (before || past) edge = true;
      if ((before || past) && (lo < hi || hi < from || lo > to)) return undefined;
      continue;
    }
    if (along > 0 ? past : before) return undefined;
    const leave = (along > 0 ? to - lo : from - hi) / along;
    if (!Number.isNaN(leave)) leaves[a] = leave;
    if (before || past) touched.push({ axis: a, time: timeTo(lo, hi, along > 0 ? from : to, along, stops) });
  }
  if (touched.length === 0) return edge ? undefined : { time: 0, normal: Array<number>(d).fill(0), corner: false };
  const time = Math.max(...touched.map((face) => face.time));
  const [{ axis }, second] = touched.filter((face) => face.time === time);
  if (time === Infinity) return undefined;
  for (let a = 0; a < d; a++) {
    if (a !== axis && (moving[a] < moving[a + d] ? leaves[a] <= time : leaves[a] < time)) return undefined;
  }
  return {
    time,
    normal: Array.from({ length: d }, (_, a) => (a === axis ? -Math.sign(way[a]) : 0)),
    corner: second !== undefined,
  };
}
