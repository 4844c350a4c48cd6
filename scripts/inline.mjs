// Bytes as text for a JavaScript string, so that gzip compresses the text as well as the bytes. Idea: frequent bytes
// become one character each, others two, the first of which is one of a few reserved for that. So repetitions in the
// bytes are repetitions in the text. No character needs an escape, neither in a string, nor in HTML, nor in any
// encoding of the page. src/kernel/load.ts reads it.
import { apart } from './streams.mjs';

/** Printable ASCII, without characters that are special in strings or HTML. */
const characters = Array.from({ length: 94 }, (_, k) => String.fromCharCode(33 + k)).filter(
  (character) => !'\'"`\\$<&'.includes(character),
);
/** This many of them begin a pair. */
const prefixes = 3;

/** A module of WebAssembly as text. `order`: the bytes of single characters, two hexadecimal digits each; `text`: what stands for
 * the bytes of its streams; `size`: how many bytes the module has. */
export function inline(wasm) {
  const bytes = apart(wasm);
  const counts = new Uint32Array(256);
  for (const byte of bytes) counts[byte]++;
  const { length } = characters;
  const single = length - prefixes;
  const order = Uint8Array.from(counts.keys()).sort((a, b) => counts[b] - counts[a] || a - b);
  order.subarray(single).sort(); // sorted, so that they need not be stored
  const written = [];
  for (const [k, byte] of order.entries()) {
    const pair = k - single;
    written[byte] =
      pair < 0 ? characters[prefixes + k] : characters[Math.floor(pair / length)] + characters[pair % length];
  }
  return {
    alphabet: characters.join(''),
    order: Buffer.from(order.subarray(0, single)).toString('hex'),
    text: Array.from(bytes, (byte) => written[byte]).join(''),
    size: wasm.length,
  };
}

/** A kernel as a TypeScript module, with the data for decoding, and its techniques. */
export function moduleOf(wasm, decoder, techniques, dimensions) {
  const { size, ...texts } = inline(wasm);
  const lines = [
    '// Made by scripts/kernel.mjs from kernel/: do not edit.',
    ...Object.entries({ ...texts, decoder }).map(([key, value]) => `export const ${key} =\n  '${value}';`),
    `export const size = ${size};`,
    `export const dimensions: readonly (2 | 3)[] = [${dimensions.join(', ')}];`,
    `export type Technique = ${techniques.map((technique) => `'${technique}'`).join(' | ')};`,
  ];
  return `${lines.join('\n')}\n`;
}
