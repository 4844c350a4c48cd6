// Tests the package as users use it. It is built and packed. Then each consumer in consumers/ is copied to a fresh
// folder outside the repository, the tarball is installed there, and the consumer is built and run until it reports the
// right pairs: runtimes, bundlers (their output opened in Chromium), the TypeScript compiler, pages without tools.
//
//   npm run test:package                 all of them
//   npm run test:package -- vite deno    those with these words in their names
//
// Tools missing on this machine (Chromium; Deno and Bun except on Linux) are named and skipped; in CI that is an error.
import { equal, ok } from 'node:assert/strict';
import { execFile } from 'node:child_process';
import {
  cpSync,
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  statSync,
  symlinkSync,
  writeFileSync,
} from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { delimiter, extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { gzipSync } from 'node:zlib';
import { chromium } from './chromium.mjs';

const root = fileURLToPath(new URL('..', import.meta.url));
const consumers = join(root, 'consumers');
const tools = join(consumers, 'node_modules');
const wanted = process.argv.slice(2);
const longest = 120_000; // milliseconds a command may take

/** The expected output of shared/every.js. */
const every =
  'index 7,9; findPairs 0,1; 2d 7,9; 3d 0,1; all 7,9; draw 5,5,10,10; ro 1 pair; shard 7,9 | 9,11,7,11; trace 1 frame; kernel.wasm 7,9';
const script = 'index 7,9';
const one = 'index 7,9; findPairs 0,1; kernel.wasm 7,9';

class Absent extends Error {}

// A consumer runs in its own folder, with the files of consumers/<from> and consumers/shared.
const matrix = {
  'Node, import': { from: 'node', try: async (at) => equal(await at.run('node', 'main.mjs'), every) },
  'Node, worker_threads': { from: 'node', try: async (at) => equal(await at.run('node', 'worker.mjs'), every) },
  'Node, require': { from: 'node', try: async (at) => equal(await at.run('node', 'all.cjs'), every) },
  'Node, require before 20.19': {
    from: 'node',
    async try(at) {
      const answer = await at.run('node', '--no-experimental-require-module', 'one.cjs');
      equal(answer, one);
    },
  },
  'Node, the broadphase command': {
    from: 'node',
    async try(at) {
      await at.run('npx', '--no-install', 'broadphase', 'generate', 'crowd', 'crowd.trace', '--count', '50');
      const info = JSON.parse(await at.run('npx', '--no-install', 'broadphase', 'info', 'crowd.trace', '--json'));
      ok(info.frames > 0);
      await at.run('npx', '--no-install', 'broadphase', 'replay', 'crowd.trace', '--verify', '--json');
    },
  },
  Deno: {
    from: 'node',
    try: async (at) => equal(await at.run(binary('@deno/linux-x64-glibc/deno'), 'run', '-A', 'main.mjs'), every),
  },
  Bun: {
    from: 'node',
    async try(at) {
      const bun = binary('@oven/bun-linux-x64/bin/bun');
      equal(await at.run(bun, 'main.mjs'), every);
      equal(await at.run(bun, 'one.cjs'), one);
    },
  },
  TypeScript: {
    from: 'typescript',
    async try(at) {
      // The oldest that the README promises, the one used here, and the newest.
      const compiler = (version, ...options) =>
        at.run('node', join(tools, version, 'bin/tsc'), '--strict', '--target', 'es2022', ...options);
      for (const version of ['typescript5', 'typescript', 'typescript7']) {
        await compiler(version, '--noEmit', '--module', 'esnext', '--moduleResolution', 'bundler', 'main.mts');
        await compiler(version, '--noEmit', '--module', 'nodenext', '--skipLibCheck', 'held.mts');
      }
      const tsc = (...options) => compiler('typescript', ...options);
      await tsc('--noEmit', '--module', 'node16', '--exactOptionalPropertyTypes', 'main.mts', 'one.cts');
      await tsc('--module', 'nodenext', 'main.mts', 'main.cts');
      equal(await at.run('node', 'main.mjs'), 'index 7,9; 1 pair; 1 frame; 0,1 guess');
      equal(await at.run('node', 'main.cjs'), 'index 7,9; true');
      const old = ['--moduleResolution', 'node10', '--ignoreDeprecations', '6.0'];
      await tsc('--noEmit', '--module', 'commonjs', ...old, 'old.ts');
    },
  },
  Vite: {
    from: 'vite',
    async try(at) {
      await at.run('vite', 'build', '--base', './');
      await at.page('dist/', every, every);
    },
  },
  'Vite, serving the sources': {
    from: 'vite',
    async try(at) {
      const vite = await import(join(tools, 'vite/dist/node/index.js'));
      const server = await vite.createServer({ root: at.folder, logLevel: 'error', server: { port: 0 } });
      try {
        await server.listen();
        await at.page(server.resolvedUrls.local[0], every, every);
      } finally {
        await server.close();
      }
    },
  },
  webpack: {
    from: 'webpack',
    async try(at) {
      await at.run('webpack', './main.js', '--mode', 'production');
      cpSync(join(at.folder, 'index.html'), join(at.folder, 'dist/index.html'));
      await at.page('dist/', every, every);
    },
  },
  esbuild: {
    from: 'esbuild',
    async try(at) {
      const options = ['--bundle', '--minify', '--outdir=dist', '--loader:.wasm=file'];
      await at.run('esbuild', 'main.js', 'worker.js', ...options);
      cpSync(join(at.folder, 'index.html'), join(at.folder, 'dist/index.html'));
      await at.page('dist/', every, every);
    },
  },
  Rollup: {
    from: 'rollup',
    async try(at) {
      await at.run('rollup', '--config');
      cpSync(join(at.folder, 'index.html'), join(at.folder, 'dist/index.html'));
      await at.page('dist/', every, every);
    },
  },
  Parcel: {
    from: 'parcel',
    async try(at) {
      const manifest = { '@parcel/resolver-default': { packageExports: true } };
      writeFileSync(join(at.folder, 'package.json'), JSON.stringify(manifest));
      await at.run('parcel', 'build', 'index.html', '--public-url', './');
      await at.page('dist/', every, every);
    },
  },
  'Parcel, as it comes': {
    from: 'no-exports',
    async try(at) {
      // It does not read `exports` then, and finds only the library.
      await at.run('parcel', 'build', 'index.html', '--public-url', './');
      await at.page('dist/', script, script);
    },
  },
  'a page, modules as they are': { from: 'static', try: (at) => at.page('', every, script) },
  'a page, a plain script': { from: 'script', try: (at) => at.page('', script, script) },
  'other realms, two copies, hot reload': {
    from: 'places',
    try: async (at) => equal(await at.run('node', 'realms.mjs'), 'true\n7,9\n1\n7,9\n7,9'),
  },
  'held in the state of frameworks': {
    from: 'places',
    async try(at) {
      at.note(await at.run('node', 'state.mjs'));
    },
  },
  'Jest and Vitest': {
    from: 'places',
    async try(at) {
      for (const [jest, suffix] of [
        ['jest29', '29'],
        ['jest', ''],
      ]) {
        for (const environment of ['node', `${tools}/jest-environment-jsdom${suffix}`]) {
          const file = join(tools, jest, 'bin/jest.js');
          await at.run('node', file, '--rootDir', '.', '--testMatch', '**/*.test.cjs', '--env', environment);
        }
      }
      for (const environment of ['node', 'jsdom', 'happy-dom']) {
        await at.run('vitest', 'run', '--environment', environment, 'places.test.mjs');
      }
    },
  },
  'iframes, workers of all kinds, audio worklets': {
    from: 'places',
    async try(at) {
      cpSync(join(at.folder, 'node_modules/broadphase/dist/index.js'), join(at.folder, 'library.js'));
      cpSync(join(at.folder, 'foreign.cjs'), join(at.folder, 'foreign.js'));
      const pair = '7,9';
      const everywhere = {
        iframe: true,
        'no TextEncoder': '0,1',
        'two copies': 0,
        'shared worker': pair,
        'audio worklet': `${pair}, no TextEncoder`,
        'service worker': pair,
      };
      await at.page('', JSON.stringify(everywhere), 'none');
    },
  },
  'what is not used is left out': {
    from: 'shaking',
    async try(at) {
      const entries = ['nothing.js', 'one-shot.js'];
      const inputs = entries.map((entry) => `./${entry}`);
      await at.run('esbuild', ...inputs, '--bundle', '--minify', '--format=esm', '--outdir=esbuild');
      await at.run('rollup', ...inputs, '--plugin', 'node-resolve', '--dir', 'rollup');
      for (const entry of inputs) {
        const [name] = entry.slice(2).split('.');
        await at.run('webpack', entry, '--mode', 'production', '-o', 'webpack', '--output-filename', `${name}.js`);
        const lib = { entry, formats: ['es'], fileName: name };
        const { build } = await import(join(tools, 'vite/dist/node/index.js'));
        const options = { outDir: 'vite', emptyOutDir: false, lib };
        await build({ root: at.folder, configFile: false, logLevel: 'error', build: options });
      }
      for (const bundler of ['esbuild', 'rollup', 'webpack', 'vite']) {
        const sizes = entries.map((entry) => gzipSync(readFileSync(join(at.folder, bundler, entry))).length);
        at.note(`${bundler}: ${sizes.join(', ')} bytes gzipped`);
        ok(sizes[0] < 200, `${bundler}: nothing is used, and yet the bundle has ${sizes[0]} bytes`);
        equal(await at.run('node', join(bundler, 'one-shot.js')), '0,1');
      }
    },
  },
};

function binary(path) {
  const file = join(tools, path);
  if (!existsSync(file)) throw new Absent(`${path} is for Linux on x64`);
  return file;
}

const environment = { ...process.env, PATH: join(tools, '.bin') + delimiter + process.env.PATH, NO_COLOR: '1' };

/** Runs a command and returns its output; if it fails, the error contains the output. */
async function run(folder, command, ...args) {
  try {
    const options = { cwd: folder, env: environment, timeout: longest, maxBuffer: 2 ** 26 };
    const { stdout } = await promisify(execFile)(command, args, options);
    return stdout.replace(/\n$/, '');
  } catch (error) {
    throw new Error(`${command} ${args.join(' ')}: ${error.message}\n${error.stdout}\n${error.stderr}`);
  }
}

const types = {
  '.html': 'text/html', // no charset, so that pages are tested without one
  '.js': 'text/javascript',
  '.wasm': 'application/wasm',
};
let browser;

/** Opens a page, in this folder or at an address, and waits until it and its worker report the expected result. */
async function page(folder, address, expected, expectedOfWorker) {
  if (!chromium) throw new Absent('no Chromium found: install it or set CHROMIUM to its path');
  browser ??= await (await import('@playwright/test')).chromium.launch({
    executablePath: chromium,
    args: ['--headless=new', '--no-sandbox', '--disable-gpu', '--disable-background-networking'],
  });
  const server = createServer(({ url }, answer) => {
    const path = normalize(decodeURIComponent(new URL(url, 'http://localhost').pathname));
    const file = join(folder, path.endsWith('/') ? `${path}index.html` : path);
    const found = existsSync(file) && statSync(file).isFile();
    answer.writeHead(found ? 200 : 404, { 'Content-Type': types[extname(file)] ?? 'application/octet-stream' });
    answer.end(found ? readFileSync(file) : '');
  });
  await new Promise((resolve) => server.listen(0, 'localhost', resolve));
  const home = `http://localhost:${server.address().port}/`;
  const opened = await browser.newPage();
  try {
    const faults = [];
    opened.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
    opened.on('pageerror', (error) => faults.push(String(error)));
    await opened.goto(new URL(address, home).href);
    const said = () => ['#page', '#worker'].map((where) => document.querySelector(where).textContent);
    await opened
      .waitForFunction(`(${said})().every(Boolean)`, undefined, { timeout: 20_000 })
      .catch(() => faults.push('the page did not answer'));
    const answers = await opened.evaluate(said);
    equal(faults.join('\n'), '');
    equal(answers[0], expected);
    equal(answers[1], expectedOfWorker);
  } finally {
    await opened.close();
    server.close();
  }
}

/** Packs the package, and checks its contents. */
async function pack(folder) {
  const report = await run(root, 'npm', 'pack', '--json', '--pack-destination', folder);
  const packed = JSON.parse(report.slice(report.search(/^[[{]/m)));
  const [{ filename, files, size, unpackedSize }] = Array.isArray(packed) ? packed : Object.values(packed);
  const strange = files.filter(({ path }) => !/^(dist\/|(package\.json|README\.md|LICENSE|CHANGELOG\.md)$)/.test(path));
  equal(strange.map(({ path }) => path).join(), '', 'only what was built is packed');
  console.log(`packed ${files.length} files, ${size} bytes, ${unpackedSize} unpacked`);
  return join(folder, filename);
}

const seconds = (since) => `${((performance.now() - since) / 1000).toFixed(1)} s`;
const begun = performance.now();
console.log('building');
await run(root, 'npm', 'run', 'build');
const lock = join(consumers, 'package-lock.json');
const installed = join(tools, '.package-lock.json');
if (!existsSync(installed) || statSync(installed).mtimeMs < statSync(lock).mtimeMs) {
  console.log('installing what the package is tried with (npm ci --prefix consumers)');
  await run(root, 'npm', 'ci', '--prefix', 'consumers', '--ignore-scripts', '--no-audit', '--no-fund');
}

const workshop = mkdtempSync(join(tmpdir(), 'broadphase-'));
let failed = 0;
try {
  const tarball = await pack(workshop);
  symlinkSync(tools, join(workshop, 'node_modules'), 'junction');
  for (const [name, consumer] of Object.entries(matrix)) {
    if (wanted.length > 0 && !wanted.some((word) => name.toLowerCase().includes(word.toLowerCase()))) continue;
    const started = performance.now();
    const folder = join(workshop, name.replaceAll(/\W+/g, '-'));
    const notes = [];
    try {
      mkdirSync(folder);
      for (const from of ['shared', consumer.from]) cpSync(join(consumers, from), folder, { recursive: true });
      writeFileSync(join(folder, 'package.json'), '{ "private": true, "type": "module" }\n');
      await run(folder, 'npm', 'install', tarball, '--offline', '--no-audit', '--no-fund');
      equal(
        readdirSync(join(folder, 'node_modules'))
          .filter((entry) => !entry.startsWith('.'))
          .join(),
        'broadphase',
      );
      await consumer.try({
        folder,
        note: (text) => notes.push(text),
        run: (...command) => run(folder, ...command),
        page: (...what) => page(folder, ...what),
      });
      console.log(`ok      ${name}, ${seconds(started)}`);
    } catch (error) {
      const absent = error instanceof Absent && !process.env.CI;
      if (!absent) failed++;
      console.log(`${absent ? 'skipped' : 'FAILED '} ${name}: ${error.message}`);
    }
    for (const note of notes) console.log(`        ${note}`);
  }
} finally {
  await browser?.close();
  rmSync(workshop, { recursive: true, force: true });
}
console.log(`${failed > 0 ? `${failed} failed` : 'all passed'}, ${seconds(begun)}`);
process.exitCode = failed > 0 ? 1 : 0;
