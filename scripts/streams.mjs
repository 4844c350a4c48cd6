// Splits a WebAssembly module into streams: opcodes in one, the numbers of locals in another, and so on. gzip makes it
// a fifth smaller than the module, since each stream is more repetitive than the mix. kernel/decoder.cpp reassembles
// the module byte for byte. From: executable packers, and Java's pack200 (W. Pugh, Compressing Java Class Files, 1999).

/**
 * In the order of the file, in which similar streams are next to each other for gzip. The first has the kinds of all
 * instructions, the second raw bytes, the others numbers in LEB128.
 */
const streams = ['kind', 'raw', 'locals', 'long', 'integer', 'offset', 'call', 'local', 'branch', 'small', 'block'];
/**
 * The most kinds of instructions. A kind is an opcode with those of its immediates that are not numbers of a stream.
 */
const mostKinds = 256;
/** The most bytes of an opcode, including its alignment. */
const longest = 4;

const codeSection = 10;
const branchTable = 0x0e;
const end = 0x0b;

/**
 * What follows each opcode: how many numbers of which stream; for `raw`, how many bytes; for `memory`, an alignment and
 * an offset. Opcodes without immediates have 0 numbers of `small`. The compiler's flags exclude all other opcodes.
 */
const immediates = new Map();
const opcodes = (from, to, ...what) => {
  for (let code = from; code <= to; code++) immediates.set(code, what);
};
const prefixed = (prefix, from, to, ...what) => opcodes(prefix * 0x1000 + from, prefix * 0x1000 + to, ...what);
for (const [from, to] of [
  [0x00, 0x01],
  [0x05, 0x05],
  [0x0b, 0x0b],
  [0x0f, 0x0f],
  [0x1a, 0x1b],
  [0x45, 0xc4],
])
  opcodes(from, to, 'small', 0);
prefixed(0xfc, 0, 7, 'small', 0);
prefixed(0xfd, 14, 0x113, 'small', 0);
opcodes(0x02, 0x04, 'block', 1); // blocks: their type
opcodes(0x0c, 0x0d, 'branch', 1); // branches: how far
opcodes(branchTable, branchTable, 'branch', 0); // as many as it says
opcodes(0x10, 0x10, 'call', 1);
opcodes(0x11, 0x11, 'small', 2);
opcodes(0x20, 0x22, 'local', 1);
opcodes(0x23, 0x24, 'small', 1); // globals
opcodes(0x28, 0x3e, 'memory', 1);
opcodes(0x3f, 0x40, 'small', 1); // memory.size, memory.grow: which memory
opcodes(0x41, 0x41, 'integer', 1);
opcodes(0x42, 0x42, 'long', 1);
opcodes(0x43, 0x43, 'raw', 4);
opcodes(0x44, 0x44, 'raw', 8);
prefixed(0xfc, 8, 8, 'small', 2); // memory.init
prefixed(0xfc, 9, 9, 'small', 1); // data.drop
prefixed(0xfc, 10, 10, 'small', 2); // memory.copy
prefixed(0xfc, 11, 11, 'small', 1); // memory.fill
prefixed(0xfd, 0, 11, 'memory', 1);
prefixed(0xfd, 12, 13, 'raw', 16); // a constant, a shuffle
prefixed(0xfd, 21, 34, 'small', 1); // which lane
prefixed(0xfd, 84, 91, 'memory', 2); // offset and lane
prefixed(0xfd, 92, 93, 'memory', 1);

/** Reads a module from `at` on. */
export class Reader {
  constructor(bytes, at = 0) {
    this.bytes = bytes;
    this.at = at;
  }

  byte() {
    return this.bytes[this.at++];
  }

  number() {
    let value = 0;
    for (let shift = 0; ; shift += 7) {
      const byte = this.byte();
      value += (byte & 127) * 2 ** shift;
      if (byte < 128) return value;
    }
  }

  /** The bytes of this many numbers. */
  numbers(count) {
    const from = this.at;
    for (let k = 0; k < count; k++) this.number();
    return this.bytes.subarray(from, this.at);
  }

  raw(count) {
    this.at += count;
    return this.bytes.subarray(this.at - count, this.at);
  }
}

