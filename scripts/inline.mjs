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
const single = characters.length - prefixes;

/** A number below 256 as a pair. */
const pairOf = (number) => characters[Math.floor(number / characters.length)] + characters[number % characters.length];

/**
 * A module of WebAssembly, of `size` bytes, as text. First the bytes that are one character each, as pairs; of all others,
 * the pair is their place among them. Then the counts and lengths, and the streams. `owners`: for each function, the
 * dimensions that it is for, or 0 for both.
 */
export function inline(wasm, owners = []) {
  const { counts, kinds, before, owners: owned, order, given, behind } = apart(wasm, owners);
  const all = [kinds, before, owned, order, ...given, behind];
  const often = new Uint32Array(256);
  for (const byte of all.flat()) often[byte]++;
  const bytes = Array.from(often.keys()).sort((a, b) => often[b] - often[a] || a - b);
  const written = [];
  for (const [k, byte] of bytes.slice(0, single).entries()) written[byte] = characters[prefixes + k];
  for (const [k, byte] of bytes
    .slice(single)
    .sort((a, b) => a - b)
    .entries())
    written[byte] = pairOf(k);
  const textOf = (stream) => stream.map((byte) => written[byte]).join('');
  // Where a stream ends is told in characters, but for the first and the last, which are read at once.
  const lengths = [before.length, behind.length, ...[owned, order, ...given].map((stream) => textOf(stream).length)];
  const head = [...counts, ...lengths].flatMap((length) => [length & 255, (length >> 8) & 255, length >> 16]);
  return {
    text: [...bytes.slice(0, single).map(pairOf), ...[head, ...all].map(textOf)].join(''),
    size: wasm.length,
  };
}

/** Bytes as two letters each, from @ to O: what is fast to read for an engine that has just started. */
const lettersOf = (bytes) =>
  Array.from(bytes, (byte) => String.fromCharCode(64 + (byte >> 4), 64 + (byte & 15))).join('');

/** A kernel as a module of TypeScript, with how it is decoded, and what it knows. */
export function moduleOf(wasm, owners, decoder, techniques, dimensions) {
  const { size, text } = inline(wasm, owners);
  const lines = [
    '// Made by scripts/kernel.mjs from kernel/: do not edit.',
    `export const text =\n  '${text}';`,
    `export const decoder =\n  '${lettersOf(decoder)}';`,
    `export const size = ${size};`,
    `export const dimensions: readonly (2 | 3)[] = [${dimensions.join(', ')}];`,
    `export type Technique = ${techniques.map((technique) => `'${technique}'`).join(' | ')};`,
  ];
  return `${lines.join('\n')}\n`;
}
