// Rays, sweeps and nearest boxes: the queries whose answers are in order. All queries see the boxes of the last update;
// the index is built at the first query after it. The other queries are in place-queries.ts and plane-queries.ts.
import {
  type Accept,
  finite,
  firstAccepted,
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
  type Visitor,
  visitOrder,
} from './answers.ts';
import {
  badHit,
  badQuery,
  badValue,
  checkDistance,
  checkOptions,
  checkOut,
  isHit,
  isSize,
  sweep2,
  sweep3,
} from './errors.ts';
import { limitAt, orderNear, orderRay, orderWay } from './generated/abi.ts';
import type { KernelInstance } from './kernel/instance.ts';
import {
  checkMost,
  everything,
  farOptions,
  type NearestOptions,
  nearestOptions,
  type RayAllOptions,
  type RayHit,
  type RayOptions,
  rayOptions,
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
  options = ray(instance, 'rayCast', rayOptions, a, b, c, d, e, f, options);
  if (options?.out !== undefined && !isHit(options.out)) badHit('rayCast: out', options.out, 'distance');
  if (options?.accept !== undefined) {
    const hit: RayHit = options.out ?? { id: 0, distance: 0, normal: [] };
    return firstAccepted(instance, 'rayCast', orderRay, options, hit, options.accept as Accept) ? hit : undefined;
  }
  if (order(instance, 'rayCast', orderRay, options, 1) === 0) return undefined;
  const hit: RayHit = options?.out ?? { id: 0, distance: 0, normal: [] };
  hit.distance = instance.doubleView()[readHit(instance, 0, hit)]!;
  return hit;
}

