// What scripts/abi.mjs reads out of kernel/ is all that there is.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect, test } from 'vitest';
import { abi } from '../../scripts/abi.mjs';

test('each function that the kernel exports stands in the interface of TypeScript', () => {
  const wasm = readFileSync(fileURLToPath(new URL('../../build/kernel.wasm', import.meta.url)));
  const exported = WebAssembly.Module.exports(new WebAssembly.Module(wasm)).filter(({ kind }) => kind === 'function');
  const listed = [...abi().matchAll(/^ {2}(\w+)\(/gm)].map(([, name]) => name);
  expect(listed.sort()).toEqual(exported.map(({ name }) => name).sort());
});

test('the module of TypeScript is the one that is made of the kernel as it is', () => {
  expect(readFileSync(fileURLToPath(new URL('../../src/generated/abi.ts', import.meta.url)), 'utf8')).toBe(abi());
});
