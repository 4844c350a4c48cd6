// Rays, sweeps and planes among numbers from the smallest doubles to the largest, against a model that computes with whole numbers without a
// limit. Where the answer is so close that doubles may round it, the model says neither yes nor no.
// SEED=… runs a failure again, RUNS=… runs more.
import type { RayHit, SweepHit } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { abs, below, big, Extreme, exactly, larger, limit } from '../support/extreme.ts';
import { runs, seed } from '../support/runs.ts';

const unit = exactly(1);
type Ratio = readonly [bigint, bigint];
interface Met {
  time: Ratio;
  axes: number[];
}
interface Reported {
  id: number;
  rank: number;
  normal: number[];
}
interface ManyHits {
  ids: Uint32Array;
  offsets: Uint32Array;
  distances?: Float64Array;
  times?: Float64Array;
}

/** -1 or 1, or undefined if they are too close to tell. */
function compare(one: Ratio, other: Ratio): -1 | 1 | undefined {
  const is = below(one[0] * other[1], other[0] * one[1]);
  return is === undefined ? undefined : is ? -1 : 1;
}
/** Whether it is smaller than the doubles that have all digits. A ray has distances instead of times: see `scaleOf`. */
const isTiny = (time: Ratio, scale: bigint) => time[0] * scale * 2n ** 970n < time[1] * unit;
/** What times are multiplied by, in the unit of `exactly`: for a ray, the longest part of its direction. */
const scaleOf = (way: readonly number[], isRay: boolean) =>
  isRay ? way.map((x) => abs(exactly(x))).reduce(larger, 0n) : unit;
const ratio = ([a, b]: Ratio) => Number((a << 60n) / b) / 2 ** 60;

class Ahead extends Extreme {
  /** When a moving box meets another: `undefined` if that is too close to tell, `null` if not. */
  meeting(
    from: readonly number[],
    way: readonly number[],
    box: readonly number[],
    isRay: boolean,
  ): Met | null | undefined {
    const d = this.dimensions;
    let unclear = false;
    let outside = false;
    let enter: Ratio | undefined;
    const axes: number[] = [];
    const leaves: Ratio[] = [];
    const tiny = (time: Ratio) => isTiny(time, scaleOf(way, isRay));
    for (let a = 0; a < d; a++) {
      const [lo, hi, least, most, along] = [
        big(from[a]!),
        big(from[a + d]!),
        big(box[a]!),
        big(box[a + d]!),
        big(way[a]!),
      ];
      const slack = isRay
        ? 0n
        : larger(Number.isFinite(from[a]!) ? abs(lo) : 0n, Number.isFinite(from[a + d]!) ? abs(hi) : 0n) >> 46n;
      const isClose = (x: bigint, y: bigint) => abs(x) < limit && abs(y) < limit && abs(x - y) <= slack && x !== y;
      if (isClose(hi, least) || isClose(lo, most)) unclear = true;
      const before = hi < least || (hi === least && abs(hi) < limit);
      const past = lo > most || (lo === most && abs(lo) < limit);
      leaves[a] = [limit * limit, 1n];
      if (along === 0n) {
        if (!before && !past) continue;
        if (lo < hi || hi < least || lo > most) return unclear ? undefined : null;
        outside = true;
        continue;
      }
      const forth = along > 0n;
      if (forth ? past : before) return unclear ? undefined : null;
      const ahead = forth ? most - lo : hi - least;
      const isSame = abs(forth ? lo : hi) === limit; // never left, if both are there
      if (ahead < limit / 2n && !isSame) leaves[a] = [ahead, abs(along)];
      if (!before && !past) continue;
      const gap = forth ? least - hi : lo - most;
      if (gap >= limit / 2n) return null; // at infinity
      const time: Ratio = [gap, abs(along)];
      const bothTiny = enter && tiny(time) && tiny(enter);
      const order = bothTiny ? undefined : enter ? compare(time, enter) : 1;
      if (order === undefined) {
        unclear ||= enter![0] * time[1] !== time[0] * enter![1];
        axes.push(a);
      } else if (order > 0) {
        enter = time;
        axes.splice(0, axes.length, a);
      }
    }
    if (unclear) return undefined;
    if (!enter) return outside ? null : { time: [0n, 1n], axes: [] };
    for (let a = 0; a < d; a++) {
      if (axes.includes(a)) continue;
      const order = compare(leaves[a]!, enter);
      if (order === undefined || (tiny(leaves[a]!) && tiny(enter))) return undefined;
      if (order < 0) return null;
    }
    // Faces met at once: the box, if it has a size, leaves one when it meets the other.
    if (axes.length > 1 && axes.some((a) => compare(leaves[a]!, enter!) !== 1 || tiny(leaves[a]!))) return undefined;
    return { time: enter, axes };
  }

