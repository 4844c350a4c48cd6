// What the documents in Markdown name is there: files that they link to, paths, commands of npm; and all files of the
// kernel and of the library stand in the map of ARCHITECTURE.md. Sentences and paragraphs are short.
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { basename, dirname, join, parse } from 'node:path';
import { fileURLToPath } from 'node:url';
import { describe, expect, test } from 'vitest';

const root = fileURLToPath(new URL('../..', import.meta.url));
const read = (file: string) => readFileSync(join(root, file), 'utf8');

/** What is installed, built or left behind by tests, in whatever folder. */
const made = ['node_modules', 'build', 'dist', 'generated', 'coverage', 'test-results'];
const folders = ['kernel', 'src', 'site', 'bench', 'docs', 'examples', 'consumers', 'recordings', 'scripts', 'test'];

/** All files in a folder, by their paths from the root. */
function filesIn(folder: string): string[] {
  return readdirSync(join(root, folder), { withFileTypes: true }).flatMap((entry) => {
    const path = folder ? `${folder}/${entry.name}` : entry.name;
    if (!entry.isDirectory()) return path;
    return made.includes(entry.name) || (folder === '' && !folders.includes(entry.name)) ? [] : filesIn(path);
  });
}

const files = filesIn('');
const documents = files.filter((file) => file.endsWith('.md')).map((file) => [file, read(file)] as const);
const matches = (text: string, pattern: RegExp) => Array.from(text.matchAll(pattern), ([, found]) => found!);

describe.each(documents)('%s', (document, text) => {
  test('links to files that exist', () => {
    const links = matches(text, /\]\(([^)\s#]+)[^)]*\)/g).filter((link) => !/^\w+:/.test(link));
    expect(links.filter((link) => !existsSync(join(root, dirname(document), link)))).toEqual([]);
  });

  test('names paths that exist', () => {
    const paths = matches(text, /`([\w.-]+\/[\w./-]*)`/g).filter((path) => folders.includes(path.split('/')[0]!));
    const places = (path: string) => [join(root, path), join(root, dirname(document), path)];
    expect(paths.filter((path) => !places(path).some(existsSync))).toEqual([]);
  });

  test('names commands that exist', () => {
    const { scripts } = JSON.parse(read('package.json'));
    expect(matches(text, /[`\n]npm run ([\w:]+)/g).filter((name) => !(name in scripts))).toEqual([]);
    expect(matches(text, /`node (\w+\/[\w/.-]+\.mjs)/g).filter((path) => !existsSync(join(root, path)))).toEqual([]);
  });
});

/** The paragraphs of running text: no code, tables or headings; each item of a list is one. */
const paragraphs = (text: string) =>
  text
    .replaceAll(/^```[\s\S]*?^```/gm, '')
    .split(/\n\s*\n|\n(?=\s*(?:[-*]|\d+\.) )/)
    .filter((paragraph) => !/^\s*[|#<]/.test(paragraph) && paragraph.trim() !== '');
const sentences = (paragraph: string) => paragraph.split(/(?<=[.!?])\s+/);
const words = (text: string) => text.trim().split(/\s+/).length;

describe('prose', () => {
  test.each(documents)('%s has no sentence above 45 words, no paragraph above 90', (_, text) => {
    const found = paragraphs(text);
    expect(found.filter((paragraph) => words(paragraph) > 90)).toEqual([]);
    expect(found.flatMap(sentences).filter((sentence) => words(sentence) > 45)).toEqual([]);
  });

  test('has at most 18 words a sentence in the mean', () => {
    const all = documents.flatMap(([, text]) => paragraphs(text).flatMap(sentences));
    expect(all.length).toBeGreaterThan(500);
    expect(all.reduce((sum, sentence) => sum + words(sentence), 0) / all.length).toBeLessThan(18);
  });
});

test('each `vitest run` that a document names runs something', () => {
  const asked = documents.flatMap(([, text]) => matches(text, /vitest run --project unit ([\w/-]+)/g));
  expect(asked.length).toBeGreaterThan(4);
  expect(asked.filter((name) => !files.some((file) => file.endsWith('.test.ts') && file.includes(name)))).toEqual([]);
});

test('docs/promises.md gives the numbers of cases and sequences that there are', () => {
  const promises = read('docs/promises.md');
  const cases = Object.keys(JSON.parse(read('test/promises/determinism/golden.json'))).length;
  const sequences = files.filter((file) => file.startsWith('kernel/test/corpus/')).length;
  expect(matches(promises, /(\d+) cases\. Sixteen/g)).toEqual([String(cases)]);
  expect(matches(promises, /saved corpus is (\d+) sequences/g)).toEqual([String(sequences)]);
});

describe('ARCHITECTURE.md', () => {
  const architecture = read('ARCHITECTURE.md');
  const [map] = matches(architecture, /## The map\n\n```\n([\s\S]*?)```/g);
  const sources = files.filter((file) => /\.(hpp|cpp|m?ts|mjs|json)$/.test(file));

  test('has every file of the kernel and of the library in its map', () => {
    const words = new Set(map!.match(/[\w-]+/g));
    const own = files
      .filter((file) => /^(kernel(\/(?!test|techniques)\w+)?|src)\/[^/]+$/.test(file))
      .map((file) => parse(file).name);
    expect(own.length).toBeGreaterThan(40);
    expect(own.filter((name) => !words.has(name))).toEqual([]);
  });

  test('names files that exist', () => {
    const known = new Set(files.map((file) => basename(file)));
    const named = matches(architecture, /([\w-]+(?:\.[\w-]+)*\.(?:hpp|cpp|ts|mjs|json))\b/g);
    expect(named.length).toBeGreaterThan(30);
    expect(named.filter((name) => !known.has(name))).toEqual([]);
  });

  test('names what stands in the sources', () => {
    const text = sources
      .filter((file) => file !== 'test/docs/markdown.test.ts')
      .map(read)
      .join('\n');
    const names = matches(architecture.replaceAll(/```[\s\S]*?```/g, ''), /`([^`]+)`/g).flatMap((code) =>
      code.split(/[^\w-]+/).filter((name) => name !== ''),
    );
    expect(names.length).toBeGreaterThan(40);
    const unknown = names.filter((name) => !new RegExp(`(?<![\\w-])${name}(?![\\w-])`).test(text));
    expect(unknown.filter((name) => !files.some((file) => file.includes(name)))).toEqual([]);
  });
});
