// Each folder of examples can be copied on its own, so files that several share are in each of them: the files of their
// pages, whose originals are in examples/page, and the version of the library.
//
//   npm run examples    writes both into the folders; test/house/example-folders.test.ts fails if that was forgotten
import { existsSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath, pathToFileURL } from 'node:url';

const examples = fileURLToPath(new URL('../examples/', import.meta.url));
const { version } = JSON.parse(readFileSync(new URL('../package.json', import.meta.url), 'utf8'));
const read = (path) => readFileSync(examples + path, 'utf8');

const packagesIn = (folder) =>
  readdirSync(examples + folder)
    .map((name) => folder + name)
    .filter((path) => path !== 'apart' && existsSync(`${examples}${path}/package.json`));

/** The folders with a package.json of their own, by their paths in examples/. */
export const folders = [...packagesIn(''), ...packagesIn('apart/')];

/** The contents of each shared file, by its path in examples/. */
export function expectedFiles() {
  const expected = new Map();
  for (const name of folders) {
    const manifest = JSON.parse(read(`${name}/package.json`));
    manifest.dependencies.broadphase = `^${version}`;
    expected.set(`${name}/package.json`, `${JSON.stringify(manifest, null, 2)}\n`);
    if (!existsSync(`${examples}${name}/page`)) continue;
    for (const file of readdirSync(`${examples}${name}/page`))
      if (existsSync(`${examples}page/${file}`)) expected.set(`${name}/page/${file}`, read(`page/${file}`));
  }
  const smallest = read('smallest/index.html').replace(/broadphase@[^/]+/, `broadphase@${version}`);
  return expected.set('smallest/index.html', smallest);
}

if (import.meta.url === pathToFileURL(process.argv[1] ?? '').href) {
  for (const [path, text] of expectedFiles()) writeFileSync(examples + path, text);
}
