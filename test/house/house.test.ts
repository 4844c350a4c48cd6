// The rules that keep the house in order, each as a test that names file and line: nothing is dead, nothing goes in a
// circle, one name is one number, a map is no longer than a map.
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { posix } from 'node:path';
import { describe, expect, test } from 'vitest';

const tracked = execFileSync('git', ['ls-files'], { encoding: 'utf8' })
  .trim()
  .split('\n')
  .filter((file) => existsSync(file));
const texts = new Map(
  tracked
    .filter(
      (file) => /\.(hpp|cpp|m?ts|m?js|jsx|cjs|html|json|md|yml)$/.test(file) && !file.endsWith('package-lock.json'),
    )
    .map((file) => [file, readFileSync(file, 'utf8')]),
);
const code = [...texts.keys()].filter((file) => /\.(hpp|cpp|m?ts|mjs)$/.test(file) && !file.includes('generated'));

const lineOf = (text: string, index: number) => text.slice(0, index).split('\n').length;

/** Every word of every file, and the files it stands in. */
const filesByWord = new Map<string, Set<string>>();
for (const [file, text] of texts) {
  for (const word of new Set(text.match(/[\w$]+/g))) {
    if (!filesByWord.has(word)) filesByWord.set(word, new Set());
    filesByWord.get(word)!.add(file);
  }
}

