// Files of results, as bench/run.mjs writes them and as this page's own run does, and what can be read out of them.
import type { PlayedRow } from '../../bench/coherence-table.mjs';

export interface Figures {
  median: number;
  mean: number;
  p95: number;
  worst: number;
}

export interface Result {
  name: string;
  /** 'broadphase' for our own techniques. */
  peer: string;
  figures?: Figures;
  /** Pairs that are not the exact ones: how many there should be, how many were missed and added. */
  wrong?: { exact: number; missed: number; extra: number };
  problem?: string;
  skipped?: string;
}

export interface Race {
  scene: string;
  dimensions: 2 | 3;
  count: number;
  pairs: number;
  results: Result[];
}

export interface Results {
  date: string;
  machine: { cpu: string; cores: number; system: string; node?: string };
  /** What an update costs when little changes: such a file has no races. */
  coherence?: PlayedRow[];
  /** Our techniques among themselves, on more scenes. */
  everyTechnique?: boolean;
  races: Race[];
}

export interface Timed extends Result {
  figures: Figures;
}

export const isOurs = ({ peer }: Result): boolean => peer === 'broadphase';
const isTimed = (result: Result): result is Timed => result.figures !== undefined;

/** Those with a time, the fastest first; a floor is no contender. */
export const timed = (race: Race): Timed[] =>
  race.results
    .filter(isTimed)
    .filter(({ peer }) => peer !== 'floor')
    .sort((a, b) => a.figures.median - b.figures.median);

/** Whom all are compared with: `auto`, or else the best of our techniques. */
export function reference(race: Race): Timed | undefined {
  const ours = timed(race).filter(isOurs);
  return ours.find(({ name }) => name === 'auto') ?? ours[0];
}

/** Reads a file of results; says what is wrong with one that is none. */
export function readResults(text: string): Results {
  const found = JSON.parse(text) as Results;
  if (found.machine && Array.isArray(found.coherence)) return { ...found, races: [] };
  const good =
    Array.isArray(found.races) &&
    found.races.every(({ scene, count, results }) => typeof scene === 'string' && count >= 0 && Array.isArray(results));
  if (!good || !found.machine) throw new Error('these are no results of the benchmark');
  for (const race of found.races) race.dimensions ??= race.scene.includes('3d') ? 3 : 2;
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

/** For each contender of a scene its times against the number of boxes. */
export function curves(races: readonly Race[], scene: string): Curve[] {
  const found = new Map<string, Curve>();
  for (const race of races.filter((each) => each.scene === scene).sort((a, b) => a.count - b.count)) {
    for (const result of timed(race)) {
      const curve = found.get(result.name) ?? {
        name: result.name,
        ours: isOurs(result),
        points: [],
        exponent: undefined,
      };
      curve.points.push({ count: race.count, ms: result.figures.median });
      found.set(result.name, curve);
    }
  }
  return [...found.values()].map((curve) => ({ ...curve, exponent: exponent(curve.points) }));
}

/** What our techniques took in a race, in multiples of the best fixed one. */
export function ratios(race: Race): { name: string; ratio: number }[] {
  const ours = timed(race).filter(isOurs);
  const best = ours.find(({ name }) => name !== 'auto');
  return best ? ours.map(({ name, figures }) => ({ name, ratio: figures.median / best.figures.median })) : [];
}

/** Within this of the best a technique is as good, for advice. */
const asGood = 1.1;

export interface Advice {
  technique: string;
  /** In how many of the races it was timed in it was the best, or as good. */
  good: number;
  races: number;
  /** Its largest multiple of the best, and where. */
  worst: number;
  where: string;
  /** The scenes in which it was as good as the best with some number of boxes. */
  scenes: string[];
}

/** For each technique where it is as good as the best, and how far off it can be; the most useful first. */
export function advice(races: readonly Race[]): Advice[] {
  const found = new Map<string, Advice>();
  for (const race of races) {
    for (const { name, ratio } of ratios(race)) {
      const mine = found.get(name) ?? { technique: name, good: 0, races: 0, worst: 0, where: '', scenes: [] };
      mine.races++;
      if (ratio <= asGood) {
        mine.good++;
        if (!mine.scenes.includes(race.scene)) mine.scenes.push(race.scene);
      }
      if (ratio > mine.worst) {
        mine.worst = ratio;
        mine.where = `${race.scene}, ${race.count.toLocaleString('en')}`;
      }
      found.set(name, mine);
    }
  }
  return [...found.values()].sort((a, b) => b.good / b.races - a.good / a.races);
}
