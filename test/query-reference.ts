// The answers to every question, in doubles, by looking at every box: what the queries are compared with.
import { type Entry, touches } from './model.ts';

export type Entries = ReadonlyMap<number, Entry>;

export interface Asked {
  mask?: number;
  ignore?: number;
  maxDistance?: number;
}

export interface Ranked {
  id: number;
  rank: number;
  normal: number[];
}

function* wanted(entries: Entries, { mask, ignore }: Asked): Generator<[number, Entry]> {
  for (const [id, entry] of entries) {
    if (id === ignore || (mask !== undefined && mask !== 0xffffffff && (entry.layer & mask) === 0)) continue;
    yield [id, entry];
  }
}

const ascending = (ids: number[]) => ids.sort((a, b) => a - b);

const inOrder = (hits: Ranked[]) => hits.sort((a, b) => a.rank - b.rank || a.id - b.id);

export function inBox(entries: Entries, box: readonly number[], asked: Asked): number[] {
  return ascending([...wanted(entries, asked)].filter(([, entry]) => touches(box, entry)).map(([id]) => id));
}

function squared(point: readonly number[], { box }: Entry): number {
  return point.reduce((sum, x, axis) => {
    const away = Math.max(box[axis] - x, x - box[axis + point.length], 0);
    return sum + away * away;
  }, 0);
}

export function inCircle(entries: Entries, centre: readonly number[], radius: number, asked: Asked): number[] {
  const near = [...wanted(entries, asked)].filter(([, entry]) => squared(centre, entry) <= radius * radius);
  return ascending(near.map(([id]) => id));
}

export function near(entries: Entries, point: readonly number[], k: number, asked: Asked): Ranked[] {
  const { maxDistance = Infinity } = asked;
  const all = [...wanted(entries, asked)].map(([id, entry]) => ({ id, rank: squared(point, entry), normal: [] }));
  return inOrder(all.filter(({ rank }) => rank <= maxDistance * maxDistance)).slice(0, k);
}

/** What a box meets that moves by `way`, with its time, or with the distance where `length` is that of the way. */
export function ahead(
  entries: Entries,
  box: readonly number[],
  way: readonly number[],
  limit: number,
  asked: Asked,
  length = 1,
): Ranked[] {
  const hits: Ranked[] = [];
  for (const [id, entry] of wanted(entries, asked)) {
    const met = meeting(box, way, entry.box);
    if (met && met.time * length <= limit) hits.push({ id, rank: met.time * length, normal: met.normal });
  }
  return inOrder(hits);
}

function meeting(moving: readonly number[], way: readonly number[], still: readonly number[]) {
  const d = way.length;
  let enter = 0;
  let leave = Infinity;
  let face = -1;
  for (let a = 0; a < d; a++) {
    const [lo, hi, from, to] = [moving[a], moving[a + d], still[a], still[a + d]];
    if (hi < from || lo > to) {
      // Apart along this axis: it must move towards the other.
      if (Math.sign(way[a]) !== (hi < from ? 1 : -1)) return undefined;
      const time = (hi < from ? from - hi : to - lo) / way[a];
      if (time > enter || face < 0) {
        enter = time;
        face = a;
      }
    }
    const last = way[a] > 0 ? to - lo : from - hi;
    if (way[a] !== 0 && !Number.isNaN(last)) leave = Math.min(leave, last / way[a]);
  }
  if (enter > leave || enter === Infinity) return undefined;
  return { time: enter, normal: Array.from({ length: d }, (_, a) => (a === face ? -Math.sign(way[a]) : 0)) };
}
