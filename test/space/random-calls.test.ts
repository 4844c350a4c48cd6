// Every method in any order, bad arguments mixed in, against a model: fast-check makes up the calls and makes those that
// fail fewer. The model is a Map of what each box was given, and what the last update saw.
// The seed stands in the name of the suite and in the report of a failure: SEED=… runs it again, RUNS=… runs more.
import { BroadPhase, type ManyIds, type ManyNearest, type ManySweepHits } from 'broadphase';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { expectKeys } from '../support/expect-pairs.ts';
import { type Entry, pairsOf } from '../support/model.ts';
import { ahead, inBox, inCircle, near } from '../support/query-reference.ts';
import { keyOf } from '../support/reference.ts';
import { runs, seed } from '../support/runs.ts';
import { setBox } from '../support/set-box.ts';

const numRuns = runs(150);
const all = 0xffffffff;

type Loose = Record<string, (...given: unknown[]) => unknown>;

interface Model {
  entries: Map<number, Entry>;
  /** Deleted since the last update. */
  gone: Set<number>;
  /** The keys of the pairs of the last update: of this space, and of the one that was saved. */
  shown: Set<number>;
  before: Set<number>;
  began: number[];
  ended: number[];
  /** What questions see: what stood there at the last update, whether or not one was asked before. */
  seen: Map<number, Entry>;
  /** What `boxes()` gave, while its rows stand for the ids 0, 1, 2, …. */
  view: Float32Array | undefined;
  saved?: Pick<Model, 'entries' | 'gone' | 'before' | 'began' | 'ended'> & { bytes: Uint8Array };
}

const copy = (entries: ReadonlyMap<number, Entry>) => new Map([...entries].map(([id, entry]) => [id, { ...entry }]));
const ascending = (numbers: Iterable<number>) => [...numbers].sort((a, b) => a - b);

class Call implements fc.Command<Model, BroadPhase> {
  readonly #name: string;
  readonly run: (model: Model, space: BroadPhase<2 | 3>) => void;
  constructor(name: string, run: (model: Model, space: BroadPhase<2 | 3>) => void) {
    this.#name = name;
    this.run = run;
  }
  check = () => true;
  toString = () => this.#name;
}

function put(model: Model, id: number, box: number[]): void {
  const known = model.entries.get(id);
  model.entries.set(id, { layer: all, mask: all, isStatic: false, ...known, box });
}

function replace(model: Model, boxes: readonly number[][]): void {
  for (const id of [...model.entries.keys()]) {
    if (id < boxes.length) continue;
    model.entries.delete(id);
    model.gone.add(id);
  }
  boxes.forEach((box, id) => {
    put(model, id, box);
  });
}

function update(model: Model, space: BroadPhase<2 | 3>): void {
  expect(space.update()).toBe(space);
  const { dimensions } = space;
  const keys = pairsOf(model.entries, dimensions);
  expectKeys(space, keys);
  const now = new Set(keys);
  const isGone = (key: number) => model.gone.has(Math.floor(key / 2 ** 24)) || model.gone.has(key % 2 ** 24);
  model.began = ascending([...now].filter((key) => !model.before.has(key) || isGone(key)));
  model.ended = ascending([...model.before].filter((key) => !now.has(key) || isGone(key)));
  expectEvents(model, space);
  model.shown = model.before = now;
  model.gone = new Set();
  model.seen = copy(model.entries);
  expect(space.stats.pairs).toBe(space.pairCount);
  space.validate();
}

function expectEvents(model: Model, space: BroadPhase<2 | 3>): void {
  const keysIn = (pairs: Uint32Array) =>
    ascending(Array.from({ length: pairs.length / 2 }, (_, k) => keyOf(pairs[2 * k], pairs[2 * k + 1])));
  expect(keysIn(space.began)).toEqual(model.began);
  expect(keysIn(space.ended)).toEqual(model.ended);
}

const seen = (model: Model) => model.seen;

