// Loads the kernel: one WebAssembly module for all spaces, one instance with its own memory for each.
// The module is inlined as hexadecimal digits and compiled on first use, synchronously, so that `new BroadPhase()` works
// everywhere without waiting; `init` is for hosts that forbid that or want to load the bytes themselves.
import { kernelHex } from './generated/kernel-wasm.ts';

/** The exported functions of kernel/abi.cpp. Addresses come as signed numbers: `>>> 0` those that can be beyond 2 GiB. */
export interface KernelExports {
  memory: WebAssembly.Memory;
  __stack_pointer: WebAssembly.Global;
  io_address(): number;
  open_space(dimensions: number): void;
  set_cell_size(): void;
  set_margin(margin: number): void;
  set_bounds(): void;
  reserve(count: number): void;
  set(id: number): void;
  remove(id: number): number;
  has(id: number): number;
  get(id: number): number;
  size(): number;
  clear(): void;
  set_filter(id: number, layer: number, mask: number): number;
  set_static(id: number, on: number): number;
  contents(): void;
  stage(count: number): number;
  stage_exact(count: number): number;
  replace(count: number, doubles: number): number;
  expose(count: number): number;
  staged_number(index: number, doubles: number): number;
  split(red: number): void;
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
  ask_order(moving: number, mask: number, ignored: number, after: number, most: number): number;
  hits_address(): number;
  updates(): number;
  stats_address(): number;
  structure(): number;
  structure_count(): number;
  validate(): number;
  recover(): number;
}

let module: WebAssembly.Module | undefined;

/**
 * Gives the library its kernel, once, before the first `new BroadPhase()`. Not needed where WebAssembly may be
 * compiled synchronously from inlined bytes, which is nearly everywhere; meant for pages with a strict content
 * security policy and for hosts that load modules their own way.
 *
 * @param source the bytes of `broadphase/kernel.wasm`, or a module compiled from them
 * @throws TypeError where it is neither
 */
export function init(source: WebAssembly.Module | BufferSource): void {
  if (source instanceof WebAssembly.Module) module = source;
  else if (source instanceof ArrayBuffer || ArrayBuffer.isView(source)) module = compile(source);
  else throw new TypeError(`init: got ${String(source)}, expected a WebAssembly.Module or the bytes of one`);
}

/** A fresh kernel with memory of its own. */
export function instantiate(): KernelExports {
  module ??= compile(decodeHex(kernelHex));
  return new WebAssembly.Instance(module).exports as unknown as KernelExports;
}

function compile(bytes: BufferSource): WebAssembly.Module {
  if (typeof WebAssembly === 'undefined') {
    throw new Error('broadphase needs WebAssembly with SIMD (all browsers since 2023, Node 16.4): it is missing here');
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

/** Two lower-case digits a byte. In place, since this is the first thing a page waits for. */
function decodeHex(digits: string): Uint8Array<ArrayBuffer> {
  // Engines since 2025 have it built in.
  const { fromHex } = Uint8Array as { fromHex?: (digits: string) => Uint8Array<ArrayBuffer> };
  if (fromHex) return fromHex.call(Uint8Array, digits);
  const codes = new TextEncoder().encode(digits);
  const length = codes.length / 2;
  for (let k = 0; k < length; k++) {
    // '0' is 48 and 'a' is 97: modulo 39 they are 9 and 19, ten apart.
    codes[k] = ((codes[2 * k]! % 39) - 9) * 16 + (codes[2 * k + 1]! % 39) - 9;
  }
  return codes.subarray(0, length);
}
