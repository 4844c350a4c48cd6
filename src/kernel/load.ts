// Loads the kernel: one WebAssembly module for all spaces, one instance with its own memory for each.
// The module is inlined as text and compiled on first use, synchronously, so that `new BroadPhase()` works everywhere
// without waiting; `init` is for hosts that forbid that or want to load the bytes themselves. Builds of the library
// with all techniques take the other text (scripts/every-technique.mjs).
import * as kernel from '../generated/kernel-lean.ts';
import { bytesOf, isModule } from '../values.ts';

/** The exported functions of kernel/abi.cpp. Addresses come as signed numbers: `>>> 0` those that can be beyond 2 GiB. */
export interface KernelExports {
  memory: WebAssembly.Memory;
  __stack_pointer: WebAssembly.Global;
  io_address(): number;
  open_space(dimensions: number): void;
  set_cell_size(): void;
  set_margin(margin: number): void;
  set_wrap(): void;
  set_bounds(): void;
  reserve(count: number): void;
  ring_address(): number;
  take(count: number): void;
  remove(id: number): number;
  has(id: number): number;
  get(id: number): number;
  size(): number;
  clear(): void;
  set_filter(id: number, layer: number, mask: number): number;
  set_static(id: number, on: number): number;
  set_enabled(id: number, on: number): number;
  set_touching(on: number): void;
  most_reach(): number;
  meet_around(): number;
  set_group(id: number, group: number): number;
  set_reach(id: number, distance: number): number;
  get_rule(id: number): number;
  list_ids(): number;
  contents(): void;
  stage(count: number): number;
  stage_exact(count: number): number;
  replace(count: number, doubles: number): number;
  expose(count: number): number;
  staged_number(index: number, doubles: number): number;
  save(): number;
  stage_snapshot(size: number): number;
  restore(): number;
  split(red: number): void;
  techniques(): number;
  set_technique(technique: number): void;
  update(): number;
  pairs_address(): number;
  pair_count(): number;
  set_events(): void;
  began_address(): number;
  began_count(): number;
  ended_address(): number;
  ended_count(): number;
  is_pair(a: number, b: number): number;
  partners(id: number): number;
  answers_address(): number;
  ask_area(mask: number, ignored: number, from: number, most: number): number;
  ask_planes(planes: number, mask: number, ignored: number, from: number, most: number): number;
  ask_order(kind: number, mask: number, ignored: number, after: number, most: number): number;
  stage_questions(numbers: number): number;
  bad_question(kind: number, count: number): number;
  ask_many(kind: number, count: number, mask: number, most: number): number;
  offsets_address(): number;
  many_ids_address(): number;
  many_hits_address(): number;
  hits_address(): number;
  log_epoch(): number;
  log_count(): number;
  log_address(): number;
  seen_count(): number;
  see_rows(count: number): void;
  updates(): number;
  stats_address(): number;
  structure(): number;
  structure_count(): number;
  validate(): number;
  recover(): number;
  begin_anew(): number;
}

/** The exported functions of kernel/decoder.cpp. */
interface DecoderExports {
  memory: WebAssembly.Memory;
  given(): number;
  decode(count: number, prefixes: number, length: number): void;
}

/** How many axes boxes may have in this build, the default first. */
export const builtDimensions = kernel.dimensions;

let module: WebAssembly.Module | undefined;
let techniques = 0;

/**
 * Gives the library its kernel, once, before the first `new BroadPhase()`. Not needed where WebAssembly may be
 * compiled synchronously from inlined bytes, which is nearly everywhere; meant for pages with a strict content
 * security policy and for hosts that load modules their own way. `broadphase/kernel.wasm` has every technique.
 *
 * In a page: `init(await WebAssembly.compileStreaming(fetch(address)))`.
 *
 * @param source the bytes of `broadphase/kernel.wasm`, or a module compiled from them
 * @throws TypeError where it is neither; Error where the bytes cannot be compiled
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

/** The module, if it is a kernel of this library: else what was there before stays. */
function checked(module: WebAssembly.Module): WebAssembly.Module {
  if (WebAssembly.Module.exports(module).some(({ name }) => name === 'open_space')) return module;
  throw new TypeError("init: got a module that is not a kernel, expected that of 'broadphase/kernel.wasm'");
}

/** A fresh kernel with memory of its own. */
export function instantiate(): KernelExports {
  module ??= compile(read(kernel));
  return new WebAssembly.Instance(module).exports as unknown as KernelExports;
}

/** Which techniques the kernel has: a bit for each. */
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
  const made = compile(digits(decoder)); // first: it says so where there is no WebAssembly
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

/** The bytes that stand as two hexadecimal digits each. */
function digits(text: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from({ length: text.length / 2 }, (_, k) => Number.parseInt(text.slice(2 * k, 2 * k + 2), 16));
}

/** Writes characters of ASCII as bytes. Jest's pages and audio worklets have no TextEncoder, which is much faster. */
function encodeInto(text: string, bytes: Uint8Array): void {
  if (typeof TextEncoder !== 'undefined') new TextEncoder().encodeInto(text, bytes);
  else for (let k = 0; k < text.length; k++) bytes[k] = text.charCodeAt(k);
}
