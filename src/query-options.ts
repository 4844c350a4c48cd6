// The options and the results of queries, and the checks of these options.
import {
  badId,
  badNumber,
  badValue,
  checkBits,
  checkBoolean,
  checkDistance,
  checkOptions,
  isId,
  isSize,
} from './errors.ts';
import { limitAt, noCircle, radiusAt, touchingAt, within } from './generated/abi.ts';
import type { KernelInstance } from './kernel/instance.ts';

/** Options of every query, each of which adds an `out` or a `visit` of its own. */
export interface QueryOptions {
  /**
   * Only boxes on a layer in this mask: 32 bits, as for `setFilter`. Default: all bits, and so all boxes, even those on
   * no layer.
   */
  mask?: number | undefined;
  /** A box to leave out, usually the one that asks, or a few: each is compared with each answer. */
  ignore?: number | readonly number[] | undefined;
}

/** Options of queries about places. */
export interface AreaOptions {
  /** Whether boxes that only touch count as answers. Default: the space's option, which is true by default. */
  touching?: boolean | undefined;
}

/** Options of queries that return ids. */
export interface IdsOptions extends QueryOptions, AreaOptions {
  /** Filled and returned, instead of a new array. If you reuse it and the options, queries make no garbage. */
  out?: number[] | undefined;
  /**
   * Called for each answer instead of collecting them; `false` ends the search. The answer is then empty. Must not call
   * `update` or `restore` of this space, or the query throws; nor may it return a Promise. This holds for every `visit`
   * and `accept`.
   */
  visit?: ((id: number) => unknown) | undefined;
}

/** Options of {@link BroadPhase.queryBox}. */
export interface BoxOptions extends IdsOptions {
  /**
   * Whether boxes must be wholly inside; they may touch the sides, unless `touching` is false, even infinite ones.
   * Default false.
   */
  within?: boolean | undefined;
}

/** Options of {@link BroadPhase.queryPlanes}. */
export interface PlanesOptions extends QueryOptions, AreaOptions {
  /** Filled and returned, instead of a new array. */
  out?: number[] | undefined;
  /**
   * Called for each answer instead of collecting them, with whether the box is wholly inside; `false` ends the search.
   */
  visit?: ((id: number, inside: boolean) => unknown) | undefined;
}

/** Options of {@link BroadPhase.nearest}. */
export interface NearestOptions extends QueryOptions {
  /** The largest distance, at least 0. Default: no limit. */
  maxDistance?: number | undefined;
  /** Filled and returned, instead of a new array. */
  out?: number[] | undefined;
  /** Filled with the distance of each answer, in the same order. */
  distances?: number[] | undefined;
  /** Called for each answer, the nearest first, instead of collecting them; `false` ends the search. */
  visit?: ((id: number, distance: number) => unknown) | undefined;
}

/** What a ray hits. */
export interface RayHit {
  /** The id of the box. */
  id: number;
  /** From the origin to the box, in units of the world; 0 if the ray starts at its face or inside. */
  distance: number;
  /** The normal of the face that was hit, against the ray: one number per axis, -1, 0 or 1; all 0 if the ray starts inside. */
  normal: number[];
}

/** Options of {@link BroadPhase.rayCast}. */
export interface RayOptions extends QueryOptions {
  /** How far the ray reaches, at least 0. Default: no limit. */
  maxDistance?: number | undefined;
  /**
   * Whether a hit counts: called for each hit, from the first on, until it returns true. The hit is the object that
   * will be returned.
   */
  accept?: ((id: number, hit: Readonly<RayHit>) => boolean) | undefined;
  /** Filled and returned, instead of a new object. */
  out?: RayHit | undefined;
}

/** Options of {@link BroadPhase.rayCastAll}. */
export interface RayAllOptions extends QueryOptions {
  /** How far the ray reaches, at least 0. Default: no limit. */
  maxDistance?: number | undefined;
  /** Filled and returned instead of a new array; the objects in it are reused. */
  out?: RayHit[] | undefined;
  /**
   * Called for each answer, from the first on, instead of collecting them; `false` ends the search. The hit is the same
   * object each time.
   */
  visit?: ((id: number, distance: number, hit: Readonly<RayHit>) => unknown) | undefined;
}