const anId = fc.oneof(
  { weight: 12, arbitrary: fc.nat(25) },
  { weight: 1, arbitrary: fc.constantFrom(4095, 4096, 70_000, 2 ** 24 - 1) },
);
const aPlace = fc.oneof(
  { weight: 10, arbitrary: fc.integer({ min: -8, max: 8 }) },
  { weight: 2, arbitrary: fc.integer({ min: -80, max: 80 }).map((tenths) => tenths / 10) },
  { weight: 1, arbitrary: fc.constantFrom(-0, 1e9, -1e9, 1e-30, 5e-324, 1e39, -1e300) },
);
const anEnd = fc.oneof(
  { weight: 12, arbitrary: aPlace },
  { weight: 1, arbitrary: fc.constantFrom(-Infinity, Infinity) },
);
const bits = fc.constantFrom(all, 1, 2, 3, 0, 0x80000000);
const asked = fc.record({ mask: fc.constantFrom(all, 1, 2, 0x80000000), ignore: fc.nat(25) }, { requiredKeys: [] });

/** No number, or none that a box or a place may have. */
const noNumber = fc.constantFrom<unknown>(Number.NaN, undefined, null, '1', {}, [], true, 1n, Symbol('s'));
const noId = fc.constantFrom<unknown>(-1, 2 ** 24, 0.5, Number.NaN, Infinity, '3', null, undefined, {}, 2n, true);
const noBits = fc.constantFrom<unknown>(-1, 2 ** 32, 0.5, Number.NaN, '3', null, undefined, {}, 1n);
const noBytes = fc.oneof(
  fc.constantFrom<unknown>(undefined, null, 5, 'snapshot', {}, [1, 2, 3]),
  fc.uint8Array({ maxLength: 200 }),
);