  /** Checks hits, in order, against what each box says. */
  checkHits(what: string, from: number[], way: number[], isRay: boolean, most: number, hits: Reported[]): void {
    const squared = way.reduce((sum, x) => sum + exactly(x) ** 2n, 0n);
    const found = new Map(hits.map((hit) => [hit.id, hit]));
    expect(found.size, what).toBe(hits.length);
    hits.forEach((hit, n) => {
      if (!(hit.rank <= most)) expect.fail(`${what}: ${hit.rank} is too far`);
      if (n > 0 && !(hits[n - 1]!.rank <= hit.rank)) expect.fail(`${what}: the order is wrong`);
    });
    this.boxes.forEach((box, id) => {
      const met = this.meeting(from, way, box, isRay);
      if (met === undefined) return;
      const about = `${what}: box ${id}: ${box}, time ${met && `${ratio(met.time)}, axes ${met.axes}`}`;
      const hit = found.get(id);
      if (met === null) {
        if (hit) expect.fail(`${about}: is hit`);
        return;
      }
      const [time, one] = met.time;
      // As squares, so that nothing is rounded: (time / one) ** 2 * squared against rank ** 2.
      const rank: Ratio = isRay ? [time * time * squared, one * one] : [(time * unit) ** 2n, one * one];
      const limitOf = (x: number): Ratio => (x === Infinity ? [limit * limit, 1n] : [exactly(x) ** 2n, 1n]);
      const order = compare(rank, limitOf(most === Infinity ? Number.MAX_VALUE : most));
      const isNear = time === 0n || order === -1;
      if (hit === undefined) {
        if (isNear) expect.fail(`${about}: is not hit`);
        return;
      }
      if (order === 1 && most === Infinity) return; // no double is as large
      const [root, few] = [exactly(hit.rank), 4n]; // a distance so small has few digits
      const isLast =
        root < 2n ** 60n &&
        larger(0n, root - few) ** 2n * rank[1] <= rank[0] &&
        rank[0] <= (root + few) ** 2n * rank[1];
      if (order === 1 && !isLast) expect.fail(`${about}: is hit beyond the limit`);
      const got = limitOf(Math.min(hit.rank, Number.MAX_VALUE)); // which may be rounded up to infinity
      const isClose = this.isClose(hit.rank, from, way, box, met, isRay);
      if (
        compare(rank, got) !== undefined &&
        !isLast &&
        !(hit.rank < 1e-290 && isTiny(met.time, scaleOf(way, isRay))) &&
        !isClose
      )
        expect.fail(`${about}: got ${hit.rank}`);
      if (met.axes.length === 1) {
        const normal = way.map((x, a) => (a === met.axes[0] ? -Math.sign(x) : 0));
        expect(hit.normal, about).toEqual(normal);
      } else if (met.axes.length === 0) {
        expect(hit.normal, about).toEqual(way.map(() => 0));
      }
    });
  }

  /** A sweep may stop a little earlier, by as much as is rounded when its corners are computed. */
  isClose(rank: number, from: number[], way: number[], box: number[], met: Met, isRay: boolean): boolean {
    if (isRay || met.axes.length === 0) return false;
    const [time, one] = met.time;
    return met.axes.some((a) => {
      const sizes = [from[a]!, from[a + this.dimensions]!, box[a]!, box[a + this.dimensions]!].filter(Number.isFinite);
      const most = sizes.map((x) => abs(exactly(x))).reduce(larger, abs(exactly(way[a]!)));
      const apart = time * unit * abs(exactly(way[a]!)) - exactly(rank) * one * abs(exactly(way[a]!));
      return abs(apart) <= ((most >> 44n) + 2n) * unit * one;
    });
  }

  ray(): void {
    const point = this.point();
    let way = this.way();
    // Doubles cannot hold a direction of which one part is so much smaller than another.
    const longest = Math.max(...way.map(Math.abs));
    way = way.map((x) => (Math.abs(x) < longest * 1e-290 ? 0 : x));
    const maxDistance = this.pick(Infinity, Infinity, Math.abs(this.number()));
    const what = `rayCastAll(${[...point, ...way]}) within ${maxDistance}`;
    const all = this.ask.rayCastAll!(...point, ...way, { maxDistance }) as (RayHit & Reported)[];
    const hits = all.map(({ id, distance, normal }) => ({ id, rank: distance, normal: normal.map((x) => x + 0) }));
    this.checkHits(what, [...point, ...point], way, true, maxDistance, hits);
    const first = this.ask.rayCast!(...point, ...way, { maxDistance });
    expect(first, what).toEqual(all[0]);
    this.rays.push(...point, ...way);
    this.firsts.push(maxDistance === Infinity ? all[0] : (this.ask.rayCast!(...point, ...way) as RayHit | undefined));
  }

