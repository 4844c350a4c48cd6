// The rules that keep rooms small: a file of at most 500 lines, a function of at most 60, a class of at most 25 members.
// Members are what an object holds. Each is read off the indentation, which the formatters see to.
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { expect, test } from 'vitest';

const mostLines = 500;
const mostOfFunction = 60;
const mostMembers = 25;

const files = execFileSync('git', ['ls-files', 'kernel/*.hpp', 'kernel/*.cpp', 'src/*.ts'], { encoding: 'utf8' })
  .trim()
  .split('\n')
  .filter((file) => !file.includes('generated') && !file.startsWith('kernel/test/'))
  .map((file) => ({ file, lines: readFileSync(file, 'utf8').trimEnd().split('\n') }));

/** The blocks that begin with a line like this one, each with the lines inside of it. */
function blocks(lines: readonly string[], begins: RegExp) {
  return lines.flatMap((line, from) => {
    const match = begins.exec(line);
    if (!match) return [];
    const indent = /^ */.exec(line)![0];
    const end = lines.findIndex((other, k) => k > from && other.startsWith(`${indent}}`));
    return end < 0 ? [] : [{ match, from, inside: lines.slice(from + 1, end) }];
  });
}

/** How many fields a line declares that stands in a class of C++. */
function fieldsOfCpp(code: string): number {
  if (!code.endsWith(';') || /^(using|friend|static|enum|struct|class|public|private|template|typedef)\b/.test(code))
    return 0;
  let plain = code;
  for (let before = ''; before !== plain; ) {
    before = plain;
    plain = plain.replace(/<[^<>]*>|\{[^{}]*\}|\[[^[\]]*\]/g, '');
  }
  if (/\(/.test(plain.split('=')[0]!)) return 0;
  return plain.split(',').length;
}

const fieldOfTs = /^(?:(?:declare|private|protected|public|readonly|override) )*#?[\w$]+[!?]?(?::|;| =)/;

function membersOf(file: string, inside: readonly string[]): number {
  const own = inside.filter((line) => /^ {2}[^\s}/*]/.test(line)).map((line) => line.trim().replace(/\s*\/\/.*/, ''));
  if (file.endsWith('.ts')) return own.filter((line) => fieldOfTs.test(line)).length;
  return own.reduce((sum, line) => sum + fieldsOfCpp(line), 0);
}

test(`a file has at most ${mostLines} lines`, () => {
  const tooLarge = files.filter(({ lines }) => lines.length > mostLines);
  expect(tooLarge.map(({ file, lines }) => `${file}: ${lines.length} lines`)).toEqual([]);
});

test(`a function has at most ${mostOfFunction} lines`, () => {
  const begins = /^ {0,2}(?!\s|(?:\}|if|for|while|switch|do|else|namespace|export class|class|struct)\b)[^=]*\(.*\{$/;
  const found = files.flatMap(({ file, lines }) => blocks(lines, begins).map((block) => ({ file, ...block })));
  expect(found.length).toBeGreaterThan(900);
  const tooLarge = found.filter(({ inside }) => inside.length > mostOfFunction);
  expect(tooLarge.map(({ file, from, inside }) => `${file}:${from + 1}: ${inside.length} lines`)).toEqual([]);
});

test(`a class has at most ${mostMembers} members`, () => {
  const begins = /^(?:template <.*> )?(?:export )?(?:abstract )?(?:class|struct) (\w+)[^;]*\{$/;
  const found = files.flatMap(({ file, lines }) =>
    blocks(lines, begins).map(({ match, from, inside }) => {
      const members = membersOf(file, inside);
      return { members, where: `${file}:${from + 1}: ${match[1]} has ${members} members` };
    }),
  );
  expect(found.length).toBeGreaterThan(100);
  expect(found.some(({ members }) => members > 10)).toBe(true);
  expect(found.filter(({ members }) => members > mostMembers).map(({ where }) => where)).toEqual([]);
});
