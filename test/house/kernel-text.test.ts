// The kernel as text: what scripts/inline.mjs writes, src/kernel/load.ts and its small decoder read back byte for byte.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { inline } from '../../scripts/inline.mjs';
import type { KernelExports } from '../../src/generated/abi.ts';
import { techniques, text } from '../../src/generated/kernel-lean.ts';
import { read } from '../../src/kernel/load.ts';

const fileOf = (name: string) =>
  new Uint8Array(readFileSync(fileURLToPath(new URL(`../../build/${name}.wasm`, import.meta.url))));
const through = (bytes: Uint8Array, owners?: number[], unused?: 2 | 3) => read(inline(bytes, owners), unused);

/** A number as WebAssembly writes it. */
const leb = (value: number): number[] => (value < 128 ? [value] : [(value & 127) | 128, ...leb(value >> 7)]);
const section = (id: number, content: number[]) => [id, ...leb(content.length), ...content];
/** A module of these functions, each given as its locals and instructions, between sections of any bytes. */
const moduleOf = (functions: number[][], before: number[] = [], behind: number[] = []) =>
  Uint8Array.from([
    ...[0, 0x61, 0x73, 0x6d, 1, 0, 0, 0],
    ...section(0, before),
    ...section(10, [...leb(functions.length), ...functions.flatMap((body) => [...leb(body.length), ...body])]),
    ...section(0, behind),
  ]);
const anyBytes = (maxLength: number) => fc.array(fc.nat(255), { maxLength });

test('any bytes around the code come back', () => {
  const few = fc.array(fc.constantFrom(0, 1, 128, 255));
  fc.assert(
    fc.property(fc.oneof(anyBytes(2000), few), anyBytes(20), (before, behind) => {
      const wasm = moduleOf([[0, 0x0b]], before, behind);
      expect(through(wasm)).toEqual(wasm);
    }),
  );
});

test('every byte has its one or two characters, whichever bytes are frequent', () => {
  for (let first = 0; first < 256; first += 5) {
    const bytes = Array.from({ length: 1024 }, (_, k) => (k < 256 ? k : first + (k % 100)) & 255);
    const wasm = moduleOf([[0, 0x0b]], bytes);
    expect(through(wasm)).toEqual(wasm);
  }
});

test('instructions of every form come back', () => {
  const number = fc.nat(2 ** 31 - 1).map(leb);
  const raw = (count: number) => fc.array(fc.nat(255), { minLength: count, maxLength: count });
  const form = (opcode: number[], ...parts: fc.Arbitrary<number[]>[]) =>
    fc.tuple(...parts).map((given) => [...opcode, ...given.flat()]);
  const small = fc.nat(4).map(leb);
  const instruction = fc.oneof(
    form([0x6a]),
    form([0x02], fc.constant([0x40])),
    form([0x0b]),
    form([0x0e, 2], number, number, number),
    form([0x10], number),
    form([0x11], number, number),
    form([0x20], number),
    form([0x28], small, number),
    form([0x41], number),
    form([0x42], number),
    form([0x43], raw(4)),
    form([0x44], raw(8)),
    form([0xfc, 10, 0, 0]),
    form([0xfd, 0], small, number),
    form([0xfd, 13], raw(16)),
    form([0xfd, 21], small),
    form([0xfd, 84], small, number, small),
    form([0xfd, 0x80, 1]),
  );
  const locals = fc.array(fc.tuple(number, fc.constantFrom([0x7f], [0x7b])).map((group) => group.flat()));
  const body = fc
    .tuple(locals, fc.array(instruction, { maxLength: 200 }))
    .map(([groups, list]) => [...leb(groups.length), ...groups.flat(), ...list.flat(), 0x0b]);
  fc.assert(
    fc.property(fc.array(body, { minLength: 1, maxLength: 200 }), (functions) => {
      const wasm = moduleOf(functions);
      expect(through(wasm)).toEqual(wasm);
    }),
  );
});

test('functions that are only for unused dimensions become traps', () => {
  const body = [1, (300 & 127) | 128, 300 >> 7, 0x7f, ...Array(90).fill([0x20, 1, 0x1a]).flat(), 0x0b];
  const trap = [0, 0, 0x0b];
  const wasm = moduleOf([body, body, body], [1], [2]);
  expect(through(wasm, [0, 2, 3], 3)).toEqual(moduleOf([body, body, trap], [1], [2]));
  expect(through(wasm, [0, 2, 3], 2)).toEqual(moduleOf([body, trap, body], [1], [2]));
  expect(through(wasm, [0, 2, 3])).toEqual(wasm);
});

test('functions keep their order, whichever dimensions they are for', () => {
  const body = fc
    .array(fc.nat(2 ** 31 - 1), { maxLength: 100 })
    .map((all) => [0, ...all.flatMap((n) => [0x41, ...leb(n)]), 0x0b]);
  const functions = fc.array(fc.tuple(body, fc.constantFrom(0, 2, 3)), { minLength: 1, maxLength: 200 });
  fc.assert(
    fc.property(functions, fc.constantFrom(undefined, 2, 3), (given, unused) => {
      const wasm = moduleOf(given.map(([body]) => body));
      const owners = given.map(([, owner]) => owner);
      const expected = moduleOf(given.map(([body, owner]) => (owner === unused ? [0, 0, 0x0b] : body)));
      expect(through(wasm, owners, unused as 2 | 3 | undefined)).toEqual(expected);
    }),
  );
});

test('about half of the kernel is for each number of dimensions', () => {
  const whole = read(text);
  for (const unused of [2, 3] as const) {
    const half = read(text, unused);
    expect(WebAssembly.validate(half)).toBe(true);
    expect(half.length).toBeLessThan(0.7 * whole.length);
  }
});

test('an instruction that nobody knows is told when the kernel is built', () => {
  expect(() => inline(moduleOf([[0, 0x1c, 0x0b]]))).toThrow('unknown opcode 0x1c');
});

test.each(['kernel', 'kernel-lean'])('the %s comes back', (name) => {
  expect(Buffer.compare(through(fileOf(name)), fileOf(name))).toBe(0);
});

test('the inlined text is that of the kernel that was built', () => {
  // Tests run with every technique: vitest.config.ts.
  expect(Buffer.compare(read(text), fileOf('kernel'))).toBe(0);
});

test('the techniques told are those of the kernel', () => {
  const kernel = new WebAssembly.Instance(new WebAssembly.Module(read(text))).exports as unknown as KernelExports;
  expect(techniques).toBe(kernel.techniques());
});
