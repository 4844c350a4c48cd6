// Loads the kernel: one WebAssembly module for all spaces of as many dimensions, one instance with its own memory for each.
// The module is inlined as text and compiled on first use, synchronously, so that `new BroadPhase()` works everywhere
// without waiting; `init` is for hosts that forbid that or want to load the bytes themselves. Builds of the library
// with all techniques take the other text (scripts/every-technique.mjs).
import type { Dimensions } from '../dimensions.ts';
import type { KernelExports } from '../generated/abi.ts';
import { dimensions as builtDimensions, decoder, techniques as inlined, text } from '../generated/kernel-lean.ts';
import { bytesOf, isModule, tagOf } from '../values.ts';

/** The exported functions of kernel/decoder.cpp. */
interface DecoderExports {
  memory: WebAssembly.Memory;
  /** Where the text is put. */
  __heap_base: WebAssembly.Global<'i32'>;
  decode(characters: number, unused: number): number;
}

/** The dimensions that this build supports, the default first. */
export { builtDimensions };

/** By dimensions. */
let modules: (WebAssembly.Module | undefined)[] = [];
let techniques = inlined;

/**
 * Gives the library its kernel, once, before the first `new BroadPhase()`. Not needed if WebAssembly may be compiled
 * synchronously from inlined bytes, as it nearly always may. Meant for pages with a strict content security policy and
 * for hosts that load modules in their own way. `broadphase/kernel.wasm` has every technique.
 *
 * In a page: `init(await WebAssembly.compileStreaming(fetch(address)))`.
 *
 * @param source the bytes of `broadphase/kernel.wasm`, or a module compiled from them
 * @throws TypeError if it is neither, or not that kernel; Error if the bytes cannot be compiled
 *
 * @example
 * init('kernel.wasm' as never); // throws TypeError: init: got kernel.wasm, expected a WebAssembly.Module
 */
export function init(source: WebAssembly.Module | BufferSource): void {
  const bytes = bytesOf(source, 'init');
  let module: WebAssembly.Module;
  if (isModule(source)) module = checked(source);
  else if (bytes) {
    const given = bytes.slice(); // a shared or resizable buffer cannot be compiled
    const start = String.fromCharCode(...given.subarray(0, 4));
    if (start !== '\0asm') notKernel(`bytes that begin with ${JSON.stringify(start)}`); // a page that says 404
    // Where WebAssembly with SIMD works, bytes that are no module are to blame, not the host.
    if (
      typeof WebAssembly !== 'undefined' &&
      !WebAssembly.validate(given) &&
      WebAssembly.validate(inlinedBytes(builtDimensions[0]!))
    )
      notKernel('bytes that are damaged or cut off');
    module = checked(compile(given));
  } else
    throw new TypeError(
      `init: got ${typeof source === 'object' ? tagOf(source) : String(source)}, expected a WebAssembly.Module or the bytes of one`,
    );
  modules = [undefined, undefined, module, module];
  techniques = 0;
}

/** Checks that a module is a kernel of this library; if not, the previous one stays. */
function checked(module: WebAssembly.Module): WebAssembly.Module {
  if (WebAssembly.Module.exports(module).some(({ name }) => name === 'open_space')) return module;
  notKernel('a module that is not a kernel');
}

function notKernel(what: string): never {
  throw new TypeError(`init: got ${what}, expected that of 'broadphase/kernel.wasm'`);
}

const inlinedBytes = (dimensions: Dimensions) => read(text, dimensions === 2 ? 3 : 2);

/**
 * A fresh kernel with memory of its own, for boxes of this many dimensions. Browsers reserve gigabytes of addresses for
 * each memory, so a page can hold few: about 125 in Chromium, 1,000 in Firefox.
 */
export function instantiate(dimensions: Dimensions): KernelExports {
  modules[dimensions] ??= compile(inlinedBytes(dimensions));
  try {
    return new WebAssembly.Instance(modules[dimensions]).exports as unknown as KernelExports;
  } catch (cause) {
    throw new RangeError('no memory for another space: a page holds about 100; dispose() of old ones', { cause });
  }
}

/** The techniques of the kernel: a bit for each. */
export function builtTechniques(): number {
  techniques ||= instantiate(builtDimensions[0]!).techniques();
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
 * The module that scripts/inline.mjs has written as text: see there. What is only for `unused` dimensions is left out,
 * since engines take about as long for every byte that they compile. A small module decodes the text (kernel/decoder.cpp).
 */
export function read(parts: typeof text, unused?: Dimensions): Uint8Array<ArrayBuffer> {
  const made = compile(new Uint8Array(decoder)); // first: it says so where there is no WebAssembly
  const { memory, __heap_base: at, decode } = new WebAssembly.Instance(made).exports as unknown as DecoderExports;
  let needed = '';
  // First what is for both dimensions, then what is for two, then what is for three.
  for (let k = 0; k < 3; k++) {
    if (k > 0 && k + 1 === unused) continue;
    for (const { text, ends } of parts) needed += text.slice(ends[k], ends[k + 1]);
  }
  encodeInto(needed, new Uint8Array(memory.buffer, at.value));
  return new Uint8Array(memory.buffer, at.value + needed.length, decode(needed.length, unused ?? 0));
}

/** Writes characters of ASCII as bytes. Jest's pages and audio worklets have no TextEncoder, which is much faster. */
function encodeInto(text: string, bytes: Uint8Array): void {
  if (typeof TextEncoder !== 'undefined') new TextEncoder().encodeInto(text, bytes);
  else for (let k = 0; k < text.length; k++) bytes[k] = text.charCodeAt(k);
}
