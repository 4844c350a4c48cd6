// Calls with bad arguments: each must throw, naming itself, and change nothing.
import fc from 'fast-check';
import { expect } from 'vitest';
import { call, on, type RandomCall } from './model.ts';
import { anId, aPlace, bits, noBits, noBytes, noId, noNumber, roundOf, shapes, show, tuple } from './values.ts';

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

export function badChanges(dimensions: 2 | 3): RandomCall[] {
  const { aBox, aPoint, aWay } = shapes(dimensions);
  const reversed = fc.tuple(anId, aPoint).map(([id, low]) => [id, ...low.map((x) => x + 1 + Math.abs(x)), ...low]);

  return [
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

export function badQueries(dimensions: 2 | 3): RandomCall[] {
  const { aBox, aPoint, aWay } = shapes(dimensions);
  const round = roundOf(dimensions);

  return [
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
  ];
}
