// The published package: ES modules with their types, and the kernel beside them for hosts that load it themselves.
// Entries are built apart, so that who imports the library alone gets one file; to each other they are external.
// There are four of the library, which differ in the kernel: the lean one, `all`, with every technique, and `2d` and `3d`,
// of one dimension. The other entries use `all`. The types of all four stand on those of the lean one, so that a space of
// one can be passed on to another.
// script/ is the lean one for a plain <script> tag, where it is the global `broadphase`, minified; and for `require` where
// that cannot load modules, to be read and stepped through. CDNs send .cjs as something browsers do not run, so both are
// .js files, in a folder of scripts.
import { readFileSync } from 'node:fs';
import { defineConfig, type UserConfig } from 'tsdown';
import { withKernel } from './scripts/every-technique.mjs';

/** Engines read a script sooner if all its characters fit into a byte, those of comments too. */
const ascii: UserConfig['plugins'] = {
  name: 'ascii',
  generateBundle(_, files) {
    for (const file of Object.values(files)) if (file.type === 'chunk') file.code = inAscii(file.code);
  },
};
const inAscii = (code: string) =>
  code.replace(/[^\0-\x7f]/g, (character) => `\\u${character.charCodeAt(0).toString(16).padStart(4, '0')}`);

const common: UserConfig = { format: 'esm', platform: 'neutral', target: 'es2022', clean: false, plugins: [ascii] };
const types: UserConfig = {
  ...common,
  plugins: [],
  dts: { emitDtsOnly: true, compilerOptions: { stripInternal: true } },
};

/** For entries that import others of this package by their names, and find them beside themselves. */
const beside = (library: string): UserConfig => {
  const entries = { broadphase: library, 'broadphase/trace': './trace.js' };
  return { deps: { neverBundle: Object.keys(entries) }, outputOptions: { paths: entries } };
};

const folderOfScripts: UserConfig['plugins'] = {
  name: 'folder-of-scripts',
  generateBundle() {
    // `require` does not run index.js, but has the same types.
    const types = "// @ts-ignore TS1479: only the types are imported\nexport * from '../index.js';\n";
    const files = { 'package.json': '{ "type": "commonjs" }\n', 'broadphase.d.ts': types };
    for (const [fileName, source] of Object.entries(files)) this.emitFile({ type: 'asset', fileName, source });
  },
};

/** The parser of the command is part of it, and so is its licence of the package. */
const licenceOfParser: UserConfig['plugins'] = {
  name: 'licence-of-parser',
  generateBundle() {
    const source = readFileSync('node_modules/commander/LICENSE', 'utf8');
    this.emitFile({ type: 'asset', fileName: 'commander.LICENSE', source });
  },
};

export default defineConfig([
  { ...common, dts: false, clean: true, entry: { index: 'src/index.ts' }, copy: ['build/kernel.wasm'] },
  { ...types, entry: { index: 'src/index.ts', all: 'src/all.ts', '2d': 'src/2d.ts', '3d': 'src/3d.ts' } },
  ...Object.entries({ all: 'kernel', '2d': 'kernel-2d', '3d': 'kernel-3d' }).map(
    ([name, kernel]): UserConfig => ({
      ...common,
      dts: false,
      entry: { [name]: 'src/index.ts' },
      plugins: [ascii, withKernel(kernel)],
    }),
  ),
  {
    ...common,
    dts: false,
    entry: 'src/index.ts',
    format: 'umd',
    globalName: 'broadphase',
    minify: true,
    outDir: 'dist/script',
    outputOptions: { entryFileNames: 'broadphase.js' },
    plugins: [ascii, folderOfScripts],
  },
  {
    ...common,
    dts: false,
    entry: 'src/index.ts',
    format: 'cjs',
    sourcemap: true,
    outDir: 'dist/script',
    outputOptions: { entryFileNames: 'require.js' },
  },
  ...['trace', 'ro', 'shard', 'draw'].flatMap((name): UserConfig[] => [
    { ...common, ...beside('./all.js'), dts: false, entry: { [name]: `src/${name}/index.ts` } },
    { ...types, ...beside('./all.js'), entry: { [name]: `src/${name}/index.ts` } },
  ]),
  {
    ...common,
    ...beside('./all.js'),
    entry: { cli: 'src/cli/index.ts' },
    plugins: [ascii, licenceOfParser],
    copy: ['starter'],
    platform: 'node',
    dts: false,
    fixedExtension: false,
  },
]);
