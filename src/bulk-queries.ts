// Many questions in one call: numbers of all of them in, the answers of all of them out, in typed arrays.
// The kernel answers them (kernel/questions/bulk.hpp); here they are checked, and the answers copied.
import { isNumber, known, limitAt, number, point2, point3, tooFar } from './answers.ts';
import type { Dimensions } from './dimensions.ts';
import {
  badId,
  badQuestion,
  badValue,
  checkNumberArray,
  checkOptions,
  corners,
  isId,
  maxId,
  sweep2,
  sweep3,
} from './errors.ts';
import { Queries, ray2, ray3 } from './queries.ts';
import {
  checkDistance,
  checkMost,
  type ManyAreaOptions,
  type ManyBoxOptions,
  type ManyFarOptions,
  type ManyIds,
  type ManyNearest,
  type ManyNearestOfAll,
  type ManyOptions,
  type ManyRayHits,
  type ManySweepHits,
  maskOf,
  nobody,
} from './query-options.ts';
import { isTypedArray } from './values.ts';

/** What answers have of which kind. */
type Answer = ManyIds & { distances?: Float64Array; times?: Float64Array; normals?: Int8Array; of?: Uint32Array };
type Options = ManyBoxOptions & ManyFarOptions<Answer>;

/** What the kernel is asked: see there. */
const kinds = { nearest: 0, ray: 1, way: 2, box: 3, within: 4, point: 5, circle: 6, others: 7 };

const arrays = {
  ids: Uint32Array,
  offsets: Uint32Array,
  of: Uint32Array,
  distances: Float64Array,
  times: Float64Array,
  normals: Int8Array,
};
type Part = keyof typeof arrays;

const circle2 = [...point2, 'radius'];
const circle3 = [...point3, 'radius'];
/** All boxes ask: no numbers are given. */
const nothing: readonly number[] = [];
const others = ['box'];

const isDistance = (distance: unknown): boolean => typeof distance === 'number' && distance >= 0;

const idParts: readonly Part[] = ['ids', 'offsets'];
const nearParts: readonly Part[] = [...idParts, 'distances'];
const ofParts: readonly Part[] = [...nearParts, 'of'];
const rayParts: readonly Part[] = [...nearParts, 'normals'];
const wayParts: readonly Part[] = [...idParts, 'times', 'normals'];

const idOptions = ['mask', 'ignoreEach', 'out'];
const areaOptions = [...idOptions, 'touching'];
const boxOptions = [...areaOptions, 'within'];
const farOptions = [...idOptions, 'maxDistance'];
const ofAllOptions = ['mask', 'maxDistance', 'out'];

