// Which functions of the kernel are for boxes of two dimensions only, and which for three: a space has one of both, so
// half of the kernel need not be compiled (kernel/decoder.cpp leaves it out). The compiler's names tell: `Space<2>::update`.
import { codeOf, functionsOf, Reader, sectionsOf } from './streams.mjs';

const custom = 0;
const exported = 7;
const call = 0x10;

const textOf = (reader) => Buffer.from(reader.raw(reader.number())).toString('latin1');

/** The names of functions, by number. */
function namesOf(wasm, sections) {
  const names = [];
  for (const { id, at, to } of sections) {
    const reader = new Reader(wasm, at);
    if (id !== custom || textOf(reader) !== 'name') continue;
    while (reader.at < to) {
      const functions = reader.byte() === 1;
      const next = reader.number() + reader.at;
      for (let left = functions ? reader.number() : 0; left > 0; left--) names[reader.number()] = textOf(reader);
      reader.at = next;
    }
  }
  return names;
}

/** The numbers of the functions that are exported. */
function exportsOf(wasm, sections) {
  const reader = new Reader(wasm, sections.find(({ id }) => id === exported).at);
  const found = new Set();
  for (let left = reader.number(); left > 0; left--) {
    textOf(reader);
    const isFunction = reader.byte() === 0;
    const number = reader.number();
    if (isFunction) found.add(number);
  }
  return found;
}

/** The one number of dimensions in a name, else 0. */
function dimensionsIn(name = '') {
  const found = new Set(Array.from(name.matchAll(/<([23])[,>]/g), ([, number]) => Number(number)));
  return found.size === 1 ? [...found][0] : 0;
}

/**
 * The kernel without its names, and the dimensions that each of its functions is for; 0: both. What one for both calls is
 * for both, unless that one is exported: it asks for the dimensions first.
 */
export function withoutNames(named) {
  const sections = sectionsOf(named);
  const names = namesOf(named, sections);
  const roots = exportsOf(named, sections);
  const kept = sections.filter(({ id }) => id !== custom).map(({ from, to }) => named.subarray(from, to));
  const bytes = Uint8Array.from(Buffer.concat([named.subarray(0, 8), ...kept]));
  const functions = functionsOf(bytes, codeOf(bytes));
  const owners = functions.map((_, k) => (roots.has(k) ? 0 : dimensionsIn(names[k])));
  if (!owners.some((owner) => owner > 0))
    throw new Error('no function is for one number of dimensions: are there names?');
  for (let changed = true; changed; ) {
    changed = false;
    for (const [k, list] of functions.entries()) {
      for (const { opcode, given } of list) {
        if (opcode !== call || roots.has(k)) continue;
        const called = new Reader(given).number();
        if (owners[called] === 0 || owners[called] === owners[k]) continue;
        owners[called] = 0;
        changed = true;
      }
    }
  }
  return { bytes, owners };
}
