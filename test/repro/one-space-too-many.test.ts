// A page holds about 100 spaces at a time, since a browser reserves gigabytes of addresses for the memory of each. One
// more threw the engine's own error, which did not say that; Firefox throws a bare string. test/browser/many-spaces.spec.ts
// makes as many as Chromium allows.
import { BroadPhase } from 'broadphase';
import { expect, onTestFinished, test } from 'vitest';

test.each([
  new RangeError('WebAssembly.Instance(): Out of memory: Cannot allocate Wasm memory for new instance'),
  'out of memory',
])('a space for which the engine has no memory left, when it throws %s', (thrown) => {
  new BroadPhase().dispose();
  const { Instance } = WebAssembly;
  onTestFinished(() => void Object.assign(WebAssembly, { Instance }));
  WebAssembly.Instance = class {
    constructor() {
      throw thrown;
    }
  } as unknown as typeof Instance;
  let error: unknown;
  try {
    new BroadPhase();
  } catch (caught) {
    error = caught;
  }
  expect(error).toBeInstanceOf(RangeError);
  expect(String(error)).toMatch(/^RangeError: no memory for another space: .*dispose\(\)/);
  expect((error as Error).cause).toBe(thrown);
  WebAssembly.Instance = Instance;
  expect(new BroadPhase().set(0, 0, 0, 9, 9).set(1, 5, 5, 6, 6).update().pairCount).toBe(1);
});
