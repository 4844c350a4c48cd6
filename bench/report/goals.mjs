// The goals of the library: each with its figure from a record of results, and whether it is met.
import { ratiosOf } from './motions.mjs';
import { autoAgainstBest, fastest, isPackage, named, ofKind } from './rows.mjs';
import { short, times, whole } from './words.mjs';

/** `update` of `auto` against `strip-sweep`, by the medians, in 2D and for few or many boxes: where more is missed. */
const limits = {
  straight: 0.3,
  pile: 0.2,
  noise: 0.25,
  breathing: 0.2,
  springs: 0.25,
  flow: 0.4,
  flock: 0.4,
  wander: 0.45,
  circles: 0.5,
  groups: 0.5,
  units: 0.5,
  sand: 0.5,
  patrols: 0.25,
  tiles: 0.25,
  leaping: 0.25,
  scroll: 0.3,
  zoom: 0.6,
  selection: 0.25,
  reversing: 0.6,
  bullets: 1.03,
  gravity: 1.03,
  hail: 1.03,
  blasts: 1.03,
  ticks: 1.03,
};
/** In 3D a limit below 1 may be exceeded by this much. */
const moreIn3d = 1.5;

const limitOf = ({ motion, dimensions }) =>
  dimensions === 3 && limits[motion] < 1 ? Math.min(1, moreIn3d * limits[motion]) : limits[motion];

/** How many of the rows have a value of at most, or at least, the limit, and the worst value. */
function inAll(goal, rows, figureOf, limit, show, least = false) {
  const found = rows.map((row) => ({
    row,
    value: figureOf(row),
    bound: typeof limit === 'function' ? limit(row) : limit,
  }));
  const known = found.filter(({ value }) => value !== undefined);
  if (known.length === 0) return { goal, figure: '' };
  const excess = ({ value, bound }) => (least ? bound / value : value / bound);
  known.sort((a, b) => excess(b) - excess(a));
  const good = known.filter((each) => excess(each) <= 1).length;
  const [{ row, value }] = known;
  const where = `${row.name} ${row.dimensions}D, ${whole(row.count)}${row.by ? `, ${row.by}` : ''}`;
  return {
    goal,
    figure: `${good} of ${known.length}; the worst: ${show(value)} (${where})`,
    met: good === known.length,
  };
}

function atMost(goal, value, limit, unit) {
  if (value === undefined) return { goal, figure: '' };
  return { goal, figure: `${short(value)} ${unit}`, met: value <= limit };
}

const totalOf = (row, name) => named(row, name)?.total.median;
const over = (a, b) => (a === undefined || b === undefined ? undefined : a / b);
/** How many times as long the fastest package takes. */
const packageOver = (row, name) => over(fastest(row, isPackage)?.total.median, totalOf(row, name));

function frameGoals(record) {
  const objects = ofKind(record, 'objects');
  const thousand = objects.find(({ count, name }) => count === 1000 && name === 'all move');
  const byHand = (row) => fastest(row, ({ peer }) => peer === 'by hand')?.total.median;
  return [
    inAll(
      'a whole frame from objects by `set`: ahead of hand-written code',
      objects,
      (row) => over(byHand(row), totalOf(row, 'set')),
      1,
      times,
      true,
    ),
    inAll('... and of every npm package', objects, (row) => packageOver(row, 'set'), 1, times, true),
    atMost(
      '1,000 things that all move, a whole frame by `set`: 0.03 ms',
      thousand && totalOf(thousand, 'set'),
      0.03,
      'ms',
    ),
  ];
}

function sceneGoals(record) {
  const scenes = ofKind(record, 'scenes');
  const singles = scenes.filter(({ numbers }) => numbers === 'float32');
  const updateOf = (name, count) => {
    const row = singles.find((each) => each.name === name && each.count === count);
    return row && named(row, 'auto')?.update.median;
  };
  return [
    inAll(
      '100,000 boxes: 40 times as fast as every npm package',
      singles.filter(({ count }) => count === 100_000),
      (row) => packageOver(row, 'auto'),
      40,
      times,
      true,
    ),
    inAll(
      '100,000 boxes: 4 times as fast as every native library, side by side',
      ofKind(record, 'native').filter(({ count }) => count >= 100_000),
      (row) => over(fastest(row, ({ peer }) => peer !== 'broadphase')?.total.median, totalOf(row, 'strip-sweep')),
      4,
      times,
      true,
    ),
    atMost('1,000,000 moving boxes, 2D: 16.6 ms', updateOf('uniform2d', 1_000_000), 16.6, 'ms'),
    atMost('100,000 boxes at rest and 1,000 moving, update: 0.1 ms', updateOf('tile-map', 101_000), 0.1, 'ms'),
    inAll(
      '`auto` never more than 10 % and 20 microseconds slower than the best technique',
      scenes.filter(autoAgainstBest),
      (row) => (autoAgainstBest(row).within ? Math.min(1.1, autoAgainstBest(row).ratio) : autoAgainstBest(row).ratio),
      1.1,
      times,
    ),
  ];
}

function motionGoals(record) {
  const held = ofKind(record, 'motions').filter(({ count }) => count >= 10_000);
  return [
    inAll(
      'motions for tuning: `auto` against a full rebuild, each within its limit',
      held.filter(({ set }) => set === 'tune'),
      (row) => ratiosOf(row).median,
      limitOf,
      times,
    ),
    inAll(
      'motions for validation: each within its limit',
      held.filter(({ set }) => set === 'check'),
      (row) => ratiosOf(row).median,
      limitOf,
      times,
    ),
    inAll(
      'all motions: the mean is within 1.5 times the median',
      held,
      ({ contenders: [, auto] }) => auto.update.mean / auto.update.median,
      1.5,
      times,
    ),
    inAll(
      'all motions: the first frames cost no more than 1.15 full rebuilds',
      held,
      (row) => ratiosOf(row).start,
      1.15,
      times,
    ),
    inAll(
      'few movers: never above 1.05 full rebuilds',
      ofKind(record, 'movers'),
      (row) => ratiosOf(row).median,
      1.05,
      times,
    ),
  ];
}

function callGoals(record) {
  const once = ofKind(record, 'once');
  return [
    inAll(
      '`findPairs`, first call: ahead of every package',
      once,
      ({ contenders: [ours, ...others] }) => over(Math.min(...others.flatMap(({ first }) => first ?? [])), ours.first),
      1,
      times,
      true,
    ),
    inAll(
      '... tenth call',
      once,
      ({ contenders: [ours, ...others] }) => over(Math.min(...others.flatMap(({ later }) => later ?? [])), ours.later),
      1,
      times,
      true,
    ),
    inAll(
      'every query: ahead of every npm package',
      ofKind(record, 'queries'),
      (row) => packageOver(row, 'broadphase'),
      1,
      times,
      true,
    ),
  ];
}

function loadGoals(record) {
  const cold = ofKind(record, 'cold').find(({ name }) => name === 'in Node');
  const broadphase = cold?.contenders.find(({ name }) => name === 'broadphase');
  return [
    atMost('in Node, from import to first pairs: 5 ms', broadphase?.own, 5, 'ms'),
    atMost('25 kB gzipped, kernel inlined', broadphase?.kB, 25, 'kB'),
  ];
}

/** Every goal with what a record says of it. */
export const goals = (record) =>
  [frameGoals, sceneGoals, motionGoals, callGoals, loadGoals].flatMap((goalsOf) => goalsOf(record));
