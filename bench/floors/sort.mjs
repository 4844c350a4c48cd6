// A floor, not a contender: one radix sort of the boxes' first minima, three passes of 11 bits, by the kernel's
// own code. Whatever sorts all boxes anew each frame stands on it. It finds no pairs.
import { readFileSync } from 'node:fs';

export const dimensions = [2, 3];
export const findsPairs = false;

/** Where run.mjs puts the compiled sort.cpp. */
const wasm = new URL('../../build/bench/sort.wasm', import.meta.url);

export function create({ dimensions, count }) {
  const { exports } = new WebAssembly.Instance(new WebAssembly.Module(readFileSync(wasm)));
  const stride = 2 * dimensions;
  const at = exports.reserve(count);
  exports.sort(count); // takes its memory, so that the view below stays
  const keys = new Float32Array(exports.memory.buffer, at, count);
  return {
    update(boxes) {
      for (let k = 0; k < count; k++) keys[k] = boxes[stride * k];
      exports.sort(count);
      return 0;
    },
  };
}
