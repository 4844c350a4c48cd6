// Boxes that are set with their way: nothing on it is missed, and what is wrong with one is said.
import { BroadPhase } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { expectKeys } from '../support/expect-pairs.ts';
import { Modelled } from '../support/model.ts';
import { pathOf } from '../support/path-of.ts';
import { ahead } from '../support/query-reference.ts';
import { referencePairs } from '../support/reference.ts';

type SetSwept = (...given: unknown[]) => BroadPhase;
const setSwept = (space: BroadPhase<2 | 3>, ...given: unknown[]) => (space.setSwept as SetSwept).call(space, ...given);

describe.each(
  BroadPhase.techniques.flatMap((technique) => ([2, 3] as const).map((dimensions) => [technique, dimensions] as const)),
)('%s in %d dimensions', (technique, dimensions) => {
  test('the pairs of a fast box are all that its bounds touch, and all that it meets on its way are among them', () => {
    const model = new Modelled({ technique, dimensions }, 4);
    const { space } = model;
    for (let id = 1; id < 80; id++) model.set(id);
    for (let shot = 0; shot < 20; shot++) {
      const box = model.box();
      const way = Array.from({ length: dimensions }, () => model.integer(200) - 100 + 0.1 * model.integer(2));
      expect(setSwept(space, 0, ...box, ...way)).toBe(space);
      const bounds = pathOf(box, way);
      expect(Array.from(space.get(0)!)).toEqual(bounds);
      const boxes = [bounds, ...[...model.entries.values()].map((entry) => entry.box)].flat();
      expectKeys(space.update(), referencePairs(boxes, dimensions, [0, ...model.entries.keys()]));
      for (const { id } of ahead(model.entries, box, way, 1, {})) expect(space.isColliding(0, id)).toBe(true);
    }
  });
});

test('a bullet does not tunnel', () => {
  const space = new BroadPhase().set(7, 50, 0, 51, 10);
  space.setSwept(9, 0, 5, 1, 6, 100, 0).update();
  expect(Array.from(space.pairs)).toEqual([7, 9]);
  expect(space.sweep(0, 5, 1, 6, 100, 0, { ignore: 9 })).toEqual({ id: 7, time: 0.49, normal: [-1, 0] });
});

test.each([2, 3] as const)('bad boxes and ways are refused in %d dimensions', (dimensions) => {
  const space = new BroadPhase({ dimensions });
  const axes = Array.from({ length: dimensions }, () => 0);
  const good = [...axes, ...axes.map(() => 1), ...axes];
  for (const id of [-1, 2 ** 24, 1.5, '7']) expect(() => setSwept(space, id, ...good)).toThrow('setSwept: the id is');
  for (let at = 0; at < good.length; at++) {
    expect(() => setSwept(space, 1, ...good.with(at, Number.NaN))).toThrow(RangeError);
    for (const value of ['1', undefined, null]) {
      expect(() => setSwept(space, 1, ...good.with(at, value as unknown as number))).toThrow(TypeError);
    }
  }
  expect(() => setSwept(space, 1, ...good.with(0, 2))).toThrow('setSwept: minX of box 1: got 2');
  expect(() => setSwept(space, 1, ...good.with(2 * dimensions, Infinity))).toThrow(
    'setSwept: dx of box 1: got Infinity',
  );
  expect(() => setSwept(space, 1, ...good, 1)).toThrow(
    `setSwept: got ${2 + good.length} arguments for box 1, expected`,
  );
  expect(() => setSwept(space, 1, ...good.slice(1))).toThrow(TypeError);
  expect(space.size).toBe(0);
});
