// The state of the lab in the address: it comes back as it was written, and no address asks for what the page cannot do.
import { BroadPhase } from 'broadphase';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { isScene, mostBoxes, sceneGroups } from '../../site/lab/catalog.ts';
import { defaults, type LabState, latestFrame, layers, rates, readState, writeState } from '../../site/lab/state.ts';

const names = sceneGroups.flatMap(({ scenes }) => scenes.map(([name]) => name));
const generated = names.filter((name) => /[23]d$/.test(name));

const aState: fc.Arbitrary<LabState> = fc.record({
  scene: fc.constantFrom(...generated),
  boxes: fc.integer({ min: 2, max: mostBoxes }),
  technique: fc.constantFrom(...BroadPhase.techniques),
  cell: fc.option(fc.double({ min: 1e-9, max: 1e9, noNaN: true }), { nil: undefined }),
  show: fc.subarray([...layers]),
  rate: fc.constantFrom(...rates),
  frame: fc.option(fc.integer({ min: 0, max: 400 }), { nil: undefined }),
  view: fc.option(fc.constantFrom([0.5, 0.25, 8], [0.1, -2.5, 1, 0, 0, 0.125]), { nil: undefined }),
  box: fc.option(fc.integer({ min: 0, max: 2 ** 24 - 1 }), { nil: undefined }),
  race: fc.option(fc.subarray([...BroadPhase.techniques]), { nil: undefined }),
});

test('comes back as it was written', () => {
  fc.assert(
    fc.property(aState, (state) => {
      expect(readState(writeState(state))).toEqual({ state, faults: [] });
    }),
  );
});

test('an address that says nothing shows the defaults', () => {
  expect(readState('')).toEqual({ state: defaults, faults: [] });
});

describe('what does not hold is named, and left at its default:', () => {
  test.each([
    ['boxes=1e9', 'boxes', 'a whole number from 2 to 200000'],
    ['boxes=200001', 'boxes', '200000'],
    ['boxes=-5', 'boxes', '200000'],
    ['scene=__proto__', 'scene', 'a scene of the menu'],
    ['technique=constructor', 'technique', 'brute-force'],
    ['cell=0', 'cell', 'a number above 0'],
    ['cell=Infinity', 'cell', 'a number above 0'],
    ['cell=0x10', 'cell', 'a number above 0'],
    ['show=structure,everything', 'show', 'structure, pairs, heat'],
    ['frame=999999999', 'frame', 'a whole number'],
    ['view=1,2', 'view', '3 numbers'],
    ['view=NaN,0,1', 'view', '3 numbers'],
    ['view=1e308,0,1', 'view', '3 numbers'],
    ['box=16777216', 'box', 'a whole number'],
    ['race=auto,nobody', 'race', 'some of'],
    ['rate=1000', 'rate', '60, 10, 2'],
  ])('%s', (query, name, expected) => {
    const { state, faults } = readState(query);
    expect(state).toEqual(defaults);
    expect(faults).toHaveLength(1);
    expect(faults[0]).toContain(`${name} is ‘`);
    expect(faults[0]).toContain(expected);
  });
});

test('no address, whatever it is, asks for more than the controls can', () => {
  const key = fc.constantFrom('scene', 'boxes', 'technique', 'cell', 'show', 'rate', 'frame', 'view', 'box', 'race');
  const value = fc.oneof(
    fc.string({ maxLength: 2000 }),
    fc.integer().map(String),
    fc.double().map(String),
    fc.constantFrom(...names, ...BroadPhase.techniques),
  );
  fc.assert(
    fc.property(fc.array(fc.tuple(key, value)), (entries) => {
      const { state, faults } = readState(String(new URLSearchParams(entries)));
      expect(isScene(state.scene)).toBe(true);
      expect(state.boxes).toBeGreaterThanOrEqual(2);
      expect(state.boxes).toBeLessThanOrEqual(mostBoxes);
      expect((state.frame ?? 0) * state.boxes).toBeLessThanOrEqual(1e8);
      expect(state.frame ?? 0).toBeLessThanOrEqual(latestFrame(state.boxes));
      expect(faults.join().length).toBeLessThan(5000);
      expect(writeState(state).length).toBeLessThan(1000);
    }),
  );
});
