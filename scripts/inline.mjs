// Bytes as text for a JavaScript string, so that gzip compresses the text as well as the bytes. Idea: frequent bytes
// become one character each, others two, the first of which is one of a few reserved for that. So repetitions in the
// bytes are repetitions in the text. No character needs an escape, neither in a string, nor in HTML, nor in any
// encoding of the page. src/kernel/load.ts reads it.
import { bitsOf } from './compile.mjs';
import { apart } from './streams.mjs';

/** Printable ASCII, without characters that are special in strings or HTML. */
const characters = Array.from({ length: 94 }, (_, k) => String.fromCharCode(33 + k)).filter(
  (character) => !'\'"`\\$<&'.includes(character),
);
/** This many of them begin a pair. */
const prefixes = 3;
const single = characters.length - prefixes;

/**
 * A part of a stream has about as many characters: what it has for two and for three dimensions is in one window of gzip,
 * and V8 does not compute a hash of so long a literal.
 */
const partLength = 24_000;
/** Functions for both dimensions, those for two, those for three. */
const owned = [0, 2, 3];

/** A number below 256 as a pair. */
const pairOf = (number) => characters[Math.floor(number / characters.length)] + characters[number % characters.length];

/** The text of each byte, the most frequent first, and how the text of a module begins: with those that are short. */
function alphabetOf(bytes) {
  const often = new Uint32Array(256);
  for (const byte of bytes) often[byte]++;
  const sorted = Array.from(often.keys()).sort((a, b) => often[b] - often[a] || a - b);
  const short = sorted.slice(0, single);
  const rare = sorted.slice(single).sort((a, b) => a - b);
  const written = [];
  for (const [k, byte] of short.entries()) written[byte] = characters[prefixes + k];
  for (const [k, byte] of rare.entries()) written[byte] = pairOf(k);
  return { written, start: short.map(pairOf).join('') };
}

/** A part of the text: what is for both dimensions, for two, for three; and where each ends. */
const partOf = (texts) => ({
  text: texts.join(''),
  ends: [0, ...texts.map((_, k) => texts.slice(0, k + 1).join('').length)],
});

/** A stream in parts. `texts`: of each function. */
function partsOf(texts, owners) {
  const parts = [];
  let length = partLength;
  for (const [k, text] of texts.entries()) {
    if (length >= partLength) {
      parts.push(owned.map(() => ''));
      length = 0;
    }
    parts.at(-1)[owned.indexOf(owners[k])] += text;
    length += text.length;
  }
  return parts.map(partOf);
}

/**
 * A module of WebAssembly as text, in parts. The first part begins with the bytes that are one character each, as pairs;
 * of all others, the pair is their place among them. Then it has counts, how many characters each stream has, and what is
 * not code. The others are parts of streams: what is for both dimensions, for two, for three. `owners`: for each function,
 * the dimensions that it is for, or 0 for both.
 */
export function inline(wasm, owners = []) {
  const { kinds, kindCount, before, behind, functions } = apart(wasm);
  const owning = functions.map((_, k) => owners[k] ?? 0);
  const { written, start } = alphabetOf([kinds, before, owning, behind, functions].flat(3));
  const textOf = (bytes) => bytes.map((byte) => written[byte]).join('');
  const streams = functions[0].map((_, s) => functions.map((streams) => textOf(streams[s])));
  const around = [before, owning, behind].map(textOf);
  const lengthOf = (texts) => texts.join('').length;
  const lengths = [
    ...around.map(({ length }) => length),
    ...owned.flatMap((owner) => streams.map((texts) => lengthOf(texts.filter((_, k) => owning[k] === owner)))),
  ];
  const head = [functions.length, kindCount, ...lengths].flatMap((n) => [n & 255, (n >> 8) & 255, n >> 16]);
  const first = start + textOf(head) + textOf(kinds) + around.join('');
  return [partOf([first, '', '']), ...streams.flatMap((texts) => partsOf(texts, owning))];
}

/** A kernel as a module of TypeScript, with how it is decoded, and what it knows. */
export function moduleOf(wasm, owners, decoder, techniques, dimensions) {
  const parts = inline(wasm, dimensions.length > 1 ? owners : []);
  const lines = [
    '// Made by scripts/kernel.mjs from kernel/: do not edit.',
    'export const text: readonly { text: string; ends: readonly number[] }[] = [',
    ...parts.map(({ text, ends }) => `  { text: '${text}', ends: [${ends.join(', ')}] },`),
    '];',
    `export const decoder: readonly number[] = [${decoder.join(', ')}];`,
    `export const techniques: number = ${bitsOf(techniques)};`,
    `export const dimensions: readonly (2 | 3)[] = [${dimensions.join(', ')}];`,
    `export type Technique = ${techniques.map((technique) => `'${technique}'`).join(' | ')};`,
  ];
  return `${lines.join('\n')}\n`;
}
