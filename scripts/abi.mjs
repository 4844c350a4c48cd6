// What the kernel and the library have in common, read out of kernel/ and written as TypeScript: the exported functions,
// enumerations, places and constants by name. So C++ states each once, and TypeScript that misses one does not compile.
// If the members of an enumeration have texts for users, these are the comments after them.
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { techniqueNames } from './compile.mjs';

const root = fileURLToPath(new URL('..', import.meta.url));
const read = (file) => readFileSync(join(root, 'kernel', file), 'utf8');

const camel = (name) => name.replace(/_(\w)/g, (_, letter) => letter.toUpperCase());
const constant = (name, value) => `export const ${name} = ${value};`;
const list = (name, words) => `export const ${name} = [\n${words.map((word) => `  '${word}',\n`).join('')}] as const;`;

/** The text between the braces after `head`. */
function bodyOf(file, head) {
  const text = read(file);
  const at = text.indexOf(`${head} {`);
  if (at < 0) throw new Error(`kernel/${file} has no "${head}", expected it for src/generated/abi.ts`);
  return text.slice(text.indexOf('{', at) + 1, text.indexOf('}', at));
}

const membersOf = (file, head) => [...bodyOf(file, head).matchAll(/(\w+)(?: = (\w+))?(?=\s*(?:,|$))/gm)];
const namesOf = (file, head) => membersOf(file, head).map(([, name]) => name);

/** The members of an enumeration as constants: its number for each. */
const places = (file, head) => membersOf(file, head).map(([, name, value], k) => constant(camel(name), value ?? k));

/** A constant of C++, under its own name or another one. */
function number(file, name, as = camel(name)) {
  const value = new RegExp(`constexpr [^;]*\\b${name} = (-?\\d+)[,;]`).exec(read(file))?.[1];
  if (value === undefined)
    throw new Error(`kernel/${file} has no constant "${name}", expected it for src/generated/abi.ts`);
  return constant(as, value);
}

/** The comments after the members. */
const wordsOf = (file, head) => [...bodyOf(file, head).matchAll(/^\s*\w+,\s*\/\/ (.*)$/gm)].map(([, words]) => words);

/** A function of kernel/abi.cpp, as a method. */
function method([, name, given, result]) {
  const parameters = given.split(',').flatMap((each) => /(\w+)\s*$/.exec(each)?.[1] ?? []);
  const type = result.trim() === 'void' ? 'void' : 'number';
  return `  ${name}(${parameters.map((each) => `${each}: number`).join(', ')}): ${type};`;
}

/** The module of TypeScript. */
export function abi() {
  const source = read('abi.cpp');
  const exports = [...source.matchAll(/EXPORT\((\w+)\)\(([^)]*)\) -> ([^{]+)\{/g)].map(method);
  const stats = [...bodyOf('search/stats.hpp', 'struct Stats').matchAll(/f64 (\w+) =/g)].map(([, name]) => name);
  const asks = namesOf('questions/bulk.hpp', 'enum class Asks : u32');
  return [
    '// Made by scripts/abi.mjs from kernel/: do not edit.',
    '/** The exported functions of kernel/abi.cpp. Addresses come as signed numbers: `>>> 0` those that can be beyond 2 GiB. */',
    'export interface KernelExports {',
    '  memory: WebAssembly.Memory;',
    '  __stack_pointer: WebAssembly.Global;',
    ...exports,
    '}',
    list('techniques', techniqueNames()),
    list('reasons', wordsOf('search/stats.hpp', 'enum class Reason : u32')),
    list('snapshotFaults', namesOf('space/snapshot.hpp', 'enum class SnapshotFault : u32')),
    list('broken', wordsOf('space/space.hpp', 'enum class Broken : u32')),
    '/** Numbers in the array `io`, and places in it. */',
    constant('ioLength', /f64 io\[(\d+)\]/.exec(source)[1]),
    ...places('abi.cpp', 'enum Place : u32'),
    '/** Places of what read_log writes, and the functions for pairs with another space. */',
    ...places('abi.cpp', 'enum LogPlace : u32'),
    ...places('abi.cpp', 'enum MetPlace : u32'),
    '/** Places of what get_rule writes. */',
    ...places('space/own.hpp', 'enum RulePlace : u32'),
    '/** Places of the addresses that contents writes. */',
    ...places('space/store.hpp', 'enum ContentsPlace : u32'),
    '/** The newest format of snapshots that this version reads. */',
    number('space/snapshot.hpp', 'newest', 'newestSnapshot'),
    '/** Instead of a radius. */',
    number('questions/question.hpp', 'no_circle'),
    number('questions/question.hpp', 'within'),
    '/** The numbers that the ring tells. */',
    number('boxes/ring.hpp', 'head', 'ringHead'),
    '/** For the pairs with other spaces: how many sets of lists there are, and an answer: nothing has changed. */',
    number('space/questions.hpp', 'most_neighbours'),
    number('questions/neighbours.hpp', 'still'),
    '/** Places of the counters. */',
    constant('statsLength', stats.length),
    ...stats.map((name, place) => constant(`${name}Stat`, place)),
    '/** Kinds of queries that can be made many at once. */',
    constant('asks', `{ ${asks.map((name, number) => `${name}: ${number}`).join(', ')} }`),
    '/** Kinds of queries whose answers are in order. */',
    ...namesOf('abi.cpp', 'enum class Order : u32').map((name, number) => constant(camel(`order_${name}`), number)),
    '',
  ].join('\n');
}

/** Writes it where the library imports it from. */
export function writeAbi() {
  const file = join(root, 'src/generated/abi.ts');
  const text = abi();
  if (existsSync(file) && readFileSync(file, 'utf8') === text) return;
  mkdirSync(dirname(file), { recursive: true });
  writeFileSync(file, text);
}
