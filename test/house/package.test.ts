// What is published brings nothing along: no dependencies, no scripts that run when it is installed.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect, test } from 'vitest';

const read = (file: string) => readFileSync(fileURLToPath(new URL(`../../${file}`, import.meta.url)), 'utf8');
const manifest = JSON.parse(read('package.json'));

test('the package has no dependencies at run time', () => {
  for (const kind of ['dependencies', 'peerDependencies', 'optionalDependencies', 'bundledDependencies']) {
    expect(manifest[kind]).toBe(undefined);
  }
});

test('nothing runs when the package is installed', () => {
  for (const name of ['preinstall', 'install', 'postinstall', 'prepare', 'prepublish', 'preprepare', 'postprepare']) {
    expect(manifest.scripts[name]).toBe(undefined);
  }
});

test('only the build and the changelog are published', () => {
  expect(manifest.files).toEqual(['dist', 'CHANGELOG.md']);
});

test.each([
  ['docs/entries.md', /`broadphase` \|.*\| about (\d+) kB/, 'broadphase'],
  ['docs/entries.md', /imports `findPairs` alone .* has about (\d+) kB/, 'findPairs alone'],
  ['docs/entries.md', /`broadphase\/all` \|.*\| (\d+) kB more/, 'broadphase/all', 'broadphase'],
  ['docs/command.md', /costs (\d+) kB more to load/, 'broadphase/all', 'broadphase'],
  ['README.md', /a page loads about (\d+) kB, gzipped/, 'broadphase'],
  ['README.md', /one dimension each, and about (\d+) and/, 'broadphase/2d'],
  ['README.md', /and about \d+ and (\d+) kB/, 'broadphase/3d'],
  ['README.md', /all thirteen techniques, and about (\d+) kB/, 'broadphase/all'],
  ['docs/guides/worth-it.md', /The library is about (\d+) kB gzipped/, 'broadphase'],
  ['docs/guides/worth-it.md', /or (\d+) kB with 2D alone/, 'broadphase/2d'],
  ['docs/guides/performance.md', /`broadphase\/ro` is (\d+) kB/, 'broadphase/ro, beside broadphase/all'],
  ['docs/guides/performance.md', /together about (\d+) kB gzipped/, 'broadphase/ro, with broadphase/all'],
  ['docs/guides/drawing.md', /It is about ([\d.]+) kB/, 'broadphase/draw'],
])('the size that %s says (%s) is that of the build', (document, said, whole, without = '') => {
  const [, kB] = said.exec(read(document)) ?? [];
  const limits = JSON.parse(read('.size-limit.json')) as { name: string; limit: string }[];
  const limit = (entry: string) => Number.parseFloat(limits.find(({ name }) => name === entry)?.limit ?? '0');
  expect(Math.abs(Number(kB) - (limit(whole) - limit(without)))).toBeLessThan(0.9);
});
