// Rays, sweeps and nearest boxes: the queries whose answers are in order. All queries see the boxes of the last update:
// the kernel scans them for the first few queries after it, and searches an index if there are more. The other queries
// are in place-queries.ts and plane-queries.ts.
import {
  cut,
  finite,
  isNumber,
  isPlace,
  none,
  number,
  order,
  point,
  point2,
  point3,
  readHit,
  tooFar,
  walk,
} from './answers.ts';
import { badHit, badQuery, badValue, checkOut, isHit, sweep2, sweep3 } from './errors.ts';
import { limitAt, orderNear, orderRay, orderWay } from './generated/abi.ts';
import type { KernelInstance } from './kernel/instance.ts';
import {
  type Asked,
  checkMost,
  everything,
  farOptions,
  type NearestOptions,
  nearestOptions,
  type RayAllOptions,
  type RayHit,
  type RayOptions,
  rayOptions,
  readOptions,
  type SweepHit,
  type SweepOptions,
  sweepOptions,
} from './query-options.ts';

export const ray2 = [...point2, 'directionX', 'directionY'];
export const ray3 = [...point3, 'directionX', 'directionY', 'directionZ'];

export function rayCast(
  instance: KernelInstance,
  a: number,
  b: number,
  c: number,
  d: number,
  e?: unknown,
  f?: unknown,
  options?: RayOptions,
) {
  const asked = ray(instance, 'rayCast', rayOptions, a, b, c, d, e, f, options);
  return first(instance, 'rayCast', orderRay, asked) as RayHit | undefined;
}

/** The first hit, or the first that is accepted. */
function first(instance: KernelInstance, where: string, kind: typeof orderRay | typeof orderWay, asked: Asked) {
  const isRay = kind === orderRay;
  const { out, accept } = asked;
  if (out !== undefined && !isHit(out)) badHit(`${where}: out`, out, isRay ? 'distance' : 'time');
  if (accept === undefined && order(instance, where, kind, asked, 1) === 0) return undefined;
  const hit = (out ?? (isRay ? { id: 0, distance: 0, normal: [] } : { id: 0, time: 0, normal: [] })) as RayHit &
    SweepHit;
  if (accept !== undefined) return walk(instance, where, kind, asked, everything, hit) ? hit : undefined;
  const rank = instance.doubleView()[readHit(instance, 0, hit)]!;
  if (isRay) hit.distance = rank;
  else hit.time = rank; // not `hit[far]`, which would be garbage
  return hit;
}

export function rayCastAll(
  instance: KernelInstance,
  a: number,
  b: number,
  c: number,
  d: number,
  e?: unknown,
  f?: unknown,
  options?: RayAllOptions,
): RayHit[] {
  const asked = ray(instance, 'rayCastAll', farOptions, a, b, c, d, e, f, options);
  if (asked.visit !== undefined) {
    walk(instance, 'rayCastAll', orderRay, asked, everything);
    return none as RayHit[];
  }
  const isGiven = asked.out !== undefined;
  const { spare } = instance;
  const out = checkOut('rayCastAll', asked.out as RayHit[] | undefined);
  for (let k = 0; k < out.length; k++) if (!isHit(out[k])) badHit(`rayCastAll: out[${k}]`, out[k], 'distance');
  const count = order(instance, 'rayCastAll', orderRay, asked, everything);
  for (let k = 0; k < count; k++) {
    const hit = out[k] ?? (isGiven ? spare.pop() : undefined) ?? { id: 0, distance: 0, normal: [] };
    hit.distance = instance.doubleView()[readHit(instance, k, hit)]!;
    out[k] = hit;
  }
  while (out.length > count) spare.push(out.pop()!);
  return out;
}

