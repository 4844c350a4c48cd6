// What keeps a package with placeholder addresses from being published, and the README as npm shows it.
import { readFileSync, statSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect, test } from 'vitest';
import { placeholders, readmeForNpm } from '../../scripts/publish-folder.mjs';

const path = (file: string) => fileURLToPath(new URL(`../../${file}`, import.meta.url));
const real = {
  version: '1.2.3',
  repository: { url: 'git+https://github.com/someone/broadphase.git' },
  homepage: 'https://someone.github.io/broadphase/',
  bugs: { url: 'https://github.com/someone/broadphase/issues' },
};

test('names each address that is missing or a placeholder', () => {
  expect(placeholders(real)).toEqual([]);
  expect(placeholders({})).toEqual(['repository', 'homepage', 'bugs']);
  expect(placeholders({ ...real, homepage: 'https://broadphase.invalid/' })).toEqual(['homepage']);
});

test('files other than package.json have no address of their own', () => {
  const texts = ['README.md', 'SECURITY.md', 'CODE_OF_CONDUCT.md', 'CONTRIBUTING.md'].map((file) =>
    readFileSync(path(file), 'utf8'),
  );
  expect(texts.filter((text) => /github\.com\/[\w-]+\/broadphase|\.invalid/.test(text))).toEqual([]);
});

test('the README for npm has whole addresses', () => {
  const text = '[a](docs/a.md#b) [b](examples) [c](https://x.org) [d](#e) <img src="docs/p.gif" /><a srcset="q.png">';
  const home = 'https://github.com/someone/broadphase';
  expect(readmeForNpm(text, real, (file) => file === 'examples')).toBe(
    `[a](${home}/blob/v1.2.3/docs/a.md#b) [b](${home}/tree/v1.2.3/examples) [c](https://x.org) [d](#e) ` +
      `<img src="${home}/raw/v1.2.3/docs/p.gif" /><a srcset="${home}/raw/v1.2.3/q.png">`,
  );
});

test('no link of our README is left relative, and none leads nowhere', () => {
  const isFolder = (file: string) => statSync(path(file.split('#')[0]!)).isDirectory();
  const text = readmeForNpm(readFileSync(path('README.md'), 'utf8'), real, isFolder);
  const targets = Array.from(text.matchAll(/(?:\]\(|src(?:set)?=")([^)\s"]+)/g), ([, target]) => target!);
  expect(targets.length).toBeGreaterThan(20);
  expect(targets.filter((target) => !/^(https:|#)/.test(target))).toEqual([]);
});