export function rayCastAll(
  instance: KernelInstance,
  spare: RayHit[],
  a: number,
  b: number,
  c: number,
  d: number,
  e?: unknown,
  f?: unknown,
  options?: RayAllOptions,
): RayHit[] {
  options = ray(instance, 'rayCastAll', farOptions, a, b, c, d, e, f, options);
  if (options?.visit !== undefined) {
    visitOrder(instance, 'rayCastAll', orderRay, options, everything, options.visit as Visitor);
    return none as RayHit[];
  }
  const out: RayHit[] = checkOut('rayCastAll', options?.out);
  for (let k = 0; k < out.length; k++) if (!isHit(out[k])) badHit(`rayCastAll: out[${k}]`, out[k], 'distance');
  const count = order(instance, 'rayCastAll', orderRay, options, everything);
  for (let k = 0; k < count; k++) {
    const hit = out[k] ?? (options?.out && spare.pop()) ?? { id: 0, distance: 0, normal: [] };
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
  const io = instance.io();
  if (instance.width === 4) {
    const good = isNumber(a) && isNumber(b) && isNumber(c) && isNumber(d) && a <= c && b <= d;
    if (!(good && isPlace(e) && isPlace(f))) badQuery('sweep', [a, b, c, d, e, f], sweep2, number);
    options = g as SweepOptions | undefined;
  } else {
    const all = isNumber(a) && isNumber(b) && isNumber(c) && isNumber(d) && isNumber(e) && isNumber(f);
    const good = all && a <= d && b <= e && c <= f;
    if (!(good && isPlace(g) && isPlace(h) && isPlace(i))) {
      badQuery('sweep', [a, b, c, d, e, f, g, h, i], sweep3, number);
    }
    io[6] = g;
    io[7] = h;
    io[8] = i;
  }
  io[0] = a;
  io[1] = b;
  io[2] = c;
  io[3] = d;
  io[4] = e;
  io[5] = f;
  io[limitAt] = 1;
  if (instance.wrap !== undefined) {
    for (let k = instance.width; k < instance.width + instance.dimensions; k++) {
      if (Math.abs(io[k]!) > instance.farthest) tooFar('sweep: the motion', io[k]!, instance.farthest);
    }
  }
  checkOptions('sweep', options, sweepOptions);
  if (options?.visit !== undefined) {
    if (options.accept !== undefined) throw new TypeError('sweep: got both visit and accept, expected one of them');
    visitOrder(instance, 'sweep', orderWay, options, everything, options.visit as Visitor);
    return undefined;
  }
  if (options?.out !== undefined && !isHit(options.out)) badHit('sweep: out', options.out, 'time');
  if (options?.accept !== undefined) {
    const hit: SweepHit = options.out ?? { id: 0, time: 0, normal: [] };
    return firstAccepted(instance, 'sweep', orderWay, options, hit, options.accept as Accept) ? hit : undefined;
  }
  if (order(instance, 'sweep', orderWay, options, 1) === 0) return undefined;
  const hit: SweepHit = options?.out ?? { id: 0, time: 0, normal: [] };
  hit.time = instance.doubleView()[readHit(instance, 0, hit)]!;
  return hit;
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
  const most = flat ? z : k;
  if (flat) {
    options = k as NearestOptions | undefined;
    point(instance, 'nearest', x, y);
  } else {
    point(instance, 'nearest', x, y, z);
  }
  const wanted = checkMost('nearest', most);
  checkOptions('nearest', options, nearestOptions);
  const { maxDistance = Number.POSITIVE_INFINITY } = options ?? {};
  checkDistance('nearest: maxDistance', maxDistance);
  instance.io()[limitAt] = maxDistance;
  if (options?.visit !== undefined) {
    visitOrder(instance, 'nearest', orderNear, options, wanted, options.visit);
    return none as number[];
  }
  const out: number[] = checkOut('nearest', options?.out);
  const distances = options?.distances;
  if (distances !== undefined && (!Array.isArray(distances) || distances === out)) {
    badValue('nearest: distances', distances, 'an ordinary array other than out', true);
  }
  const count = order(instance, 'nearest', orderNear, options, wanted);
  const words = instance.wordView();
  const first = instance.kernel.hits_address();
  for (let n = 0; n < count; n++) out[n] = words[(first >>> 2) + 4 * n + 2]!;
  out.length = count;
  if (distances !== undefined) {
    const doubles = instance.doubleView();
    for (let n = 0; n < count; n++) distances[n] = doubles[(first >>> 3) + 2 * n]!;
    distances.length = count;
  }
  return out;
}

/** Writes a ray, with its limit, to the io array; returns the options, which follow the numbers. */
function ray<Options extends { maxDistance?: number | undefined }>(
  instance: KernelInstance,
  where: string,
  known: readonly string[],
  a: number,
  b: number,
  c: number,
  d: number,
  e: unknown,
  f: unknown,
  options: Options | undefined,
): Options | undefined {
  const io = instance.io();
  const good = isPlace(a) && isPlace(b) && isPlace(c) && isPlace(d);
  if (instance.width === 4) {
    if (!good) badQuery(where, [a, b, c, d], ray2, finite);
    io[2] = a;
    io[3] = b;
    io[4] = c;
    io[5] = d;
    options = e as Options | undefined;
  } else {
    if (!(good && isPlace(e) && isPlace(f))) badQuery(where, [a, b, c, d, e, f], ray3, finite);
    io[2] = c;
    io[3] = a;
    io[4] = b;
    io[5] = c;
    io[6] = d;
    io[7] = e;
    io[8] = f;
  }
  io[0] = a;
  io[1] = b;
  checkOptions(where, options, known);
  const { maxDistance = Number.POSITIVE_INFINITY } = options ?? {};
  // The text is made only after the test: a string in each call would be garbage.
  if (!isSize(maxDistance)) checkDistance(`${where}: maxDistance`, maxDistance);
  io[limitAt] = maxDistance;
  if (maxDistance > instance.farthest && maxDistance < Number.POSITIVE_INFINITY) {
    tooFar(`${where}: maxDistance`, maxDistance, instance.farthest);
  }
  return options;
}
