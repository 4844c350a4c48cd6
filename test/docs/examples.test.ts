// Everything the documentation shows as code runs, and gives what it says: the examples of the doc comments, the guides
// and the README. TypeScript is checked as its readers' would be.
import { mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import * as library from 'broadphase';
import * as draw from 'broadphase/draw';
import * as ro from 'broadphase/ro';
import * as shard from 'broadphase/shard';
import * as trace from 'broadphase/trace';
import ts from 'typescript';
import { describe, expect, test } from 'vitest';
import { blocksIn, type Example, examplesIn, moduleOf } from '../support/doc-examples.ts';

const path = (file: string) => fileURLToPath(new URL(`../../${file}`, import.meta.url));
const read = (file: string) => readFileSync(path(file), 'utf8');
const filesIn = (folder: string, end: string) =>
  readdirSync(path(folder), { recursive: true, encoding: 'utf8' })
    .filter((file) => file.endsWith(end))
    .sort()
    .map((file) => `${folder}/${file}`);

/** What the examples of a comment may use without an import: all that its entry and the library itself give. */
const names = {
  broadphase: Object.keys(library),
  'broadphase/draw': Object.keys(draw),
  'broadphase/ro': Object.keys(ro),
  'broadphase/shard': Object.keys(shard),
  'broadphase/trace': Object.keys(trace),
};
const only = (folder: string) => {
  if (folder === 'ro') return { 'broadphase/ro': names['broadphase/ro'] };
  const entry = `broadphase/${folder}`;
  return entry in names
    ? { broadphase: names.broadphase, [entry]: names[entry as keyof typeof names] }
    : { broadphase: names.broadphase };
};

const comments = filesIn('src', '.ts').filter((file) => !/src\/(generated|cli|scenes)\//.test(file));
const texts = ['README.md', 'docs/entries.md', ...filesIn('docs/guides', '.md')];
const documented: { example: Example; module: ReturnType<typeof moduleOf> }[] = [
  ...comments.flatMap((file) =>
    examplesIn(file, read(file)).map((example) => ({ example, module: moduleOf(example, only(file.split('/')[1])) })),
  ),
  ...texts.flatMap((file) => blocksIn(file, read(file)).map((example) => ({ example, module: moduleOf(example, {}) }))),
];

const folder = path('build/documented');
rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
const written = documented.map(({ example, module }, k) => {
  const file = `${folder}/${k}.${example.language}`;
  // Who has installed the package has the kernel in it.
  writeFileSync(file, module.text.replaceAll('node_modules/broadphase/dist/', 'build/'));
  return file;
});

describe('the code that the documentation shows', () => {
  test('is there', () => expect(documented.length).toBeGreaterThan(100));

  test('says what it gives', () => {
    expect(documented.filter(({ module }) => module.checks === 0).map(({ example }) => example.name)).toEqual([]);
  });

  test('has no errors of types', { tags: 'long' }, () => {
    const { config } = ts.readConfigFile(path('tsconfig.json'), ts.sys.readFile);
    const { options } = ts.parseJsonConfigFileContent({ ...config, files: [], include: [] }, ts.sys, path(''));
    const program = ts.createProgram(
      written.filter((file) => file.endsWith('.ts')),
      { ...options, noUnusedLocals: false, noUnusedParameters: false },
    );
    const errors = ts.getPreEmitDiagnostics(program).map(({ file, start, messageText }) => {
      const index = file ? written.indexOf(file.fileName) : -1;
      const line = file && start !== undefined ? file.text.slice(0, start).split('\n').pop() : '';
      return `${documented[index]?.example.name ?? file?.fileName}: ${ts.flattenDiagnosticMessageText(messageText, '\n')}: ${line}`;
    });
    expect(errors).toEqual([]);
  });

  documented.forEach(({ example }, k) => {
    test(example.name, async () => {
      await import(/* @vite-ignore */ written[k]);
    });
  });
});
