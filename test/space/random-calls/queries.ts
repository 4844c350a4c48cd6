// Queries in between, which the model answers by looking at every box.
import type { ManyIds, ManyNearest, ManySweepHits } from 'broadphase';
import fc from 'fast-check';
import { expect } from 'vitest';
import { ahead, inBox, inCircle, near, nearBox } from '../../support/query-reference.ts';
import { ascending, call, on, type RandomCall } from './model.ts';
import { anId, asked, roundOf, shapes, show } from './values.ts';

/** The references answer so; spaces may not, unless they are told to. */
const touching = true;

/** One query a call. */
export function queries(dimensions: 2 | 3): RandomCall[] {
  const { aBox, aPoint, aWay } = shapes(dimensions);
  const round = roundOf(dimensions);
  return [
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
        expect(ascending(on(space).queryBox(...box, { ...options, touching }) as number[])).toEqual(
          inBox(model.seen, box, options),
        );
      }),
    ),
    fc.tuple(aPoint, fc.constantFrom(0, 1, 5, 100, Infinity), asked).map(([point, radius, options]) =>
      call(`${round}(${show([...point, radius, options])})`, (model, space) => {
        const found = on(space)[round](...point, radius, { ...options, touching }) as number[];
        expect(ascending(found)).toEqual(inCircle(model.seen, point, radius, options));
        const at = ascending(on(space).queryPoint(...point, { ...options, touching }) as number[]);
        expect(at).toEqual(inBox(model.seen, [...point, ...point], options));
      }),
    ),
    fc.tuple(aPoint, fc.constantFrom(1, 2, 7, 1000), asked).map(([point, k, options]) =>
      call(`nearest(${show([...point, k, options])})`, (model, space) => {
        const expected = near(model.seen, point, k, options).map(({ id }) => id);
        expect(on(space).nearest(...point, k, options)).toEqual(expected);
      }),
    ),
    fc.tuple(aBox, aWay, asked).map(([box, way, options]) =>
      call(`sweep(${show([...box, ...way, options])})`, (model, space) => {
        const [first] = ahead(model.seen, box, way, 1, options);
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
        const met = ahead(model.seen, [...point, ...point], way, Infinity, options, Math.hypot(...way)).map(
          ({ id }) => id,
        );
        expect(ascending(hits.map(({ id }) => id))).toEqual(ascending(met));
      }),
    ),
  ];
}

/** Many queries in one call. */
export function manyQueries(dimensions: 2 | 3): RandomCall[] {
  const { aBox, aPoint, aWay } = shapes(dimensions);
  return [
    fc
      .tuple(fc.array(fc.tuple(aBox, aPoint, aWay, fc.nat(9)), { maxLength: 6 }), fc.constantFrom(1, 3, 100), asked)
      .map(([queries, k, { mask }]) =>
        call(`many queries: ${show([queries.flat(2), k, mask])}`, (model, space) => {
          const options = mask === undefined ? {} : { mask };
          const many = <Answer>(method: string, numbers: number[], ...more: number[]) => {
            const its = method.startsWith('query') ? { ...options, touching } : options;
            return on(space)[method](numbers, ...more, its) as Answer & ManyIds;
          };
          const of = ({ ids, offsets }: ManyIds, n: number) => [...ids.subarray(offsets[n], offsets[n + 1])];
          const inBoxes = many(
            'queryBoxes',
            queries.flatMap(([box]) => box),
          );
          const atPoints = many(
            'queryPoints',
            queries.flatMap(([, point]) => point),
          );
          const inCircles = many(
            'queryCircles',
            queries.flatMap(([, point, , radius]) => [...point, radius]),
          );
          const nearests = many<ManyNearest>(
            'nearests',
            queries.flatMap(([, point]) => point),
            k,
          );
          const rays = many(
            'rayCasts',
            queries.flatMap(([, point, way]) => [...point, ...way]),
          );
          const sweeps = many<ManySweepHits>(
            'sweeps',
            queries.flatMap(([box, , way]) => [...box, ...way]),
          );
          queries.forEach(([box, point, way, radius], n) => {
            expect(ascending(of(inBoxes, n))).toEqual(inBox(model.seen, box, options));
            expect(ascending(of(atPoints, n))).toEqual(inBox(model.seen, [...point, ...point], options));
            expect(ascending(of(inCircles, n))).toEqual(inCircle(model.seen, point, radius, options));
            expect(of(nearests, n)).toEqual(near(model.seen, point, k, options).map(({ id }) => id));
            const first = on(space).rayCast(...point, ...way, options) as { id: number } | undefined;
            expect(of(rays, n)).toEqual(first ? [first.id] : []);
            const met = ahead(model.seen, box, way, 1, options).slice(0, 1);
            expect(of(sweeps, n)).toEqual(met.map(({ id }) => id));
            expect([...sweeps.times.subarray(sweeps.offsets[n], sweeps.offsets[n + 1])]).toEqual(
              met.map(({ rank }) => rank),
            );
          });
          const others = space.nearestsOfAll(k, options);
          const asking = [...model.seen].filter(([, { isOff }]) => !isOff);
          expect(ascending(others.of)).toEqual(ascending(model.seen.keys()));
          for (const [id, { box }] of asking) {
            const n = others.of.indexOf(id);
            const expected = nearBox(model.seen, box, k, { ...options, ignore: id });
            expect(of(others, n)).toEqual(expected.map(({ id }) => id));
            const distances = [...others.distances.subarray(others.offsets[n], others.offsets[n + 1])];
            expect(distances).toEqual(expected.map(({ rank }) => rank));
          }
        }),
      ),
  ];
}
