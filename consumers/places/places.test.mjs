// For Vitest, in each of its environments.
import * as library from 'broadphase';
import { Entity, World } from 'broadphase/ro';
import { openTrace, record } from 'broadphase/trace';
import { expect, test } from 'vitest';
import { everyForeign, expectedOfForeign } from './foreign.cjs';

test('the library starts, records, and draws nothing', async () => {
  const space = new library.BroadPhase();
  const recording = record(space);
  space.set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
  expect([...space.pairs]).toEqual([7, 9]);
  await recording.stop();
  expect(openTrace(structuredClone(recording.bytes())).frames).toBe(1);
  const world = new World(null);
  world.addEntity(new Entity(0, 0, 1, 1));
  world.step();
});

test('spaces are equal that have the same boxes', () => {
  const make = (id) => new library.BroadPhase().set(id, 0, 0, 10, 10);
  expect(make(7)).toEqual(make(7));
  expect({ space: make(7) }).toStrictEqual({ space: make(7).update() });
  expect(make(7)).not.toEqual(make(9));
});

test('what structuredClone gives', () => {
  const foreign = Object.fromEntries(
    ['Array', 'Float32Array', 'Float64Array', 'Uint8Array'].map((name) => [
      name,
      structuredClone(new globalThis[name]()).constructor,
    ]),
  );
  expect(everyForeign(library, foreign)).toBe(expectedOfForeign);
});

test.runIf(globalThis.document)(
  'React makes, drops and makes a space again, in strict mode and where code is reloaded',
  async () => {
    globalThis.IS_REACT_ACT_ENVIRONMENT = true;
    const { act, createElement, StrictMode, useEffect, useState } = await import('react');
    const { createRoot } = await import('react-dom/client');
    let made = 0;
    function Game() {
      const [pairs, setPairs] = useState('');
      useEffect(() => {
        made++;
        const space = new library.BroadPhase().set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
        setPairs(String(space.pairs));
        return () => space.dispose();
      }, []);
      return createElement('p', null, pairs);
    }
    const place = document.body.appendChild(document.createElement('div'));
    const root = createRoot(place);
    for (const key of ['first', 'reloaded']) {
      await act(() => root.render(createElement(StrictMode, null, createElement(Game, { key }))));
      expect(place.textContent).toBe('7,9');
    }
    expect(made).toBe(4);
    await act(() => root.unmount());
  },
);
