// Circles and neighbours among numbers from the smallest doubles to the largest, against a model that computes with whole numbers without a
// limit. Where the answer is so close that doubles may round it, the model says neither yes nor no.
// SEED=… runs a failure again, RUNS=… runs more.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';
import type { Loose } from '../support/asker.ts';
import { abs, below, big, Extreme, exactly, larger, limit } from '../support/extreme.ts';
import { runs, seed } from '../support/runs.ts';

const ascending = (ids: Iterable<number>) => [...ids].sort((a, b) => a - b);

class Near extends Extreme {
  circle(): void {
    const point = this.point();
    const other = this.pick(...this.boxes);
    const gap = Math.max(0, other[0]! - point[0]!, point[0]! - other[this.dimensions]!);
    const radius = this.pick(0, Math.abs(this.number()), Math.abs(this.number()), gap, Infinity);
    const name = this.dimensions === 2 ? 'queryCircle' : 'querySphere';
    for (const touching of [true, false]) {
      const what = `${name}(${[...point, radius]}) touching ${touching}`;
      const found = this.ask[name]!(...point, radius, { touching }) as number[];
      const many = this.ask.queryCircles!([...point, radius], { touching }) as {
        ids: Uint32Array;
        offsets: Uint32Array;
      };
      expect(ascending(many.ids.slice(0, many.offsets[1])), what).toEqual(ascending(found));
      const set = new Set(found);
      expect(set.size, what).toBe(found.length);
      this.boxes.forEach((box, id) => {
        const gaps = this.gaps(box, [...point, ...point]);
        const most = gaps.reduce(larger);
        let expected: boolean | undefined;
        if (most >= limit / 2n) expected = radius === Infinity && touching;
        else if (radius === Infinity) expected = touching || most <= exactly(Number.MAX_VALUE) ? true : undefined;
        else if (radius === 0 && !touching)
          expected = point.every((x, a) => box[a]! < x && x < box[a + this.dimensions]!);
        else if (most === 0n) expected = touching || radius > 0;
        else {
          expected = below(this.squared(box, [...point, ...point]), big(radius) ** 2n);
          const alone = gaps.filter((gap) => gap > 0n).length === 1;
          if (alone && most === big(radius)) expected = touching;
        }
        if (expected === !set.has(id)) expect.fail(`${what}: box ${id}: ${box}, expected ${expected}`);
      });
    }
  }

  /** Whether a distance is that whose square is given, rounded. */
  isRoot(distance: number, squared: bigint): boolean {
    if (distance === Infinity)
      return squared > exactly(Number.MAX_VALUE) ** 2n - ((exactly(Number.MAX_VALUE) ** 2n) >> 44n);
    const root = exactly(distance);
    return below(root * root, squared) === undefined || ((root - 1n) ** 2n <= squared && squared <= (root + 1n) ** 2n);
  }

  nearest(): void {
    const point = this.point();
    const k = this.pick(1, 2, 5, Infinity);
    const other = this.pick(...this.boxes);
    const gap = Math.max(0, other[0]! - point[0]!, point[0]! - other[this.dimensions]!);
    const maxDistance = this.pick(Infinity, Infinity, Math.abs(this.number()), gap);
    const distances: number[] = [];
    const what = `nearest(${[...point, k]}) within ${maxDistance}`;
    const ids = this.ask.nearest!(...point, k, { maxDistance, distances }) as number[];
    const many = this.ask.nearests!(point, k, { maxDistance }) as { ids: Uint32Array; distances: Float64Array };
    expect([...many.ids], what).toEqual(ids);
    expect([...many.distances], what).toEqual(distances);
    this.checkNear(what, [...point, ...point], k, maxDistance, ids, distances);
  }

  checkNear(
    what: string,
    from: number[],
    k: number,
    maxDistance: number,
    ids: number[],
    distances: number[],
    own = -1,
  ): void {
    expect(ids.length, what).toBeLessThanOrEqual(k);
    ids.forEach((id, n) => {
      const [rank, last] = [distances[n]!, distances[n - 1]!];
      if (!(rank <= maxDistance && this.isRoot(rank, this.squared(this.boxes[id]!, from))))
        expect.fail(`${what}: box ${id}: ${this.boxes[id]}, ${rank}`);
      if (n > 0 && !(rank > last || (rank === last && id > ids[n - 1]!))) expect.fail(`${what}: order of ${ids}`);
    });
    const most = ids.length === k ? distances.at(-1)! : maxDistance;
    const set = new Set(ids);
    this.boxes.forEach((box, id) => {
      if (set.has(id) || id === own) return;
      // What is left out is further away, as far as doubles tell.
      const squared = this.squared(box, from);
      const isFar = below(big(most) ** 2n, squared) !== false || this.isRoot(most, squared);
      if (!isFar || (most === Infinity && ids.length < k)) expect.fail(`${what}: box ${id} is missing: ${box}`);
    });
  }

