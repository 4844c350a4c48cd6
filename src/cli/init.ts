// `broadphase init`: copies starter/, a small game to start from, into a new folder.
import { existsSync } from 'node:fs';
import { cp, mkdir, readdir, readFile, rm, writeFile } from 'node:fs/promises';
import path, { basename, dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { devDependencies, version } from '../../package.json' with { type: 'json' };
import { type Command, exitCode, UsageError } from './arguments.ts';
import { FileError } from './files.ts';

/** Beside the built command, or else in the repository. */
const starter = ['./starter/', '../../starter/']
  .map((path) => fileURLToPath(new URL(path, import.meta.url)))
  .find((path) => existsSync(path));

/** A name that npm accepts. */
const nameOf = (folder: string) =>
  basename(folder)
    .toLowerCase()
    .replace(/[^a-z0-9-]+/g, '-')
    .replace(/^-+|-+$/g, '') || 'my-game';

const manifestOf = (folder: string, spec: string) => ({
  name: nameOf(folder),
  private: true,
  type: 'module',
  scripts: { start: 'vite --open', build: 'tsc && vite build' },
  dependencies: { broadphase: spec },
  devDependencies: { typescript: devDependencies.typescript, vite: devDependencies.vite },
});

/**
 * The tarball or the clone that the surrounding project has installed, if any: for a package that is not on npm. The
 * project is the nearest folder, from the current one up, whose package.json names the package.
 */
async function installedHere(): Promise<string | undefined> {
  for (let folder = process.cwd(); ; folder = dirname(folder)) {
    const manifest = await readFile(join(folder, 'package.json'), 'utf8').catch(() => '');
    const [, spec] = /"broadphase"\s*:\s*"([^"]+)"/.exec(manifest) ?? [];
    if (spec !== undefined) {
      const [, path] = /^file:(.+)$/.exec(spec) ?? [];
      return path !== undefined && existsSync(resolve(folder, path)) ? resolve(folder, path) : undefined;
    }
    if (dirname(folder) === folder) return undefined;
  }
}

/** Where a package.json in `folder` finds a file, in the form that npm writes on every system: teams use several. */
export const fileSpec = (folder: string, file: string, { relative, resolve, sep } = path): string =>
  `file:${relative(folder, resolve(file)).replaceAll(sep, '/')}`;

/** A path as a word of a shell. */
const shellWord = (path: string) => (/^[\w./\\:~@%+-]+$/.test(path) ? path : `"${path.replace(/["$`]/g, '\\$&')}"`);

export const initCommand: Command = {
  summary: 'create a small game to start from, with Vite and TypeScript',
  operands: { folder: 'a new or empty folder, which may have a .git in it' },
  options: {
    package: {
      value: 'file',
      help: 'a tarball of broadphase to install, instead of the one that this project has, or the version on npm',
    },
  },
  async run(input, terminal) {
    const [name] = input.operands;
    if (name.trim() === '') throw new UsageError('the folder has no name, expected a new or empty folder');
    const folder = resolve(name);
    const given = input.text('package');
    if (given !== undefined && !existsSync(given)) throw new FileError(`cannot read ${given}: there is no such file`);
    const installed = given ?? (await installedHere());
    // Nothing is written to, nor removed from, a folder that cannot be looked into.
    const there = await readdir(folder).catch((error: NodeJS.ErrnoException): string[] => {
      if (error.code === 'ENOENT') return [];
      throw new FileError(`cannot write ${name}: ${error.message}`);
    });
    // A repository that was made first has no files of its own yet.
    if (there.some((each) => each !== '.git'))
      throw new UsageError(`${name} is not empty, expected an empty or new folder`);
    const spec = installed === undefined ? `^${version}` : fileSpec(folder, installed);
    let made: string | undefined; // the first folder on the path that was not there
    try {
      made = await mkdir(folder, { recursive: true });
      await cp(starter!, folder, { recursive: true });
      await writeFile(join(folder, 'package.json'), `${JSON.stringify(manifestOf(folder, spec), null, 2)}\n`);
      await writeFile(join(folder, '.gitignore'), 'node_modules\ndist\n'); // npm does not pack files of this name
    } catch (error) {
      // The folder was empty or new, so all that is there was written above, but for what was found.
      const written = made === undefined ? await readdir(folder).catch(() => []) : [made];
      for (const each of written)
        if (!there.includes(each)) await rm(resolve(folder, each), { recursive: true, force: true }).catch(() => {});
      throw new FileError(`cannot write ${name}: ${(error as Error).message}`);
    }
    if (input.has('json')) terminal.out(`${JSON.stringify({ folder, broadphase: spec })}\n`);
    else terminal.out(`${name} is ready. Now:\n\n  cd ${shellWord(name)}\n  npm install\n  npm start\n`);
    return exitCode.ok;
  },
};