/** A space that answers many questions at once. */
export abstract class BulkQueries<D extends Dimensions> extends Queries<D> {
  /**
   * The boxes in each of many boxes, as `queryBox` answers each: those of question k are `ids[offsets[k]]` up to
   * `ids[offsets[k + 1] - 1]`. One call for all, and no array for each.
   *
   * @param boxes the numbers of each, minima first, one box behind the other
   * @param options `ignoreEach[k]` is left out of the answers of question k; an `out` is filled and returned: the answer of
   *   an earlier call, whose arrays are kept while they are long enough, and may then be longer than the answers
   * @throws as all questions do, naming the number of the question: see {@link BroadPhase}
   *
   * @example
   * const space = new BroadPhase().setAll([0, 0, 10, 10, 5, 5, 15, 15]);
   * space.update();
   * const { ids, offsets } = space.queryBoxes([8, 8, 9, 9, 30, 30, 40, 40, 12, 12, 13, 13]);
   * offsets; // → Uint32Array [0, 2, 2, 3]
   * ids[2]; // → 1
   */
  queryBoxes(boxes: ArrayLike<number>, options?: ManyBoxOptions): ManyIds {
    checkOptions('queryBoxes', options, boxOptions);
    const within = options?.within ?? false;
    if (typeof within !== 'boolean') badValue('queryBoxes: within', within, 'true or false', true);
    return this.#ask(
      'queryBoxes',
      within ? kinds.within : kinds.box,
      boxes,
      corners[this.dimensions],
      idParts,
      options,
    );
  }

  /**
   * The boxes at each of many points: as {@link BroadPhase.queryBoxes}.
   *
   * @example
   * const space = new BroadPhase().set(7, 0, 0, 10, 10).update();
   * space.queryPoints([10, 3, 11, 3]).offsets; // → Uint32Array [0, 1, 1]
   */
  queryPoints(points: ArrayLike<number>, options?: ManyAreaOptions): ManyIds {
    checkOptions('queryPoints', options, areaOptions);
    return this.#ask('queryPoints', kinds.point, points, this.#place(), idParts, options);
  }

  /**
   * The boxes in each of many circles, in 3D of many spheres: of each its centre, then its radius. As
   * {@link BroadPhase.queryBoxes}.
   *
   * @example
   * const space = new BroadPhase().set(7, 0, 0, 10, 10).update();
   * space.queryCircles([13, 14, 5, 14, 14, 5]).offsets; // → Uint32Array [0, 1, 1]
   */
  queryCircles(circles: ArrayLike<number>, options?: ManyAreaOptions): ManyIds {
    checkOptions('queryCircles', options, areaOptions);
    return this.#ask('queryCircles', kinds.circle, circles, this.width === 4 ? circle2 : circle3, idParts, options);
  }

  /**
   * The first box that each of many rays meets, as `rayCast`: one answer, or none, a ray. As {@link BroadPhase.queryBoxes},
   * with the distances and the normals, of which each has one number per axis.
   *
   * @example
   * const space = new BroadPhase().set(7, 10, -5, 20, 5).update();
   * const hits = space.rayCasts([0, 0, 1, 0, 0, 0, -1, 0]);
   * hits.offsets; // → Uint32Array [0, 1, 1]
   * hits.distances; // → Float64Array [10]
   * hits.normals; // → Int8Array [-1, 0]
   */
  rayCasts(rays: ArrayLike<number>, options?: ManyFarOptions<ManyRayHits>): ManyRayHits {
    checkOptions('rayCasts', options, farOptions);
    return this.#ask('rayCasts', kinds.ray, rays, this.width === 4 ? ray2 : ray3, rayParts, options) as ManyRayHits;
  }

  /**
   * The first box that each of many moving boxes meets, as `sweep`: of each its box, then its way. As
   * {@link BroadPhase.rayCasts}.
   *
   * @example
   * const space = new BroadPhase().set(7, 21, -5, 22, 5).update();
   * space.sweeps([0, 0, 1, 1, 40, 0]).times; // → Float64Array [0.5]
   */
  sweeps(boxes: ArrayLike<number>, options?: ManyOptions<ManySweepHits>): ManySweepHits {
    checkOptions('sweeps', options, idOptions);
    return this.#ask(
      'sweeps',
      kinds.way,
      boxes,
      this.width === 4 ? sweep2 : sweep3,
      wayParts,
      options,
    ) as ManySweepHits;
  }

  /**
   * The `k` boxes nearest to each of many points, the nearest first, as `nearest`. As {@link BroadPhase.queryBoxes}, with
   * the distances.
   *
   * @example
   * const space = new BroadPhase().set(7, 0, 0, 10, 10).set(9, 15, 0, 20, 5).update();
   * const { ids, distances } = space.nearests([13, 2, 0, 2], 1);
   * ids; // → Uint32Array [9, 7]
   * distances; // → Float64Array [2, 0]
   */
  nearests(points: ArrayLike<number>, k: number, options?: ManyFarOptions<ManyNearest>): ManyNearest {
    checkOptions('nearests', options, farOptions);
    const most = checkMost('nearests', k);
    return this.#ask('nearests', kinds.nearest, points, this.#place(), nearParts, options, most) as ManyNearest;
  }

  /**
   * The `k` boxes nearest to each box, itself left out, by the distance between boxes, then by id: those of box `of[n]` are
   * `ids[offsets[n]]` up to `ids[offsets[n + 1] - 1]`. Boxes whose ids are 0 … size - 1 come in their order.
   *
   * @param k an integer from 1 on, or Infinity for all
   * @throws as {@link BroadPhase.nearests}
   *
   * @example
   * const space = new BroadPhase().setAll([0, 0, 1, 1, 5, 0, 6, 1, 8, 0, 9, 1]);
   * space.update();
   * const { of, ids, distances } = space.nearestsOfAll(1);
   * of; // → Uint32Array [0, 1, 2]
   * ids; // → Uint32Array [1, 2, 1]
   * distances; // → Float64Array [4, 2, 2]
   */
  nearestsOfAll(k: number, options?: Omit<ManyFarOptions<ManyNearestOfAll>, 'ignoreEach'>): ManyNearestOfAll {
    checkOptions('nearestsOfAll', options, ofAllOptions);
    const most = checkMost('nearestsOfAll', k);
    return this.#ask('nearestsOfAll', kinds.others, nothing, others, ofParts, options, most) as ManyNearestOfAll;
  }

  #place(): readonly string[] {
    return this.width === 4 ? point2 : point3;
  }

  /** Checks questions, whose numbers have these names, asks them, and collects the answers. */
  #ask(
    where: string,
    kind: number,
    numbers: ArrayLike<number>,
    names: readonly string[],
    parts: readonly Part[],
    options: Options | undefined,
    most = 1,
  ): Answer {
    checkNumberArray(where, numbers);
    const { length } = numbers;
    const count = length / names.length;
    if (!Number.isInteger(count))
      badValue(`${where}: length`, length, `a multiple of ${names.length}: ${names.join(', ')}`);
    if (Array.isArray(numbers)) {
      for (let k = 0; k < length; k++) {
        if (typeof numbers[k] !== 'number') badNumbers(where, numbers, Math.floor(k / names.length), names);
      }
    }
    const { ignoreEach, maxDistance = Number.POSITIVE_INFINITY, out } = options ?? {};
    const mask = maskOf(where, options);
    this.tellTouching(where, options);
    // Told apart before the text is made: a string in each call would be garbage.
    if (!isDistance(maxDistance)) checkDistance(`${where}: maxDistance`, maxDistance);
    this.#checkFar(where, kind, numbers, maxDistance);
    if (ignoreEach !== undefined) checkIgnored(where, ignoreEach, count);
    if (out !== undefined) checkAnswer(where, out, parts);
    try {
      const at = this.kernel.stage_questions(length + count) >>> 3;
      const doubles = this.doubleView();
      doubles.set(numbers, at);
      if (ignoreEach === undefined) doubles.fill(nobody, at + length, at + length + count);
      else doubles.set(ignoreEach, at + length);
      const bad = this.kernel.bad_question(kind, count);
      if (bad >= 0) badNumbers(where, numbers, bad, names);
      this.io()[limitAt] = kind === kinds.way ? 1 : maxDistance;
      const asked = known(where, this.kernel.ask_many(kind, count, mask, most));
      return this.#collect(kind, asked, parts, out);
    } catch (error) {
      this.recover(error, where);
    }
  }

  /** In a world that wraps around: rays and ways do not lead through too many. */
  #checkFar(where: string, kind: number, numbers: ArrayLike<number>, maxDistance: number): void {
    const most = this.farthest;
    if (most === Number.POSITIVE_INFINITY) return;
    if (kind === kinds.ray && maxDistance > most && maxDistance < Number.POSITIVE_INFINITY) {
      tooFar(`${where}: maxDistance`, maxDistance, most);
    }
    const each = this.width + this.dimensions;
    for (
      let k = this.width;
      kind === kinds.way && k < numbers.length;
      k += k % each === each - 1 ? this.width + 1 : 1
    ) {
      if (Math.abs(numbers[k]!) > most)
        tooFar(`${where}: question ${Math.floor(k / each)}: the way`, numbers[k]!, most);
    }
  }

  /** Copies what the kernel has found. */
  #collect(kind: number, count: number, names: readonly Part[], out: Answer | undefined): Answer {
    const words = this.wordView();
    const ends = this.kernel.offsets_address() >>> 2;
    const total = words[ends + count]!;
    const to = (out ?? {}) as Record<Part, Uint32Array | Float64Array | Int8Array>;
    for (const name of names) {
      const least =
        name === 'offsets' ? count + 1 : name === 'of' ? count : name === 'normals' ? total * this.dimensions : total;
      if (!(to[name]?.length >= least)) to[name] = new arrays[name](to[name] ? least + (least >> 1) : least);
    }
    const answer = to as unknown as Answer;
    const { ids, offsets, of } = answer;
    const ordered = kind < kinds.box || kind === kinds.others;
    const first = (ordered ? this.kernel.many_hits_address() : this.kernel.many_ids_address()) >>> 2;
    for (let k = 0; k <= count; k++) offsets[k] = words[ends + k]!;
    for (let n = 0; n < total; n++) {
      if (ordered) this.#copyHit(answer, n, first + 4 * n);
      else ids[n] = words[first + n]!;
    }
    const all = this.kernel.answers_address() >>> 2;
    if (of !== undefined) for (let k = 0; k < count; k++) of[k] = words[all + k]!;
    return answer;
  }

  /** Copies the hit in a place among the kernel's words. */
  #copyHit(to: Answer, n: number, at: number): void {
    const words = this.wordView();
    to.ids[n] = words[at + 2]! & maxId; // above it stands whether it was met at a corner
    (to.distances ?? to.times!)[n] = this.doubleView()[at >>> 1]!;
    if (to.normals === undefined) return;
    const side = words[at + 3]! | 0;
    for (let axis = 0; axis < this.dimensions; axis++) {
      to.normals[n * this.dimensions + axis] = side === axis + 1 ? 1 : side === -axis - 1 ? -1 : 0;
    }
  }
}