/** What a file includes or imports of this repository, types apart, with the lines. */
function uses(file: string): [used: string, line: number][] {
  const text = texts.get(file)!;
  const found = text.matchAll(
    /^(?:#include "([^"]+)"|(?:import|export)\s(?!type\s)[^;'"]*?from '(\.[^']+)'|import '(\.[^']+)')/gm,
  );
  return [...found].flatMap((match) => {
    const name = (match[1] ?? match[2] ?? match[3])!;
    const used = [posix.dirname(file), 'kernel']
      .map((folder) => posix.join(folder, name.replace(/\?.*/, '')))
      .find((each) => texts.has(each));
    return used === undefined ? [] : ([[used, lineOf(text, match.index)]] as [string, number][]);
  });
}

describe('the house', () => {
  test('has no include and no import that goes in a circle', () => {
    const done = new Set<string>();
    const circles: string[] = [];
    const visit = (file: string, way: readonly string[]) => {
      if (done.has(file)) return;
      for (const [used, line] of uses(file)) {
        const at = [...way, file].indexOf(used);
        if (at >= 0) circles.push(`${file}:${line}: ${[...way, file].slice(at).join(' -> ')} -> ${used}`);
        else visit(used, [...way, file]);
      }
      done.add(file);
    };
    for (const file of code) visit(file, []);
    expect(circles).toEqual([]);
  });

  test('imports nothing from a floor above', () => {
    // The library, its other entries, the command, and all that uses, measures and proves them.
    const floors = [
      /^src\/(?!(cli|ro|trace|shard|draw|scenes)\/)/,
      /^src\/(ro|trace|shard|draw|scenes)\//,
      /^src\/cli\//,
      /^(site|examples|scripts|consumers|starter|bench|test)\//,
    ];
    const floorOf = (file: string) => floors.findIndex((floor) => floor.test(file));
    const upward = code
      .filter((file) => floorOf(file) >= 0 && !/\.test\.mjs$/.test(file))
      .flatMap((file) => uses(file).map(([used, line]) => ({ file, used, line })))
      .filter(({ file, used }) => floorOf(used) > floorOf(file))
      .map(({ file, used, line }) => `${file}:${line}: ${used}`);
    expect(upward).toEqual([]);
  });

  test('has no file of code that nothing names', () => {
    // What is found by its name, or run by hand, or is a page, an example or a place to try the package from.
    const found = /^(examples|consumers|starter|bench\/(askers|peers|native)|kernel\/test|site\/article\/figures)\//;
    const entry = /\.(test|spec|test-d)\.m?ts$|\.test\.mjs$|\.d\.mts$|\.config\./;
    const unused = code.filter((file) => {
      if (found.test(file) || entry.test(file)) return false;
      const { name } = posix.parse(file);
      const others = [...texts].filter(([other]) => other !== file);
      return !others.some(([, text]) => text.includes(`${name}.`) || text.includes(`${name}'`));
    });
    expect(unused).toEqual([]);
  });

  test('exports nothing that no other file names', () => {
    const dead = code
      .filter((file) => /^(src|site|bench|scripts)\/.*\.(ts|mjs)$/.test(file))
      .flatMap((file) => {
        const found = texts.get(file)!.matchAll(/^export (?:const|function\*?|async function|class|let) ([\w$]+)/gm);
        return [...found]
          .filter(({ 1: name }) => filesByWord.get(name!)!.size < 2)
          .map(({ 1: name, index }) => `${file}:${lineOf(texts.get(file)!, index)}: ${name}`);
      });
    expect(dead).toEqual([]);
  });

  test('has no function in a header of the kernel that the kernel names once', () => {
    const headers = code.filter((file) => /^kernel\/(?!test).*\.(hpp|cpp)$/.test(file));
    const bare = new Map(headers.map((file) => [file, texts.get(file)!.replace(/\/\/.*$/gm, '')]));
    const counts = new Map<string, number>();
    for (const [word] of [...bare.values()].join(' ').matchAll(/\w+/g)) counts.set(word, (counts.get(word) ?? 0) + 1);
    const functions = /^(?: {2})?(?:\w[\w<>:,*& ]*[ *&])([a-z]\w*)\(/gm;
    const found = [...bare]
      .filter(([file]) => file.endsWith('.hpp'))
      .flatMap(([file, text]) =>
        [...text.matchAll(functions)].map(({ 1: name, index }) => ({ name, line: `${file}:${lineOf(text, index)}` })),
      );
    expect(found.length).toBeGreaterThan(500);
    expect(found.filter(({ name }) => counts.get(name!) === 1)).toEqual([]);
  });

  test.each(['package.json', 'site/package.json'])('has no package in %s that nothing uses', (manifest) => {
    const { scripts = {}, devDependencies } = JSON.parse(texts.get(manifest)!);
    const all = [...texts].filter(([file]) => !file.endsWith('package.json')).map(([, text]) => text);
    // Called by another name, or by the one that they are a part of.
    const calls: Record<string, string> = { '@arethetypeswrong/cli': 'attw ', '@size-limit/esbuild': 'size-limit' };
    const unused = Object.keys(devDependencies).filter((name) => {
      const called = calls[name] ?? name.replace(/^@types\//, '').replace('@size-limit/file', 'size-limit');
      return ![...all, JSON.stringify(scripts)].some((text) => text.includes(called));
    });
    expect(unused).toEqual([]);
  });

  test('leaves nothing to be done in a comment', () => {
    const mark = new RegExp(`\\b(${['TO' + 'DO', 'FIX' + 'ME', 'X' + 'XX'].join('|')})\\b`, 'g');
    const found = code.flatMap((file) =>
      [...texts.get(file)!.matchAll(mark)].map(({ index }) => `${file}:${lineOf(texts.get(file)!, index)}`),
    );
    expect(found).toEqual([]);
  });

  test('has one number for one name among headers that meet', () => {
    // Of a file or of a class: what is named in a function is known there alone.
    const constant = /^(?:(?:inline )?| {2}static )constexpr (?:u8|u16|u32|u64|i32|f32|f64) ([^;(]+);/gm;
    const values = new Map<string, Map<string, string[]>>();
    for (const file of code.filter((each) => /^kernel\/(?!test).*\.hpp$/.test(each))) {
      for (const match of texts.get(file)!.matchAll(constant)) {
        for (const one of match[1]!.split(/, (?=\w+ = )/)) {
          const [name, value] = one.split(' = ') as [string, string];
          const known = values.get(name) ?? new Map<string, string[]>();
          const where = `${file}:${lineOf(texts.get(file)!, match.index)}: ${name} = ${value}`;
          values.set(name, known.set(value, [...(known.get(value) ?? []), where]));
        }
      }
    }
    expect(values.size).toBeGreaterThan(120);
    expect([...values.values()].filter((all) => all.size > 1).map((all) => [...all.values()].flat())).toEqual([]);
  });

  test('has a map of at most 130 lines', () => {
    expect(texts.get('ARCHITECTURE.md')!.split('\n').length).toBeLessThanOrEqual(131);
  });

  test('has a glossary of at most 30 rows, with each word once', () => {
    const glossary = texts.get('CONTRIBUTING.md')!.split('## Glossary')[1]!;
    const rows = [...glossary.matchAll(/^\| ([^|]+) \| [^|]+ \|$/gm)].slice(2).map(([, words]) => words!);
    const words = rows.flatMap((row) => row.split(', '));
    expect(rows.length).toBeGreaterThan(20);
    expect(rows.length).toBeLessThanOrEqual(30);
    expect(words.filter((word, k) => words.indexOf(word) !== k)).toEqual([]);
  });

  test('lists each decision, on a page with its context and what was rejected', () => {
    const pages = tracked.filter((file) => /^docs\/decisions\/\d{4}-[\w-]+\.md$/.test(file)).sort();
    const listed = [...texts.get('docs/decisions/README.md')!.matchAll(/\]\((\d{4}-[\w-]+\.md)\)/g)];
    expect(listed.map(([, name]) => `docs/decisions/${name}`)).toEqual(pages);
    expect(pages.map((file) => Number(/\d{4}/.exec(file)![0]))).toEqual(pages.map((_, k) => k + 1));
    const parts = ['## Context', '## Decision', '## Rejected'];
    expect(pages.filter((file) => parts.some((part) => !texts.get(file)!.includes(`\n${part}\n`)))).toEqual([]);
  });

  test('uses `arguments` only in ways for which no engine allocates an object: Firefox took 2.6 times as long for `set`', () => {
    const places = code
      .filter((file) => /^src\/(?!cli\/)/.test(file))
      .flatMap((file) =>
        (texts.get(file) ?? '').split('\n').map((line) => ({ file, line: line.replace(/`.*?`|(\/\/|\*).*/g, '') })),
      )
      .filter(({ line }) => /\barguments\b/.test(line));
    expect(places.length).toBeGreaterThan(10);
    expect(places.filter(({ line }) => !/\barguments\.length\b|\.apply\(this, arguments\b/.test(line))).toEqual([]);
  });

  test('decides by counts of work: the kernel has no constant in units of time, and no clock', () => {
    const timed = /constexpr.*\/\/.*\b(?:ns|us|ms|nanoseconds|microseconds|milliseconds)\b|<(?:chrono|ctime)>/;
    const found = code
      .filter((file) => /^kernel\/(?!test)/.test(file))
      .flatMap((file) =>
        texts
          .get(file)!
          .split('\n')
          .flatMap((line, k) => (timed.test(line) ? `${file}:${k + 1}` : [])),
      );
    expect(found).toEqual([]);
  });
});
