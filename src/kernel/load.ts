// Loads the kernel: one WebAssembly module for all spaces, one instance with its own memory for each.
// The module is inlined as text and compiled on first use, synchronously, so that `new BroadPhase()` works everywhere
// without waiting; `init` is for hosts that forbid that or want to load the bytes themselves. Builds of the library
// with all techniques take the other text (scripts/every-technique.mjs).
import type { KernelExports } from '../generated/abi.ts';
import * as kernel from '../generated/kernel-lean.ts';
import { bytesOf, isModule } from '../values.ts';

/** The exported functions of kernel/decoder.cpp. */
interface DecoderExports {
  memory: WebAssembly.Memory;
  given(): number;
  decode(count: number, prefixes: number, length: number): void;
}

/** The dimensions that this build supports, the default first. */
export const builtDimensions = kernel.dimensions;

let module: WebAssembly.Module | undefined;
let techniques = 0;

/**
 * Gives the library its kernel, once, before the first `new BroadPhase()`. Not needed if WebAssembly may be compiled
 * synchronously from inlined bytes, as it nearly always may. Meant for pages with a strict content security policy and
 * for hosts that load modules in their own way. `broadphase/kernel.wasm` has every technique.
 *
 * In a page: `init(await WebAssembly.compileStreaming(fetch(address)))`.
 *
 * @param source the bytes of `broadphase/kernel.wasm`, or a module compiled from them
 * @throws TypeError if it is neither; Error if the bytes cannot be compiled
 *
 * @example
 * init('kernel.wasm' as never); // throws TypeError: init: got kernel.wasm, expected a WebAssembly.Module
 */
export function init(source: WebAssembly.Module | BufferSource): void {
  const bytes = bytesOf(source);
  if (isModule(source)) module = checked(source);
  else if (bytes)
    module = checked(compile(bytes.slice())); // a shared or resizable buffer cannot be compiled
  else throw new TypeError(`init: got ${String(source)}, expected a WebAssembly.Module or the bytes of one`);
  techniques = 0;
}

/** Checks that a module is a kernel of this library; if not, the previous one stays. */
function checked(module: WebAssembly.Module): WebAssembly.Module {
  if (WebAssembly.Module.exports(module).some(({ name }) => name === 'open_space')) return module;
  throw new TypeError("init: got a module that is not a kernel, expected that of 'broadphase/kernel.wasm'");
}

/** A new instance of the kernel, with its own memory. */
export function instantiate(): KernelExports {
  module ??= compile(read(kernel));
  return new WebAssembly.Instance(module).exports as unknown as KernelExports;
}

/** The techniques of the kernel: a bit for each. */
export function builtTechniques(): number {
  techniques ||= instantiate().techniques();
  return techniques;
}

function compile(bytes: BufferSource): WebAssembly.Module {
  if (typeof WebAssembly === 'undefined') {
    throw new Error(
      'broadphase needs WebAssembly with SIMD (all browsers since 2023, Node 16.4), which is missing here',
    );
  }
  try {
    return new WebAssembly.Module(bytes);
  } catch (cause) {
    throw new Error(
      'broadphase needs WebAssembly with SIMD (all browsers since 2023, Node 16.4): this host refused to compile it. ' +
        "Where a content security policy forbids it, allow 'wasm-unsafe-eval' or call init() with a compiled module",
      { cause },
    );
  }
}

/**
 * The module of `size` bytes that scripts/inline.mjs has written as text: see there. The first characters of the alphabet
 * begin a pair; the others stand for the bytes in `order`. A small module decodes it (kernel/decoder.cpp): half of what a
 * page waits for.
 */
export function read({
  alphabet,
  order,
  text,
  decoder,
  size,
}: Record<'alphabet' | 'order' | 'text' | 'decoder', string> & { size: number }): Uint8Array<ArrayBuffer> {
  const made = compile(digits(decoder)); // first, since it throws the right error if there is no WebAssembly
  const { exports } = new WebAssembly.Instance(made);
  const { memory, given, decode } = exports as unknown as DecoderExports;
  const at = given();
  const tables = 128 + 128 + 256;
  const end = at + tables + text.length; // of what is given: behind it comes what is made
  const lacking = end + size - memory.buffer.byteLength;
  if (lacking > 0) memory.grow((lacking + 0xffff) >>> 16);
  const io = new Uint8Array(memory.buffer, at);
  const single = digits(order);
  const { length } = alphabet;
  const prefixes = length - single.length;
  for (let k = 0; k < length; k++) {
    io[alphabet.charCodeAt(k)] = single[k - prefixes] ?? 0;
    io[128 + alphabet.charCodeAt(k)] = k;
  }
  // The bytes of pairs follow in ascending order.
  const bytes = new Set(single);
  for (let byte = 0; byte < 256; byte++) bytes.add(byte);
  io.set([...bytes].slice(single.length), 256);
  encodeInto(text, io.subarray(tables));
  decode(text.length, alphabet.charCodeAt(prefixes), length);
  return new Uint8Array(memory.buffer, end, size);
}

/** Decodes bytes of two hexadecimal digits each. */
function digits(text: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from({ length: text.length / 2 }, (_, k) => Number.parseInt(text.slice(2 * k, 2 * k + 2), 16));
}

/** Writes characters of ASCII as bytes. Jest's pages and audio worklets have no TextEncoder, which is much faster. */
function encodeInto(text: string, bytes: Uint8Array): void {
  if (typeof TextEncoder !== 'undefined') new TextEncoder().encodeInto(text, bytes);
  else for (let k = 0; k < text.length; k++) bytes[k] = text.charCodeAt(k);
}