  nearestsOfAll(): void {
    const k = this.pick(1, 3, 1000);
    const { of, ids, distances, offsets } = this.ask.nearestsOfAll!(k) as Record<string, Uint32Array>;
    expect([...of!].sort((a, b) => a - b)).toEqual([...this.boxes.keys()]);
    of!.forEach((id, n) => {
      const [from, to] = [offsets![n]!, offsets![n + 1]!];
      const what = `nearestsOfAll(${k}) of ${id}: ${this.boxes[id]}`;
      this.checkNear(
        what,
        this.boxes[id]!,
        k,
        Infinity,
        [...ids!.slice(from, to)],
        [...distances!.slice(from, to)],
        id,
      );
    });
  }
}

describe(`from the smallest to the largest numbers (SEED=${seed})`, () => {
  test.each([2, 3] as const)('circles and neighbours in %iD', (dimensions) => {
    for (let n = 0; n < runs(400); n++) {
      const extreme = new Near(dimensions, seed + n);
      try {
        for (let k = 0; k < 6; k++) extreme.circle();
        for (let k = 0; k < 6; k++) extreme.nearest();
        if (extreme.boxes.length < 30) extreme.nearestsOfAll();
      } catch (error) {
        throw new Error(`SEED=${seed + n} RUNS=1`, { cause: error });
      }
    }
  });

  test.each([2, 3] as const)('circles and neighbours in %iD, in a world that wraps around', (dimensions) => {
    const random = createRandom(seed);
    const pick = <T>(...from: readonly T[]): T => from[Math.floor(random() * from.length)]!;
    for (let n = 0; n < runs(200); n++) {
      const wrap = Array.from(
        { length: dimensions },
        () => pick(3, 1, 0.7) * 10 ** pick(-320, -300, -165, -161, -20, 0, 20, 160, 299),
      );
      const number = (world: number) => {
        const x =
          pick(0, world, world, world, 2 * world, -world, world * 1e-5) * pick(random(), random(), 0.5, 0.25, 1);
        return random() < 0.03 ? pick(-1, 1) * pick(1e300, 1e-310, 5e-324, 1e150) : x;
      };
      const boxes = Array.from({ length: pick(1, 5, 40) }, () => {
        const lo = wrap.map(number);
        const hi = lo.map((x, a) => x + Math.abs(number(wrap[a]!) * pick(0, 0, 0.3, 1)));
        const box = [...lo, ...hi];
        if (random() < 0.05) box[pick(...lo.keys())] = -Infinity;
        if (random() < 0.05) box[dimensions + pick(...lo.keys())] = Infinity;
        return box;
      });
      const space = new BroadPhase({ dimensions, wrap } as never).setAll(boxes.flat()).update();
      const ask = space as unknown as Loose;
      const all = [...boxes.keys()];
      for (let k = 0; k < 5; k++) {
        const point = wrap.map(number);
        const radius = pick(0, Infinity, Math.abs(number(pick(...wrap))));
        for (const touching of [true, false]) {
          const name = dimensions === 2 ? 'queryCircle' : 'querySphere';
          const what = `${name}(${[...point, radius]}), touching ${touching}, in ${wrap}`;
          const found = new Set(ask[name]!(...point, radius, { touching }) as number[]);
          const many = ask.queryCircles!([...point, radius], { touching }) as { ids: Uint32Array };
          expect(ascending(many.ids), what).toEqual(ascending(found));
          boxes.forEach((box, id) => {
            const away = wrap.map((world, a) => aroundGap(point[a]!, box[a]!, box[a + dimensions]!, world));
            if (radius < Infinity && away.includes(undefined)) return;
            const squared = away.reduce<bigint>((sum, gap) => sum + (gap ?? 0n) ** 2n, 0n);
            const slack = wrap.flatMap((world, a) => [world, point[a]!, box[a]!, box[a + dimensions]!]);
            const most =
              slack
                .filter(Number.isFinite)
                .map((x) => abs(exactly(x)))
                .reduce(larger) >> 44n;
            const root = radius < Infinity ? big(radius) : limit;
            const isNear = squared < (root > most ? root - most : 0n) ** 2n;
            const isFar = squared > (root + most) ** 2n;
            if (found.has(id) ? isFar : isNear) expect.fail(`${what}: box ${id}: ${box}`);
          });
        }
        const ids = ask.nearest!(...point, Infinity) as number[];
        expect(ascending(ids), `nearest(${point}) in ${wrap}: ${JSON.stringify(boxes)}`).toEqual(all);
      }
    }
  });
});

/** The distance along an axis that wraps around; undefined where doubles have too few digits for it. */
function aroundGap(at: number, lo: number, hi: number, size: number): bigint | undefined {
  if (!(hi - lo < size)) return 0n;
  if (Math.max(Math.abs(at), Math.abs(lo)) > size * 2 ** 20) return undefined;
  const world = exactly(size);
  const [from, to, point] = [exactly(lo), exactly(hi), exactly(at)];
  const worlds = (((point - from) % world) + world) % world; // from its minimum on
  const past = worlds - (to - from);
  return past <= 0n ? 0n : past < world - worlds ? past : world - worlds;
}