function commands(dimensions: 2 | 3): fc.Arbitrary<fc.Command<Model, BroadPhase>>[] {
  const tuple = <T>(arbitrary: fc.Arbitrary<T>, length: number) =>
    fc.array(arbitrary, { minLength: length, maxLength: length });
  const boxFrom = (ends: number[][]) => [
    ...ends.map(([a, b]) => Math.min(a!, b!)),
    ...ends.map(([a, b]) => Math.max(a!, b!)),
  ];
  const aBox = tuple(tuple(anEnd, 2), dimensions).map(boxFrom);
  const aPoint = tuple(aPlace, dimensions);
  const aWay = tuple(
    fc.oneof(
      fc.constantFrom(0, 1, -1),
      fc.integer({ min: -40, max: 40 }).map((halves) => halves / 2),
    ),
    dimensions,
  );
  const call = (name: string, run: (model: Model, space: BroadPhase<2 | 3>) => void) => new Call(name, run);
  const on = (space: BroadPhase<2 | 3>) => space as unknown as Loose;
  const show = (values: readonly unknown[]) => values.map((value) => fc.stringify(value)).join(', ');
  const round = dimensions === 2 ? 'queryCircle' : 'querySphere';
  const rowOf = (model: Model, id: number) => [...model.view!.subarray(id * 2 * dimensions, (id + 1) * 2 * dimensions)];

  /** A call that must throw and change nothing. */
  const bad = (method: string, given: fc.Arbitrary<unknown[]>) =>
    given.map((values) =>
      call(`${method}(${show(values)}) is refused`, (_, space) => {
        const before = space.snapshot();
        const { technique } = space;
        let thrown: unknown;
        try {
          on(space)[method](...values);
        } catch (error) {
          thrown = error;
        }
        if (!(thrown instanceof RangeError || thrown instanceof TypeError)) expect.fail(`it threw ${String(thrown)}`);
        expect(thrown.message).toMatch(new RegExp(`^${method}: `));
        expect(space.technique).toBe(technique);
        expect(Buffer.compare(space.snapshot(), before)).toBe(0);
      }),
    );
  /** Good values, one of which is replaced by a bad one. */
  const spoilt = (good: fc.Arbitrary<unknown[]>, first: number, wrong: fc.Arbitrary<unknown>) =>
    fc
      .tuple(good, fc.nat(), wrong)
      .map(([values, at, value]) => values.with(first + (at % (values.length - first)), value));
  const withId = (values: fc.Arbitrary<unknown[]>) => fc.tuple(anId, values).map(([id, more]) => [id, ...more]);
  const reversed = fc.tuple(anId, aPoint).map(([id, low]) => [id, ...low.map((x) => x + 1 + Math.abs(x)), ...low]);

  return [
    fc.tuple(anId, aBox).map(([id, box]) =>
      call(`set(${id}, ${show(box)})`, (model, space) => {
        expect(setBox(space, id, box)).toBe(space);
        put(model, id, box);
      }),
    ),
    fc.tuple(anId, aBox, aWay).map(([id, box, way]) =>
      call(`setSwept(${show([id, ...box, ...way])})`, (model, space) => {
        expect(on(space).setSwept(id, ...box, ...way)).toBe(space);
        const bounds = box.map(
          (x, k) => x + (k < dimensions ? Math.min(way[k]!, 0) : Math.max(way[k - dimensions]!, 0)),
        );
        put(model, id, bounds);
      }),
    ),
    fc
      .tuple(fc.array(aBox, { maxLength: 20 }), fc.constantFrom('array', 'doubles', 'floats', 'boxes'))
      .map(([given, how]) =>
        call(`setAll(${how} ${show(given.flat())})`, (model, space) => {
          const floats = how === 'floats' || how === 'boxes';
          const boxes = floats ? given.map((box) => box.map(Math.fround)) : given;
          const flat = boxes.flat();
          model.view = undefined;
          if (how === 'boxes') {
            model.view = space.boxes(boxes.length);
            model.view.set(flat);
          } else
            space.setAll(how === 'array' ? flat : how === 'floats' ? Float32Array.from(flat) : Float64Array.from(flat));
          replace(model, boxes);
          expect(space.size).toBe(boxes.length);
        }),
      ),
    fc.nat(30).map((count) =>
      call(`boxes(${count})`, (model, space) => {
        const { entries } = model;
        const nothing = Array<number>(2 * dimensions).fill(0);
        replace(
          model,
          Array.from({ length: count }, (_, id) => (entries.get(id)?.box ?? nothing).map(Math.fround)),
        );
        model.view = space.boxes(count);
        for (let id = 0; id < count; id++) expect(rowOf(model, id)).toEqual(entries.get(id)!.box);
      }),
    ),
    ...[1, 2].map(() =>
      fc.tuple(fc.nat(30), aBox).map(([id, box]) =>
        call(`view[${id}] = ${show(box)}`, (model) => {
          if (!model.view || id >= model.view.length / (2 * dimensions)) return;
          // A fraction that no other call gives: what is shown already, when it is written again, is no change.
          const floats = box.map((x) => Math.fround(x + 1 / 1024));
          const shown = rowOf(model, id);
          model.view.set(floats, id * 2 * dimensions);
          const its = model.entries.get(id)!;
          its.box = its.box.map((x, k) => (floats[k] === shown[k] ? x : floats[k]!));
          for (let a = 0; a < dimensions; a++) {
            if (its.box[a]! <= its.box[a + dimensions]!) continue;
            its.box[a] = floats[a]!;
            its.box[a + dimensions] = floats[a + dimensions]!;
          }
        }),
      ),
    ),
    anId.map((id) =>
      call(`delete(${id})`, (model, space) => {
        model.view = undefined;
        const had = model.entries.delete(id);
        if (had) model.gone.add(id);
        expect(space.delete(id)).toBe(had);
      }),
    ),
    anId.map((id) =>
      call(`get(${id})`, (model, space) => {
        expect(space.has(id)).toBe(model.entries.has(id));
        expect(space.get(id, [])).toEqual(model.entries.get(id)?.box);
        expect(space.size).toBe(model.entries.size);
      }),
    ),
    fc.constant(
      call('clear()', (model, space) => {
        space.clear();
        replace(model, []);
        model.view = undefined;
      }),
    ),
    fc.tuple(anId, bits, bits).map(([id, layer, mask]) =>
      call(`setFilter(${id}, ${layer}, ${mask})`, (model, space) => {
        const known = model.entries.get(id);
        if (known) Object.assign(known, { layer, mask });
        if (known) expect(space.setFilter(id, layer, mask)).toBe(space);
        else expect(() => space.setFilter(id, layer, mask)).toThrow(`setFilter: there is no box ${id}`);
      }),
    ),
    fc.tuple(anId, fc.boolean()).map(([id, isStatic]) =>
      call(`setStatic(${id}, ${isStatic})`, (model, space) => {
        const known = model.entries.get(id);
        if (known) known.isStatic = isStatic;
        if (known) expect(space.setStatic(id, isStatic)).toBe(space);
        else expect(() => space.setStatic(id, isStatic)).toThrow(`setStatic: there is no box ${id}`);
      }),
    ),
    fc.tuple(anId, fc.boolean()).map(([id, enabled]) =>
      call(`setEnabled(${id}, ${enabled})`, (model, space) => {
        const known = model.entries.get(id);
        if (known) known.isOff = !enabled;
        if (known) expect(space.setEnabled(id, enabled)).toBe(space);
        else expect(() => space.setEnabled(id, enabled)).toThrow(`setEnabled: there is no box ${id}`);
        expect(space.isEnabled(id)).toBe(known !== undefined && enabled);
      }),
    ),
    fc.constantFrom(...BroadPhase.techniques).map((technique) =>
      call(`technique = ${technique}`, (_, space) => {
        space.technique = technique;
        expect(space.technique).toBe(technique);
      }),
    ),
    ...[1, 2, 3].map(() => fc.constant(call('update()', update))),
    fc.tuple(anId, anId).map(([a, b]) =>
      call(`collisionsOf(${a}), isColliding(${a}, ${b})`, (model, space) => {
        const partners = [...model.shown].flatMap((key) => {
          const [low, high] = [Math.floor(key / 2 ** 24), key % 2 ** 24];
          return low === a ? [high] : high === a ? [low] : [];
        });
        expect(ascending(space.collisionsOf(a))).toEqual(ascending(partners));
        expect(space.isColliding(a, b)).toBe(partners.includes(b));
      }),
    ),
    fc.tuple(aBox, asked).map(([box, options]) =>
      call(`queryBox(${show([...box, options])})`, (model, space) => {
        expect(ascending(on(space).queryBox(...box, options) as number[])).toEqual(inBox(seen(model), box, options));
      }),
    ),
    fc.tuple(aPoint, fc.constantFrom(0, 1, 5, 100, Infinity), asked).map(([point, radius, options]) =>
      call(`${round}(${show([...point, radius, options])})`, (model, space) => {
        const found = on(space)[round](...point, radius, options) as number[];
        expect(ascending(found)).toEqual(inCircle(seen(model), point, radius, options));
        const at = ascending(on(space).queryPoint(...point, options) as number[]);
        expect(at).toEqual(inBox(seen(model), [...point, ...point], options));
      }),
    ),
    fc.tuple(aPoint, fc.constantFrom(1, 2, 7, 1000), asked).map(([point, k, options]) =>
      call(`nearest(${show([...point, k, options])})`, (model, space) => {
        const expected = near(seen(model), point, k, options).map(({ id }) => id);
        expect(on(space).nearest(...point, k, options)).toEqual(expected);
      }),
    ),
    fc.tuple(aBox, aWay, asked).map(([box, way, options]) =>
      call(`sweep(${show([...box, ...way, options])})`, (model, space) => {
        const [first] = ahead(seen(model), box, way, 1, options);
        const hit = on(space).sweep(...box, ...way, options) as { id: number; time: number } | undefined;
        expect(hit?.id).toBe(first?.id);
        expect(hit?.time).toBe(first?.rank);
      }),
    ),
    fc.tuple(aPoint, aWay, asked).map(([point, way, options]) =>
      call(`rayCast(${show([...point, ...way, options])})`, (model, space) => {
        const hits = on(space).rayCastAll(...point, ...way, options) as { id: number; distance: number }[];
        const first = on(space).rayCast(...point, ...way, options) as { id: number; distance: number } | undefined;
        expect(first).toEqual(hits[0]);
        const met = ahead(seen(model), [...point, ...point], way, Infinity, options, Math.hypot(...way)).map(
          ({ id }) => id,
        );
        expect(ascending(hits.map(({ id }) => id))).toEqual(ascending(met));
      }),
    ),
    fc
      .tuple(fc.array(fc.tuple(aBox, aPoint, aWay, fc.nat(9)), { maxLength: 6 }), fc.constantFrom(1, 3, 100), asked)
      .map(([questions, k, { mask }]) =>
        call(`many questions: ${show([questions.flat(2), k, mask])}`, (model, space) => {
          const options = mask === undefined ? {} : { mask };
          const many = <Answer>(method: string, numbers: number[], ...more: number[]) =>
            on(space)[method](numbers, ...more, options) as Answer & ManyIds;
          const of = ({ ids, offsets }: ManyIds, n: number) => [...ids.subarray(offsets[n], offsets[n + 1])];
          const inBoxes = many(
            'queryBoxes',
            questions.flatMap(([box]) => box),
          );
          const atPoints = many(
            'queryPoints',
            questions.flatMap(([, point]) => point),
          );
          const inCircles = many(
            'queryCircles',
            questions.flatMap(([, point, , radius]) => [...point, radius]),
          );
          const nearests = many<ManyNearest>(
            'nearests',
            questions.flatMap(([, point]) => point),
            k,
          );
          const rays = many(
            'rayCasts',
            questions.flatMap(([, point, way]) => [...point, ...way]),
          );
          const sweeps = many<ManySweepHits>(
            'sweeps',
            questions.flatMap(([box, , way]) => [...box, ...way]),
          );
          questions.forEach(([box, point, way, radius], n) => {
            expect(ascending(of(inBoxes, n))).toEqual(inBox(seen(model), box, options));
            expect(ascending(of(atPoints, n))).toEqual(inBox(seen(model), [...point, ...point], options));
            expect(ascending(of(inCircles, n))).toEqual(inCircle(seen(model), point, radius, options));
            expect(of(nearests, n)).toEqual(near(seen(model), point, k, options).map(({ id }) => id));
            const first = on(space).rayCast(...point, ...way, options) as { id: number } | undefined;
            expect(of(rays, n)).toEqual(first ? [first.id] : []);
            const met = ahead(seen(model), box, way, 1, options).slice(0, 1);
            expect(of(sweeps, n)).toEqual(met.map(({ id }) => id));
            expect([...sweeps.times.subarray(sweeps.offsets[n], sweeps.offsets[n + 1])]).toEqual(
              met.map(({ rank }) => rank),
            );
          });
          const others = space.nearestsOfAll(k, options);
          const asking = [...seen(model)].filter(([, { isOff }]) => !isOff);
          expect(ascending(others.of)).toEqual(ascending(seen(model).keys()));
          for (const [id, { box }] of asking) {
            const n = others.of.indexOf(id);
            const rest = inBox(seen(model), box, { ...options, ignore: id });
            const apart = [...others.distances.subarray(others.offsets[n], others.offsets[n + 1])];
            expect(apart.filter((distance) => distance === 0).length).toBe(Math.min(k, rest.length));
            expect(apart).toEqual(apart.toSorted((a, b) => a - b));
          }
        }),
      ),
    fc.constant(
      call('structure()', (_, space) => {
        const cells = space.structure();
        expect(cells.length % (2 * dimensions)).toBe(0);
        space.validate();
      }),
    ),
    fc.constant(
      call('snapshot()', (model, space) => {
        const { entries, gone, before, began, ended } = model;
        model.saved = { bytes: space.snapshot(), entries: copy(entries), gone: new Set(gone), before, began, ended };
      }),
    ),
    fc.constant(
      call('restore(what was saved)', (model, space) => {
        const { saved } = model;
        if (!saved) return;
        expect(space.restore(saved.bytes)).toBe(space);
        model.view = undefined;
        model.entries = copy(saved.entries);
        model.gone = new Set(saved.gone);
        model.before = saved.before;
        model.began = saved.began;
        model.ended = saved.ended;
        model.seen = copy(saved.entries);
        const keys = pairsOf(model.entries, dimensions);
        expectKeys(space, keys);
        expectEvents(model, space);
        model.shown = new Set(keys);
        expect(Buffer.compare(space.snapshot(), saved.bytes)).toBe(0);
      }),
    ),
    fc.tuple(fc.nat(), fc.nat(7)).map(([at, bit]) =>
      call(`restore(what was saved, but for bit ${bit} of byte ${at})`, (model, space) => {
        if (!model.saved) return;
        const bytes = model.saved.bytes.slice();
        bytes[at % bytes.length]! ^= 1 << bit;
        expect(() => space.restore(bytes)).toThrow(/^restore: /);
      }),
    ),

    bad('set', spoilt(withId(aBox), 1, noNumber)),
    bad(
      'set',
      fc.tuple(noId, aBox).map(([id, box]) => [id, ...box]),
    ),
    bad('set', fc.oneof(reversed, withId(aPoint), withId(tuple(aPlace, 2 * dimensions + 1)))),
    bad('setSwept', spoilt(withId(fc.tuple(aBox, aWay).map((parts) => parts.flat())), 1, noNumber)),
    bad(
      'setAll',
      spoilt(aBox, 0, noNumber).map((box) => [box]),
    ),
    bad(
      'setAll',
      fc.oneof(
        fc.constantFrom<unknown[]>([], [5], ['boxes'], [null], [[1, 2, 3]]),
        aBox.map((box) => [box, 2]),
      ),
    ),
    bad('boxes', fc.constantFrom<unknown[]>([], [-1], [0.5], [2 ** 24 + 1], ['3'], [Number.NaN], [{}])),
    bad('delete', tuple(noId, 1)),
    bad('has', tuple(noId, 1)),
    bad('get', tuple(noId, 1)),
    bad('setFilter', fc.tuple(noId, bits, bits)),
    bad('setFilter', spoilt(fc.tuple(anId, bits, bits), 1, noBits)),
    bad('setStatic', fc.oneof(tuple(noId, 1), fc.tuple(anId, fc.constantFrom<unknown>(1, 'yes', null, {})))),
    bad(
      'setEnabled',
      fc.oneof(fc.tuple(noId, fc.boolean()), fc.tuple(anId, fc.constantFrom<unknown>(1, undefined, null))),
    ),
    bad('isColliding', fc.oneof(fc.tuple(noId, anId), fc.tuple(anId, noId))),
    bad('collisionsOf', fc.oneof(tuple(noId, 1), fc.tuple(anId, fc.constantFrom<unknown>(5, 'out', null, {})))),
    bad('queryBox', spoilt(aBox, 0, noNumber)),
    bad('queryPoint', spoilt(aPoint, 0, noNumber)),
    bad(
      round,
      spoilt(
        fc.tuple(aPoint, fc.nat(9)).map((parts) => parts.flat()),
        0,
        noNumber,
      ),
    ),
    bad(
      'nearest',
      spoilt(
        fc.tuple(aPoint, fc.integer({ min: 1, max: 9 })).map((parts) => parts.flat()),
        0,
        noNumber,
      ),
    ),
    bad(
      'rayCast',
      spoilt(
        fc.tuple(aPoint, aWay).map((parts) => parts.flat()),
        0,
        noNumber,
      ),
    ),
    bad(
      'rayCastAll',
      spoilt(
        fc.tuple(aPoint, aWay).map((parts) => parts.flat()),
        0,
        noNumber,
      ),
    ),
    bad(
      'sweep',
      spoilt(
        fc.tuple(aBox, aWay).map((parts) => parts.flat()),
        0,
        noNumber,
      ),
    ),
    ...(
      [
        ['queryBoxes', 2 * dimensions],
        ['queryPoints', dimensions],
        ['queryCircles', dimensions + 1],
        ['rayCasts', 2 * dimensions],
        ['sweeps', 3 * dimensions],
      ] as const
    ).flatMap(([method, length]) => [
      bad(
        method,
        fc
          .tuple(fc.array(fc.constant<unknown>(0), { minLength: length, maxLength: length }), fc.nat(), noNumber)
          .map(([numbers, at, value]) => [numbers.with(at % length, value)]),
      ),
      bad(method, fc.constantFrom<unknown[]>([], [[0]], ['boxes'], [[], { ignore: 1 }], [[], { out: 5 }])),
    ]),
    bad('nearests', fc.constantFrom<unknown[]>([[0], 1], [[], 0], [[]], [[], 1, { k: 1 }], [['1', 1, 1], 1])),
    bad('nearestsOfAll', fc.constantFrom<unknown[]>([], [0], [1.5], ['1'], [1, { ignoreEach: [] }])),
    bad('restore', tuple(noBytes, 1)),
    fc.constantFrom<unknown>('', 'grid', 'Auto', null, undefined, 3, {}).map((name) =>
      call(`technique = ${fc.stringify(name)} is refused`, (_, space) => {
        const { technique } = space;
        expect(() => {
          space.technique = name as 'auto';
        }).toThrow(/^technique: /);
        expect(space.technique).toBe(technique);
      }),
    ),
  ];
}

describe(`every method in any order (SEED=${seed})`, () => {
  test.each([2, 3] as const)('keeps a space true to the model, in %d dimensions', (dimensions) => {
    const technique = fc.constantFrom(...BroadPhase.techniques);
    const calls = fc.commands(commands(dimensions), { maxCommands: 100, size: 'max' });
    const property = fc.property(technique, calls, (technique, calls) => {
      const setup = () => ({
        model: {
          entries: new Map(),
          gone: new Set<number>(),
          shown: new Set<number>(),
          before: new Set<number>(),
          began: [],
          ended: [],
          seen: new Map(),
          view: undefined,
        } as Model,
        real: new BroadPhase({ dimensions, technique, events: true }),
      });
      fc.modelRun(setup, calls);
    });
    fc.assert(property, { seed, numRuns });
  });
});
