// What is published brings nothing along: no dependencies, no scripts that run when it is installed.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect, test } from 'vitest';

const manifest = JSON.parse(readFileSync(fileURLToPath(new URL('../../package.json', import.meta.url)), 'utf8'));

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