/** The sections of a module: each with its number, where it begins and ends, and where its content begins. */
export function sectionsOf(wasm) {
  const reader = new Reader(wasm, 8);
  const sections = [];
  while (reader.at < wasm.length) {
    const from = reader.at;
    const id = reader.byte();
    const size = reader.number();
    sections.push({ id, from, at: reader.at, to: reader.at + size });
    reader.at += size;
  }
  return sections;
}

/** Where the functions of a module begin, and where they end; `count` of them. `section`: where its length is. */
export function codeOf(wasm) {
  const code = sectionsOf(wasm).find(({ id }) => id === codeSection);
  if (!code) throw new Error('the module has no code');
  const reader = new Reader(wasm, code.at);
  const count = reader.number();
  return { count, section: code.from + 1, from: reader.at, to: code.to };
}

/** One instruction: its kind (bytes, stream, numbers), and its numbers for the stream. */
function instruction(reader) {
  const from = reader.at;
  const opcode = reader.byte();
  const code = opcode >= 0xfc ? opcode * 0x1000 + reader.number() : opcode;
  if (!immediates.has(code)) throw new Error(`unknown opcode 0x${code.toString(16)}`);
  let [stream, count] = immediates.get(code);
  if (stream === 'memory') {
    reader.number(); // the alignment
    stream = 'offset';
  }
  const bytes = reader.bytes.subarray(from, reader.at);
  if (bytes.length > longest) throw new Error(`opcode ${code} has ${bytes.length} bytes, expected up to ${longest}`);
  if (opcode === branchTable) count = 2 + new Reader(reader.bytes, reader.at).number();
  return { opcode, bytes, stream, count, given: stream === 'raw' ? reader.raw(count) : reader.numbers(count) };
}

/** Every function as a list of instructions; the first stands for its locals. */
export function functionsOf(wasm, { count, from, to }) {
  const reader = new Reader(wasm, from);
  const functions = Array.from({ length: count }, () => {
    const size = reader.number();
    const last = reader.at + size;
    const groups = new Reader(wasm, reader.at).number();
    const locals = 1 + 2 * groups; // each group: how many, of which type
    const list = [{ bytes: [], stream: 'locals', count: locals, given: reader.numbers(locals) }];
    while (reader.at < last) list.push(instruction(reader));
    if (reader.at !== last || list.at(-1).opcode !== end)
      throw new Error(`a function ends at ${reader.at}, not ${last}`);
    list[list.length - 1] = { ...list.at(-1), last: true };
    return list;
  });
  if (reader.at !== to) throw new Error(`the code ends at ${reader.at}, not ${to}`);
  return functions;
}

const keyOf = ({ bytes, stream, count, last }) => [Number(!last), ...bytes, stream, count].join();

/** One instruction of each kind: first the one that ends functions, then the most frequent. */
function kindsOf(instructions) {
  const counts = new Map();
  const kinds = new Map();
  for (const one of instructions) {
    const key = keyOf(one);
    counts.set(key, one.last ? Number.POSITIVE_INFINITY : (counts.get(key) ?? 0) + 1);
    kinds.set(key, one);
  }
  if (kinds.size > mostKinds) throw new Error(`${kinds.size} kinds of instructions, expected up to ${mostKinds}`);
  return [...kinds].sort(([a], [b]) => counts.get(b) - counts.get(a) || (a < b ? -1 : 1)).map(([, one]) => one);
}

/**
 * The module apart: the kinds of instructions, one property after the other; the bytes before the size of the code, and
 * those behind the code; and of each function its bytes in each stream.
 */
export function apart(wasm) {
  const code = codeOf(wasm);
  const functions = functionsOf(wasm, code);
  const kinds = kindsOf(functions.flat());
  const numbers = new Map(kinds.map((one, k) => [keyOf(one), k]));
  const inStream = (name) => (one) => {
    if (name === 'kind') return numbers.get(keyOf(one));
    return one.stream === name ? [...one.given] : [];
  };
  return {
    kinds: [
      ...Array.from({ length: longest }, (_, k) => kinds.map(({ bytes }) => bytes[k] ?? 0)).flat(),
      ...kinds.map(({ bytes, stream }) => bytes.length * 16 + streams.indexOf(stream)),
      ...kinds.map(({ count }) => count),
    ],
    kindCount: kinds.length,
    before: [...wasm.subarray(0, code.section)],
    behind: [...wasm.subarray(code.to)],
    functions: functions.map((list) => streams.map((name) => list.flatMap(inStream(name)))),
  };
}
