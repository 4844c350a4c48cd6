// Each folder of examples can be taken as it is: it names what it imports, imports nothing from outside itself, and has
// what it shares with others as it is written once. scripts/strangers.mjs then takes each, and starts it.
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { builtinModules } from 'node:module';
import { basename, dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { describe, expect, test } from 'vitest';
import { expectedFiles, folders } from '../../scripts/example-files.mjs';

const examples = fileURLToPath(new URL('../../examples/', import.meta.url));
const read = (path: string) => readFileSync(join(examples, path), 'utf8');

test('what the folders share is in each as it is written once (npm run examples)', () => {
  for (const [path, text] of expectedFiles()) expect(read(path), path).toBe(text);
});

test('each folder is a package, but those that need none', () => {
  const all = readdirSync(examples, { withFileTypes: true }).filter((entry) => entry.isDirectory());
  const without = all.map(({ name }) => name).filter((name) => !existsSync(join(examples, name, 'package.json')));
  expect(without.filter((name) => name !== 'node_modules').sort()).toEqual(['page', 'smallest', 'test']);
});

/** Everything that a file imports, links or uses as a style. */
function importsOf(file: string): string[] {
  const text = read(file);
  const patterns = [
    /^(?:import|export) (?:[^'"]*? from )?'([^']+)'/gm,
    /\bimport\('([^']+)'\)/g,
    /\.resolve\([`']([^`']+)[`']/g,
  ];
  if (file.endsWith('.html')) patterns.push(/(?:src|href)="([^":]+)"/g);
  return patterns.flatMap((pattern) => Array.from(text.matchAll(pattern), ([, name]) => name!));
}

describe.each(folders)('%s', (folder) => {
  const manifest = JSON.parse(read(`${folder}/package.json`));
  const files = readdirSync(join(examples, folder), { recursive: true, encoding: 'utf8' })
    .filter((file) => /\.(mjs|jsx|js|vue|html)$/.test(file) && !/node_modules|dist/.test(file))
    .map((file) => join(folder, file));

  test('names all that it imports, and nothing else', () => {
    const packages = files
      .flatMap(importsOf)
      .filter((name) => !/^[./]/.test(name) && !name.startsWith('node:') && !builtinModules.includes(name))
      .map((name) => /^(@[^/]+\/)?[^/]+/.exec(name)![0]);
    const used = new Set([...packages, 'broadphase']); // csp serves it, and imports it in the page alone
    if (manifest.scripts.start.startsWith('vite')) used.add('vite');
    const named = Object.keys({ ...manifest.dependencies, ...manifest.devDependencies });
    expect(named.sort()).toEqual([...used].sort());
  });

  test('imports nothing from outside', () => {
    for (const file of files) {
      for (const name of importsOf(file).filter((each) => each.startsWith('.'))) {
        const path = relative(folder, join(dirname(file), name));
        expect(path.startsWith('..'), `${file} imports ${name}`).toBe(false);
      }
    }
  });

  test('starts, and its first file says how', () => {
    expect(manifest).toMatchObject({ name: `broadphase-example-${basename(folder)}`, private: true, type: 'module' });
    expect(manifest.scripts.start).toMatch(/^(vite --open|node \w+\.mjs)$/);
    const first = ['index.mjs', 'index.jsx', 'serve.mjs'].find((file) => existsSync(join(examples, folder, file)))!;
    expect(read(`${folder}/${first}`).slice(0, 400)).toContain('npm i && npm start');
  });
});
