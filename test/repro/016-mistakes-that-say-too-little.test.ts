// Mistakes whose error blamed something else, or did not come.
import { expect, test } from 'vitest';
import { BroadPhase, init } from '../../src/all.ts';

test('init with bytes of a page that was not found names them', () => {
  const page = new TextEncoder().encode('<!doctype html><title>404</title>');
  const expected = `init: got bytes that begin with "<!do", expected that of 'broadphase/kernel.wasm'`;
  expect(() => init(page)).toThrow(new TypeError(expected));
  expect(() => init(new ArrayBuffer(0))).toThrow('init: got bytes that begin with ""');
  expect(new BroadPhase().set(0, 0, 0, 1, 1).size).toBe(1);
});

test('a list of ids in the place of options is refused, also an empty one', () => {
  const space = new BroadPhase().set(0, 0, 0, 1, 1).update();
  const out: number[] = [];
  expect(() => space.queryBox(0, 0, 1, 1, out as object)).toThrow(
    new TypeError('queryBox: got [], expected an object of options'),
  );
  expect(() => new BroadPhase([] as object)).toThrow('expected an object of options');
});