/** What a moving box hits. */
export interface SweepHit {
  /** The id of the box. */
  id: number;
  /**
   * The fraction of the motion, 0 … 1, until they touch; 0 if they touch or overlap from the start. It is rounded
   * towards the start: `maxX + dx * time` is never beyond the face.
   */
  time: number;
  /** The normal of the face that was hit, against the motion: as in {@link RayHit}. */
  normal: number[];
}

/** Options of {@link BroadPhase.sweep}: `accept` or `visit`, not both. */
export type SweepOptions = QueryOptions & {
  /** Filled and returned, instead of a new object. */
  out?: SweepHit | undefined;
} & (
    | {
        /**
         * Whether a hit counts: called for each hit, by time, until it returns true. The hit is the object that will be
         * returned.
         */
        accept?: ((id: number, hit: Readonly<SweepHit>) => boolean) | undefined;
        /** Not with `accept`. */
        visit?: undefined;
      }
    | {
        /**
         * Called for each box on the path, by time, instead of returning the first; `false` ends the search. The hit is
         * the same object each time. Without `accept`: a visitor sees all hits.
         */
        visit?: ((id: number, time: number, hit: Readonly<SweepHit>) => unknown) | undefined;
        /** Not with `visit`. */
        accept?: undefined;
      }
  );

/** Answers to many queries. */
export interface ManyIds {
  /** The ids: the answers to query k are from `offsets[k]` up to `offsets[k + 1] - 1`. */
  ids: Uint32Array;
  /** One more than there are queries: the last is the number of all answers. */
  offsets: Uint32Array;
}

/** Answers to {@link BroadPhase.nearests}. */
export interface ManyNearest extends ManyIds {
  /** The distance of each answer, in units of the world. */
  distances: Float64Array;
}

/** Answers to {@link BroadPhase.nearestsOfAll}. */
export interface ManyNearestOfAll extends ManyNearest {
  /** The ids of the boxes whose neighbours are listed. */
  of: Uint32Array;
}

/** Answers to {@link BroadPhase.rayCasts}. */
export interface ManyRayHits extends ManyNearest {
  /** The normals of all answers, one number per axis: as in {@link RayHit}. */
  normals: Int8Array;
}

/** Answers to {@link BroadPhase.sweeps}. */
export interface ManySweepHits extends ManyIds {
  /** The time of each answer: as in {@link SweepHit}. */
  times: Float64Array;
  /** The normals of all answers, one number per axis: as in {@link SweepHit}. */
  normals: Int8Array;
}

/** Options of many queries. */
export interface ManyOptions<Answer = ManyIds> {
  /**
   * Only boxes on a layer in this mask: 32 bits, as for `setFilter`. Default: all bits, and so all boxes, even those on
   * no layer.
   */
  mask?: number | undefined;
  /** For each query a box to leave out of its answers, usually the one that asks; any id, in use or not. */
  ignoreEach?: Uint32Array | readonly number[] | undefined;
  /** The result of an earlier call, which is filled and returned; arrays that are too short are replaced. */
  out?: Answer | undefined;
}

/** Options of many queries about places. */
export interface ManyAreaOptions extends ManyOptions, AreaOptions {}

/** Options of {@link BroadPhase.queryBoxes}. */
export interface ManyBoxOptions extends ManyAreaOptions {
  /** Whether boxes must be wholly inside; they may touch the sides, unless `touching` is false. Default false. */
  within?: boolean | undefined;
}

/** Options of many queries with a maximum distance. */
export interface ManyFarOptions<Answer> extends ManyOptions<Answer> {
  /** The largest distance of each, at least 0. Default: no limit. */
  maxDistance?: number | undefined;
}

/** The mask for all boxes. */
export const everything = 0xffffffff;
/** Instead of an id. */
export const nobody = 0xffffffff;

export function maskOf(where: string, mask = everything): number {
  if (mask !== everything) checkBits(`${where}: mask`, mask);
  return mask;
}

/** The one box that is ignored; `nobody` if there is none, or several: see `othersIgnored`. */
function ignoredOf(where: string, ignore: QueryOptions['ignore']): number {
  if (ignore === undefined) return nobody;
  if (!Array.isArray(ignore)) {
    if (isId(ignore)) return ignore;
    where += ': ignore';
    if (typeof ignore === 'object' && ignore) badValue(where, ignore, 'an id, or an ordinary array of ids', true);
    badId(where, ignore);
  }
  for (let k = 0; k < ignore.length; k++) if (!isId(ignore[k])) badId(`${where}: ignore[${k}]`, ignore[k]);
  return ignore.length === 1 ? ignore[0] : nobody;
}

