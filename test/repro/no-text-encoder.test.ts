// What a user saw: in Jest with jsdom, `new BroadPhase()` threw "TextEncoder is not defined". Audio worklets and bare
// engines have none either; and where WebAssembly is missing, that was not what was said.
import { afterEach, expect, test, vi } from 'vitest';

afterEach(() => vi.unstubAllGlobals());

/** The library as a host without these globals sees it, loaded again. */
async function without(...names: string[]): Promise<typeof import('broadphase')> {
  vi.resetModules();
  const library = await import('broadphase');
  for (const name of names) vi.stubGlobal(name, undefined);
  return library;
}

test.each([
  ['TextEncoder'],
  ['TextEncoder', 'TextDecoder', 'performance', 'structuredClone', 'console', 'process', 'Buffer', 'URL'],
])('the library starts without %s', async (...names) => {
  const { BroadPhase, findPairs } = await without(...names);
  const space = new BroadPhase().set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
  const pairs = findPairs([0, 0, 1, 1, 1, 1, 2, 2]);
  vi.unstubAllGlobals();
  expect([...space.pairs]).toEqual([7, 9]);
  expect([...pairs]).toEqual([0, 1]);
});

test('without WebAssembly it is that which is said to be missing', async () => {
  const { BroadPhase } = await without('TextEncoder', 'WebAssembly');
  expect(() => new BroadPhase()).toThrow('broadphase needs WebAssembly with SIMD');
});