  sweep(): void {
    let box = this.box();
    if (this.random() < 0.3)
      box = [...this.point(), ...this.point()].map((x, k, all) =>
        k < this.dimensions ? Math.min(x, all[k + this.dimensions]!) : Math.max(x, all[k - this.dimensions]!),
      );
    const way = this.way();
    const hits: Reported[] = [];
    const what = `sweep(${[...box, ...way]})`;
    const accept = (id: number, { time, normal }: { time: number; normal: number[] }) => {
      hits.push({ id, rank: time, normal: normal.map((x) => x + 0) });
      return false;
    };
    this.ask.sweep!(...box, ...way, { accept });
    this.checkHits(what, box, way, false, 1, hits);
    const first = this.ask.sweep!(...box, ...way) as SweepHit | undefined;
    expect(first && [first.id, first.time], what).toEqual(hits[0] && [hits[0].id, hits[0].rank]);
    this.sweeps.push(...box, ...way);
    this.stops.push(first);
  }

  readonly rays: number[] = [];
  readonly firsts: (RayHit | undefined)[] = [];
  readonly sweeps: number[] = [];
  readonly stops: (SweepHit | undefined)[] = [];

  /** Many in one call are answered as one by one. */
  many(): void {
    const rays = this.ask.rayCasts!(this.rays) as ManyHits;
    const sweeps = this.ask.sweeps!(this.sweeps) as ManyHits;
    this.firsts.forEach((hit, k) => {
      const at = rays.offsets[k]!;
      const is = rays.offsets[k + 1]! > at ? [rays.ids[at], rays.distances![at]] : undefined;
      expect(is, `ray ${k} of rayCasts(${this.rays})`).toEqual(hit && [hit.id, hit.distance]);
    });
    this.stops.forEach((hit, k) => {
      const at = sweeps.offsets[k]!;
      const is = sweeps.offsets[k + 1]! > at ? [sweeps.ids[at], sweeps.times![at]] : undefined;
      expect(is, `sweep ${k} of sweeps(${this.sweeps})`).toEqual(hit && [hit.id, hit.time]);
    });
  }

  /** Planes are summed in doubles: only that no search leaves out or adds anything is tested here. */
  planes(): void {
    const d = this.dimensions;
    const planes = Array.from({ length: Math.floor(this.random() * 5) }, () => [...this.way(), this.number()]);
    const what = `queryPlanes(${JSON.stringify(planes)})`;
    for (const touching of [true, false]) {
      const sum = (box: readonly number[], plane: readonly number[], foremost: boolean) => {
        let all = 0;
        for (let a = 0; a < d; a++) if (plane[a] !== 0) all += plane[a]! * box[plane[a]! > 0 === foremost ? a + d : a]!;
        return all + plane[d]!;
      };
      const isBehind = (x: number) => (touching ? x < 0 : x <= 0);
      const isFront = (x: number) => (touching ? x >= 0 : x > 0);
      const seen: [number, boolean][] = [];
      this.ask.queryPlanes!(planes.flat(), {
        touching,
        visit: (id: number, inside: boolean) => void seen.push([id, inside]),
      });
      const expected = this.boxes.flatMap((box, id) =>
        planes.some((plane) => isBehind(sum(box, plane, true)))
          ? []
          : [[id, planes.every((plane) => isFront(sum(box, plane, false)))]],
      );
      expect(
        seen.sort(([a], [b]) => a - b),
        `${what} touching ${touching}`,
      ).toEqual(expected);
    }
  }
}

describe(`from the smallest to the largest numbers (SEED=${seed})`, () => {
  test.each([2, 3] as const)('rays, sweeps and planes in %iD', (dimensions) => {
    for (let n = 0; n < runs(400); n++) {
      const extreme = new Ahead(dimensions, seed + n, Number.MAX_VALUE / 8); // differences must not overflow
      try {
        for (let k = 0; k < 9; k++) extreme.ray();
        for (let k = 0; k < 9; k++) extreme.sweep();
        extreme.many();
        for (let k = 0; k < 4; k++) extreme.planes();
      } catch (error) {
        throw new Error(`SEED=${seed + n} RUNS=1`, { cause: error });
      }
    }
  });
});