export function sweep(
  instance: KernelInstance,
  a: number,
  b: number,
  c: number,
  d: number,
  e: number,
  f: number,
  g?: unknown,
  h?: unknown,
  i?: unknown,
  options?: SweepOptions,
) {
  const flat = instance.width === 4;
  const good = isNumber(a) && isNumber(b) && isNumber(c) && isNumber(d) && isNumber(e) && isNumber(f);
  if (flat) {
    if (!(good && a <= c && b <= d && isPlace(e) && isPlace(f))) badQuery('sweep', [a, b, c, d, e, f], sweep2, number);
    options = g as SweepOptions | undefined;
  } else if (!(good && a <= d && b <= e && c <= f && isPlace(g) && isPlace(h) && isPlace(i))) {
    badQuery('sweep', [a, b, c, d, e, f, g, h, i], sweep3, number);
  }
  const asked = readOptions(instance, 'sweep', options, sweepOptions);
  const io = instance.io();
  io[0] = a;
  io[1] = b;
  io[2] = c;
  io[3] = d;
  io[4] = e;
  io[5] = f;
  if (!flat) {
    io[6] = g as number;
    io[7] = h as number;
    io[8] = i as number;
  }
  io[limitAt] = 1;
  if (instance.wrap !== undefined) {
    for (let k = instance.width; k < instance.width + instance.dimensions; k++) {
      if (Math.abs(io[k]!) > instance.farthest) tooFar('sweep: the motion', io[k]!, instance.farthest);
    }
  }
  if (asked.visit === undefined) return first(instance, 'sweep', orderWay, asked) as SweepHit | undefined;
  if (asked.accept !== undefined) throw new TypeError('sweep: got both visit and accept, expected one of them');
  walk(instance, 'sweep', orderWay, asked, everything);
  return undefined;
}

export function nearest(
  instance: KernelInstance,
  x: number,
  y: number,
  z: number,
  k?: unknown,
  options?: NearestOptions,
): number[] {
  const flat = instance.width === 4;
  const asked = point(instance, 'nearest', nearestOptions, x, y, flat ? k : z, options);
  const wanted = checkMost('nearest', flat ? z : k);
  if (asked.visit !== undefined) {
    walk(instance, 'nearest', orderNear, asked, wanted);
    return none as number[];
  }
  const out = checkOut('nearest', asked.out as number[] | undefined);
  const distances = asked.distances as number[] | undefined;
  if (distances !== undefined && (!Array.isArray(distances) || distances === out)) {
    badValue('nearest: distances', distances, 'an ordinary array other than out', true);
  }
  const count = order(instance, 'nearest', orderNear, asked, wanted);
  const words = instance.wordView();
  const first = instance.exports.hits_address();
  for (let n = 0; n < count; n++) out[n] = words[(first >>> 2) + 4 * n + 2]!;
  if (distances !== undefined) {
    const doubles = instance.doubleView();
    for (let n = 0; n < count; n++) distances[n] = doubles[(first >>> 3) + 2 * n]!;
    cut(distances, count);
  }
  return cut(out, count);
}

/** Writes a ray, with its limit, to the io array, after the options, which follow the numbers. */
function ray(
  instance: KernelInstance,
  where: string,
  names: readonly string[],
  a: number,
  b: number,
  c: number,
  d: number,
  e: unknown,
  f: unknown,
  options: unknown,
): Asked {
  const flat = instance.width === 4;
  const good = isPlace(a) && isPlace(b) && isPlace(c) && isPlace(d);
  if (flat) {
    if (!good) badQuery(where, [a, b, c, d], ray2, finite);
    options = e;
  } else if (!(good && isPlace(e) && isPlace(f))) {
    badQuery(where, [a, b, c, d, e, f], ray3, finite);
  }
  const asked = readOptions(instance, where, options as RayOptions | undefined, names);
  const io = instance.io();
  io[0] = a;
  io[1] = b;
  if (flat) {
    io[2] = a;
    io[3] = b;
    io[4] = c;
    io[5] = d;
  } else {
    io[2] = c;
    io[3] = a;
    io[4] = b;
    io[5] = c;
    io[6] = d;
    io[7] = e as number;
    io[8] = f as number;
  }
  const most = io[limitAt]!;
  if (most > instance.farthest && most < Number.POSITIVE_INFINITY) {
    tooFar(`${where}: maxDistance`, most, instance.farthest);
  }
  return asked;
}
