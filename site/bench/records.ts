// Files of results, as bench/harness/run.mjs and this page's own run write them, and what can be computed from them.
import type { Contender, Figures, Judged } from '../../bench/harness/judge.mjs';

/** A contender of a race: with `total`, the milliseconds of a frame; too slow; or failed. */
export type Result = Contender;

/** A row of results: one scene or motion, with a number of boxes, and all contenders. */
export interface Race extends Judged {
  kind: string;
  name: string;
  dimensions: 2 | 3;
  numbers?: string;
  by?: string;
}

export interface Results {
  date: string;
  commit?: string;
  machine: { cpu: string; cores: number; system: string; node?: string };
  rows: Race[];
}

export interface Timed extends Result {
  total: Figures;
}

export const isOurs = ({ peer }: Result): boolean => peer === 'broadphase';
const isTimed = (result: Result): result is Timed => result.total !== undefined;

/** Those with a time, the fastest first. */
export const timed = (race: Race): Timed[] =>
  race.contenders.filter(isTimed).sort((a, b) => a.total.median - b.total.median);

/** The contender that all are compared with: `auto`, or `set` if boxes are objects, or else the best of ours. */
export function reference(race: Race): Timed | undefined {
  const ours = timed(race).filter(isOurs);
  return ours.find(({ name }) => name === 'auto' || name === 'set') ?? ours[0];
}

export const ofKind = ({ rows }: Results, kind: string): Race[] => rows.filter((row) => row.kind === kind);

/** Reads a file of results. Throws an error that says what is wrong if it is not one. */
export function readResults(text: string): Results {
  const found = JSON.parse(text) as Results;
  const good =
    Array.isArray(found.rows) &&
    found.rows.every(
      ({ kind, name, contenders }) =>
        [kind, name].every((each) => typeof each === 'string') && Array.isArray(contenders),
    );
  if (!good || !found.machine) throw new Error('these are no results of the benchmark');
  return found;
}

/** How a time grows with the number of boxes: the slope of a straight line through the logarithms. */
export function exponent(points: readonly { count: number; ms: number }[]): number | undefined {
  if (points.length < 2) return undefined;
  const x = points.map(({ count }) => Math.log(count));
  const y = points.map(({ ms }) => Math.log(ms));
  const mean = (values: number[]) => values.reduce((sum, value) => sum + value, 0) / values.length;
  const [meanX, meanY] = [mean(x), mean(y)];
  const across = x.reduce((sum, value) => sum + (value - meanX) ** 2, 0);
  if (across === 0) return undefined;
  return x.reduce((sum, value, k) => sum + (value - meanX) * (y[k] - meanY), 0) / across;
}

export interface Curve {
  name: string;
  ours: boolean;
  points: { count: number; ms: number }[];
  exponent: number | undefined;
}

/** For each contender of a scene, its times against the number of boxes. */
export function curves(races: readonly Race[]): Curve[] {
  const found = new Map<string, Curve>();
  for (const race of [...races].sort((a, b) => a.count - b.count)) {
    for (const result of timed(race)) {
      const curve = found.get(result.name) ?? {
        name: result.name,
        ours: isOurs(result),
        points: [],
        exponent: undefined,
      };
      curve.points.push({ count: race.count, ms: result.total.median });
      found.set(result.name, curve);
    }
  }
  return [...found.values()].map((curve) => ({ ...curve, exponent: exponent(curve.points) }));
}

/** The times of our techniques in a race, in multiples of the best fixed one. */
export function ratios(race: Race): { name: string; ratio: number }[] {
  const ours = timed(race).filter(isOurs);
  const [best] = ours.filter(({ name }) => name !== 'auto').sort((a, b) => a.update!.median - b.update!.median);
  return best ? ours.map(({ name, update }) => ({ name, ratio: update!.median / best.update!.median })) : [];
}

/** For advice, a technique within this factor of the best is as good as the best. */
const asGood = 1.1;

export interface Advice {
  technique: string;
  /** The number of races in which it was the best, or as good. */
  good: number;
  races: number;
  /** Its largest multiple of the best, and where. */
  worst: number;
  where: string;
  /** The scenes in which it was as good as the best with some number of boxes. */
  scenes: string[];
}

/** For each technique, where it is as good as the best, and how far off it can be; the most useful first. */
export function advice(races: readonly Race[]): Advice[] {
  const found = new Map<string, Advice>();
  for (const race of races) {
    for (const { name, ratio } of ratios(race)) {
      const mine = found.get(name) ?? { technique: name, good: 0, races: 0, worst: 0, where: '', scenes: [] };
      mine.races++;
      if (ratio <= asGood) {
        mine.good++;
        if (!mine.scenes.includes(race.name)) mine.scenes.push(race.name);
      }
      if (ratio > mine.worst) {
        mine.worst = ratio;
        mine.where = `${race.name}, ${race.count.toLocaleString('en')}`;
      }
      found.set(name, mine);
    }
  }
  return [...found.values()].sort((a, b) => b.good / b.races - a.good / a.races);
}