/** Says what is wrong with the numbers of a question. */
function badNumbers(where: string, numbers: ArrayLike<number>, k: number, names: readonly string[]): never {
  const given = Array.prototype.slice.call(numbers, k * names.length, (k + 1) * names.length);
  const what = `${where}: question ${k}`;
  const round = names.at(-1) === 'radius';
  if (round && given.every(isNumber)) checkDistance(`${what}: radius`, given.at(-1)!);
  badQuestion(what, given, round ? names.slice(0, -1) : names, number);
}

/** One id for each question. */
function checkIgnored(where: string, ids: ArrayLike<number>, count: number): void {
  where += ': ignoreEach';
  if (!isTypedArray(ids, 'Uint32Array') && !Array.isArray(ids)) badValue(where, ids, 'a Uint32Array or an array', true);
  if (ids.length !== count) badValue(`${where}: length`, ids.length, `${count}, one id for each query`);
  for (let k = 0; k < count; k++) if (!isId(ids[k])) badId(`${where}[${k}]`, ids[k]);
}

/** The answer of an earlier call of the same kind. */
function checkAnswer(where: string, out: Partial<Answer>, parts: readonly Part[]): void {
  if (typeof out !== 'object' || out === null) badValue(`${where}: out`, out, 'the answer of an earlier call', true);
  for (const part of parts) {
    const { name } = arrays[part];
    if (!isTypedArray(out[part], name)) badValue(`${where}: out.${part}`, out[part], `a ${name}`, true);
  }
}