/** Checks an option that is true or false. The text is made only for an error: a string in each call would be garbage. */
export function checkSwitch(where: string, name: string, value: unknown): void {
  if (typeof value !== 'boolean') checkBoolean(`${where}: ${name}`, value);
}

function checkCallback(where: string, name: string, value: unknown): void {
  if (value !== undefined && typeof value !== 'function') badValue(`${where}: ${name}`, value, 'a function', true);
}

/** All options of queries with one thing. Each kind has some of them. */
type AnyOptions = QueryOptions &
  AreaOptions & {
    maxDistance?: number | undefined;
    within?: boolean | undefined;
    out?: unknown;
    distances?: unknown;
    visit?: unknown;
    accept?: unknown;
  };

/** The options of the query that is being asked. One object for all queries, to make no garbage. */
const asked = {
  mask: 0,
  ignored: 0,
  /** The ignored boxes, if there are several. */
  others: undefined as readonly number[] | undefined,
  out: undefined as unknown,
  distances: undefined as unknown,
  visit: undefined as unknown,
  accept: undefined as unknown,
};
export type Asked = typeof asked;

/** Called once all options are read, so that none of them stays in memory until the next query. */
export function release(): void {
  asked.others = asked.out = asked.distances = asked.visit = asked.accept = undefined;
}

/** The options of a query without any. */
function defaults(instance: KernelInstance): Asked {
  release();
  asked.mask = asked.ignored = -1; // all bits
  const io = instance.io();
  io[touchingAt] = Number(instance.touching);
  io[radiusAt] = noCircle;
  io[limitAt] = Number.POSITIVE_INFINITY;
  return asked;
}

/**
 * Reads each option once; then writes to the io array what concerns the kernel. A getter among them may have asked a
 * query itself. So callers write their own numbers to the io array after this call, and nothing of theirs runs before
 * the kernel is asked.
 */
export function readOptions(
  instance: KernelInstance,
  where: string,
  options: AnyOptions | undefined,
  names: readonly string[],
): Asked {
  if (options === undefined) return defaults(instance);
  checkOptions(where, options, names);
  const {
    mask,
    ignore,
    touching = instance.touching,
    within: wholly = false,
    maxDistance = Number.POSITIVE_INFINITY,
    out,
    distances,
    visit,
    accept,
  }: AnyOptions = options;
  checkSwitch(where, 'touching', touching);
  checkSwitch(where, 'within', wholly);
  if (!isSize(maxDistance)) checkDistance(`${where}: maxDistance`, maxDistance);
  checkCallback(where, 'visit', visit);
  checkCallback(where, 'accept', accept);
  const bits = maskOf(where, mask);
  const one = ignoredOf(where, ignore);
  asked.others = typeof ignore === 'object' && ignore.length > 1 ? ignore : undefined;
  asked.mask = bits | 0; // as integers: doubles would be garbage
  asked.ignored = one | 0;
  asked.out = out;
  asked.distances = distances;
  asked.visit = visit;
  asked.accept = accept;
  const io = instance.io();
  io[touchingAt] = Number(touching);
  io[radiusAt] = wholly ? within : noCircle;
  io[limitAt] = maxDistance;
  return asked;
}

/** The options of each kind of query. */
export const idsOptions = ['mask', 'ignore', 'out', 'visit', 'touching'] as const;
export const boxOptions = [...idsOptions, 'within'] as const;
export const farOptions = ['mask', 'ignore', 'maxDistance', 'out', 'visit'] as const;
export const nearestOptions = [...farOptions, 'distances'] as const;
export const rayOptions = ['mask', 'ignore', 'maxDistance', 'out', 'accept'] as const;
export const sweepOptions = ['mask', 'ignore', 'out', 'visit', 'accept'] as const;

/** Whether a value is a good limit for the number of answers. */
export const isCount = (k: unknown): k is number =>
  (Number.isInteger(k) && Number(k) >= 1) || k === Number.POSITIVE_INFINITY;

/** That limit, as the kernel counts. */
export function checkMost(where: string, k: unknown): number {
  if (!isCount(k)) badNumber(`${where}: k`, k, 'an integer from 1 on, or Infinity');
  return Math.min(k, everything);
}
