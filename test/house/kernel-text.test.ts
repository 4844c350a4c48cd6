// The kernel as text: what scripts/inline.mjs writes, src/kernel/load.ts and its small decoder read back byte for byte.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { inline } from '../../scripts/inline.mjs';
import * as lean from '../../src/generated/kernel-lean.ts';
import { read } from '../../src/kernel/load.ts';

const fileOf = (name: string) =>
  new Uint8Array(readFileSync(fileURLToPath(new URL(`../../build/${name}.wasm`, import.meta.url))));
const through = (bytes: Uint8Array) => read({ ...lean, ...inline(bytes) });

test('any bytes come back', () => {
  const few = fc.array(fc.constantFrom(0, 1, 128, 255));
  fc.assert(
    fc.property(fc.oneof(fc.uint8Array({ maxLength: 2000 }), few), (numbers) => {
      const bytes = Uint8Array.from(numbers);
      expect(through(bytes)).toEqual(bytes);
    }),
  );
});

test('every byte has its character or its two, whatever is frequent', () => {
  for (let first = 0; first < 256; first += 5) {
    const bytes = Uint8Array.from({ length: 1024 }, (_, k) => (k < 256 ? k : first + (k % 100)));
    expect(through(bytes)).toEqual(bytes);
  }
});

test.each(['kernel', 'kernel-lean'])('the %s comes back', (name) => {
  expect(Buffer.compare(through(fileOf(name)), fileOf(name))).toBe(0);
});

test('the inlined text is that of the kernel that was built', () => {
  // Tests run with every technique: vitest.config.ts.
  expect(Buffer.compare(read(lean), fileOf('kernel'))).toBe(0);
});
