// A 2D query took up to four arguments more than it has, if they were undefined; 3D queries and `set` took none.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';

describe.each([2, 3] as const)('in %d dimensions', (dimensions) => {
  const point = new Array<number>(dimensions).fill(0);
  const box = [...point, ...point.map(() => 1)];
  const round = dimensions === 2 ? 'queryCircle' : 'querySphere';
  const space = new BroadPhase({ dimensions });
  const ask = space as unknown as Record<string, (...given: unknown[]) => unknown>;
  ask.set!(7, ...box);
  space.update();

  test.each<[string, unknown[]]>([
    ['queryBox', box],
    ['queryPoint', point],
    [round, [...point, 1]],
    ['queryPlanes', [[]]],
    ['rayCast', [...point, ...box.slice(dimensions)]],
    ['rayCastAll', [...point, ...box.slice(dimensions)]],
    ['sweep', [...box, ...point]],
    ['nearest', [...point, 1]],
    ['queryBoxes', [[]]],
    ['nearests', [[], 1]],
    ['nearestsOfAll', [1]],
  ])('%s takes undefined in the place of its options, and nothing after them', (name, given) => {
    expect(ask[name]!(...given, undefined)).toEqual(ask[name]!(...given));
    const most = given.length + 1;
    for (const more of [[undefined], [undefined, undefined], [{}], new Array(9).fill(undefined)]) {
      expect(() => ask[name]!(...given, undefined, ...more)).toThrow(
        new TypeError(`${name}: got ${most + more.length} arguments, expected at most ${most} in ${dimensions}D`),
      );
    }
  });

  test.each<[string, unknown[]]>([
    ['isColliding', [7, 7]],
    ['collisionsOf', [7, []]],
  ])('%s', (name, given) => {
    ask[name]!(...given);
    expect(() => ask[name]!(...given, undefined)).toThrow(
      new TypeError(`${name}: got 3 arguments, expected at most 2 in ${dimensions}D`),
    );
  });

  test.each<[string, unknown[]]>([
    ['set', [7, ...box]],
    ['setSwept', [7, ...box, ...point]],
    ['setCentred', [7, ...box]],
  ])('%s takes nothing after its numbers', (name, given) => {
    expect(() => ask[name]!(...given, undefined)).toThrow(
      `${name}: got ${given.length + 1} arguments for box 7, expected ${given.length} in ${dimensions}D: id, `,
    );
  });
});
