// Tests the examples and the starter like someone who has only the published package: each folder of examples/ is
// copied out of the repository, the package is installed from its tarball, and the example is built, started, and
// opened in Chromium until it shows the expected result. After `npm run build`:
//
//   npm run test:examples                    all of them
//   npm run test:examples -- react starter   those with these words in their names
//
// Besides the tarball, most use the packages in examples/node_modules, and those of examples/apart the ones there;
// test/house/example-folders.test.ts checks that each folder names all that it imports. The starter and the hooks for
// React are installed by npm.
import { equal, match, ok } from 'node:assert/strict';
import { execFile, spawn } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, symlinkSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { promisify } from 'node:util';
import { chromium } from './chromium.mjs';
import { folders } from './example-files.mjs';

const root = fileURLToPath(new URL('..', import.meta.url));
const tools = join(root, 'examples/node_modules');
const apart = join(root, 'examples/apart/node_modules');
const wanted = process.argv.slice(2);
const longest = 300_000; // milliseconds for a command, or for a page to show the expected result
const install = ['install', '--prefer-offline', '--no-audit', '--no-fund'];

/** What a page must show, and where; `search` is the end of its address. */
const pages = {
  'bullets-phaser': { where: '#numbers', says: /you caught/, plain: true },
  'culling-pixi': { where: '#numbers', says: /of 100,000 drawn/ },
  'culling-three': { where: 'p[role=status]', says: /of 20,000 stones in view/, search: '?stones=20000' },
  'draw-pixi': { where: '#numbers', says: /[1-9]\d* pairs of 120 boxes/ },
  'draw-three': { where: '#numbers', says: /[1-9]\d* pairs of 150 boxes/ },
  'force-d3': { where: 'p[role=status]', says: /300 rectangles.*; 0 overlap/s },
  'instancing-three': { where: '#numbers', says: /find [\d,]+ pairs among 1,500/, search: '?boxes=1500' },
  'nodes-xyflow': { where: 'p[role=status]', says: /40 nodes/ },
  react: { where: '[role=status]', says: /0 of [1-9]\d+ tiles selected/, byNpm: true, server: /role="option"/ },
  vue: { where: '[role=status]', says: /^\s*1 pair overlaps\s*$/ },
  'record-phaser': { where: '#save', says: /Save the recording/ },
};

/** What a program must print. */
const programs = {
  ecs: /^bitecs: [1-9].*koota: [1-9]/s,
  'matter-broadphase': /^heap +500 +\d/m,
  'move-and-slide': /^step 0: at 16/,
  'narrow-phase': /[1-9]\d*\.\d touch/,
  'planck-broadphase': /^heap +500 +\d/m,
  'record-matter': /^matter\.trace: \d+ frames/,
  'record-planck': /^planck\.trace: \d+ frames/,
  'record-rapier': /^rapier\.trace: \d+ frames/,
  'record-three': /^three\.trace: \d+ frames/,
  'server-interest': /sees [\d.]+ others/,
  'apart/join-duckdb': /^1,000,000 boxes:\s+broadphase join: [\d.]+ s, 1,99\d,\d+ pairs in \d+ tiles/,
};
/** These measure for minutes, and are ended once they have printed that. */
const longPrograms = ['matter-broadphase', 'planck-broadphase'];

const environment = { ...process.env, BROWSER: 'none', NO_COLOR: '1' };

/** Runs a command and returns its output, as { stdout, stderr }; if it fails, the error contains the output. */
async function run(folder, command, ...args) {
  try {
    const options = { cwd: folder, env: environment, timeout: longest, maxBuffer: 2 ** 26 };
    return await promisify(execFile)(command, args, options);
  } catch (error) {
    throw new Error(`${command} ${args.join(' ')}: ${error.message}\n${error.stdout}\n${error.stderr}`);
  }
}

/**
 * Runs a script of a package, passes its output to `use` once that matches, and ends it with all its child processes.
 */
async function whileStarted(folder, expected, use, script = ['start']) {
  const child = spawn('npm', ['run', '--silent', ...script], {
    cwd: folder,
    env: { ...environment, PORT: '0' },
    detached: true,
  });
  let said = '';
  try {
    const answer = await new Promise((resolve, reject) => {
      const late = setTimeout(() => reject(new Error(`npm run ${script[0]} said only: ${said}`)), longest);
      const hear = (text) => {
        said += text;
        const found = expected.exec(said);
        if (found) resolve(found);
      };
      child.stdout.on('data', hear);
      child.stderr.on('data', hear);
      child.on('exit', (code) => reject(new Error(`npm run ${script[0]} ended with ${code}: ${said}`)));
      child.on('close', () => clearTimeout(late));
    });
    await use(answer);
  } finally {
    if (child.exitCode === null) process.kill(-child.pid);
  }
}

const types = { '.html': 'text/html; charset=utf-8', '.js': 'text/javascript', '.css': 'text/css' };

/** Serves a folder while `use` runs, which gets the address. */
async function whileServed(folder, use) {
  const server = createServer(({ url }, answer) => {
    const path = normalize(decodeURIComponent(new URL(url, 'http://localhost').pathname));
    const file = join(folder, path.endsWith('/') ? `${path}index.html` : path);
    const found = existsSync(file);
    answer.writeHead(found ? 200 : 404, { 'Content-Type': types[extname(file)] ?? 'application/octet-stream' });
    answer.end(found ? readFileSync(file) : '');
  });
  await new Promise((resolve) => server.listen(0, 'localhost', resolve));
  try {
    await use(`http://localhost:${server.address().port}/`);
  } finally {
    server.closeAllConnections();
    server.close();
  }
}

let browser;

/**
 * Opens a page until it shows the expected result, without errors, and without requests to other hosts; `then` does the
 * rest. Requests to a CDN are answered from the folder `cdn`.
 */
async function look(address, { where, says, plain = false, cdn }, then = async () => {}) {
  browser ??= await (await import('@playwright/test')).chromium.launch({
    executablePath: chromium,
    args: ['--headless=new', '--no-sandbox', '--disable-gpu', '--disable-background-networking'],
  });
  const page = await browser.newPage({ reducedMotion: 'reduce' });
  const faults = [];
  page.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
  page.on('pageerror', (error) => faults.push(String(error)));
  page.on('requestfailed', (request) => faults.push(`failed: ${request.url()}`));
  page.on('response', (answer) => answer.status() >= 400 && faults.push(`${answer.status()} ${answer.url()}`));
  page.on('request', (request) => {
    const url = request.url();
    const own = cdn ? url.startsWith(cdnAddress) : url.startsWith(new URL('/', address).href);
    if (/^https?:/.test(url) && !own) faults.push(`asks for ${url}`);
  });
  if (cdn) {
    await page.route(`${cdnAddress}**`, (route) => {
      const [, name, file] = new RegExp(`^${cdnAddress}(.*)@[^/]+/(.*)$`).exec(route.request().url());
      const headers = { 'Access-Control-Allow-Origin': '*' };
      return route.fulfill({ path: join(cdn, name, file), contentType: 'text/javascript', headers });
    });
  }
  // WebGL in software is too slow for this many objects, so Phaser draws on a 2D canvas.
  if (plain) await page.addInitScript(withoutWebgl);
  try {
    await page.goto(address);
    const place = page.locator(where).first();
    const end = performance.now() + longest;
    let said = '';
    while (!says.test(said)) {
      ok(performance.now() < end, `${where} says '${said}', expected ${says}; ${faults.join('\n')}`);
      said = await place.textContent({ timeout: longest });
      await page.waitForTimeout(50);
    }
    await then(page);
    equal(faults.join('\n'), '');
  } finally {
    await page.close();
  }
}

/** The address that serves npm packages. */
const cdnAddress = 'https://cdn.jsdelivr.net/npm/';

const withoutWebgl = `{
  const { getContext } = HTMLCanvasElement.prototype;
  HTMLCanvasElement.prototype.getContext = function (kind, ...options) {
    return kind.includes('webgl') ? null : getContext.call(this, kind, ...options);
  };
}`;

/** The page of `npm run server` has its content before any script runs, and hydrates without errors. */
async function rendered(folder, page) {
  const goOn = async ([address]) => {
    const html = await (await fetch(address)).text();
    match(html, page.server);
    await look(address, page);
  };
  await whileStarted(folder, /http:\S+/, goOn, ['server']);
}

/** Copies a folder of examples, without installed packages and build output. */
function copyOut(workshop, name) {
  const folder = join(workshop, name);
  const filter = (path) => !/[/\\](node_modules|dist)$/.test(path);
  cpSync(join(root, 'examples', name), folder, { recursive: true, filter });
  return folder;
}

/** Installs the dependencies of a folder with npm, using the tarball for packages that are not on npm yet. */
async function installInto(folder, tarball) {
  await run(folder, 'npm', 'pkg', 'set', `dependencies.broadphase=file:${tarball}`);
  await run(folder, 'npm', ...install);
}

async function example(name, workshop, tarball) {
  const folder = copyOut(workshop, name);
  if (longPrograms.includes(name)) return whileStarted(folder, programs[name], () => {});
  if (programs[name]) {
    const { stdout, stderr } = await run(folder, 'npm', 'start', '--silent');
    equal(stderr, '');
    return match(stdout, programs[name]);
  }
  const page = pages[name];
  ok(page, 'what it must show is not written in scripts/strangers.mjs');
  if (page.byNpm) await installInto(folder, tarball);
  await run(folder, 'npm', 'run', 'build');
  await whileServed(join(folder, 'dist'), (address) => look(address + (page.search ?? ''), page));
  if (page.server) await rendered(folder, page);
}

/** The tests by name; each gets the folder to work in, and the tarball. */
const all = {
  /** Opened as a file; requests to the network are answered from the package. */
  async smallest(workshop) {
    const folder = copyOut(workshop, 'smallest');
    const address = pathToFileURL(join(folder, 'index.html')).href;
    await look(address, { where: 'output', says: /^7, 9, 9, 11$/, cdn: join(workshop, 'node_modules') });
  },
  ...Object.fromEntries(folders.map((name) => [name, (...given) => example(name, ...given)])),
  async csp(workshop) {
    const use = ([address]) => look(address, { where: '#pairs', says: /^7, 9, 9, 11$/ });
    await whileStarted(copyOut(workshop, 'csp'), /http:\S+/, use);
  },
  /** In memory, as without Redis. Through npm it runs in the Node that it installs. */
  async 'apart/world-colyseus'(workshop) {
    const port = await freePort();
    const options = ['--', '--memory', '--entities', '500', '--clients', '10', '--port', port];
    const shown = { where: '#said', says: /500 entities in 3 of 3 zones and 1 processes; 10 clients/ };
    const use = ([address]) => look(address, shown);
    await whileStarted(copyOut(workshop, 'apart/world-colyseus'), /http:[^, ]+/, use, ['start', ...options]);
  },
  /** The game of `broadphase init`, started as the command's output says; it is played until a rock is hit. */
  async starter(workshop, tarball) {
    const apart = join(workshop, 'starter');
    mkdirSync(apart);
    const command = ['--yes', '--package', tarball, 'broadphase'];
    const { stdout } = await run(apart, 'npx', ...command, 'init', 'my-game', '--package', tarball);
    match(stdout, /cd my-game\s+npm install\s+npm start/);
    const game = join(apart, 'my-game');
    await run(game, 'npm', ...install);
    await run(game, 'npm', 'run', 'build');
    const hit = { where: 'canvas', says: /^$/ };
    await whileServed(join(game, 'dist'), (address) => look(address, hit, played));
    await whileStarted(game, /http:\/\/localhost:\d+\//, ([address]) => look(address, hit, played));
  },
};

/** Waits until the game draws that bullets have hit something: the text on its canvas says how many. */
async function played(page) {
  await page.evaluate(() => {
    const { prototype } = CanvasRenderingContext2D;
    const { fillText } = prototype;
    prototype.fillText = function (text, ...place) {
      globalThis.drawn = text;
      fillText.call(this, text, ...place);
    };
  });
  await page.waitForFunction('/^[1-9]/.test(globalThis.drawn)', undefined, { timeout: longest });
}

/** node_modules for the copies: the packed package, and beside it the packages installed in the repository. */
async function furnish(workshop) {
  await run(root, 'npm', 'pack', '--pack-destination', workshop);
  const tarball = join(
    workshop,
    readdirSync(workshop).find((name) => name.endsWith('.tgz')),
  );
  const modules = join(workshop, 'node_modules');
  const published = join(modules, 'broadphase');
  mkdirSync(published, { recursive: true });
  await run(workshop, 'tar', '-xzf', tarball, '-C', published, '--strip-components=1');
  link(tools, modules);
  if (!existsSync(apart)) return tarball;
  mkdirSync(join(workshop, 'apart/node_modules'), { recursive: true });
  link(apart, join(workshop, 'apart/node_modules'));
  return tarball;
}

function link(from, to) {
  for (const name of readdirSync(from)) {
    if (!name.startsWith('broadphase')) symlinkSync(join(from, name), join(to, name), 'junction');
  }
}

/** A free port. */
async function freePort() {
  const server = createServer();
  await new Promise((resolve) => server.listen(0, resolve));
  const { port } = server.address();
  await new Promise((resolve) => server.close(resolve));
  return String(port);
}

const seconds = (since) => `${((performance.now() - since) / 1000).toFixed(1)} s`;

async function main() {
  const missing = !existsSync(join(root, 'dist/cli.js'))
    ? 'npm run build makes the package that they use'
    : !existsSync(join(tools, 'vite'))
      ? 'npm ci --prefix examples brings what they need'
      : !chromium && 'no Chromium found: install it or set CHROMIUM to its path';
  if (missing) {
    console.log(`the examples as strangers have them: skipped, ${missing}`);
    return process.env.CI ? 1 : 0;
  }
  const begun = performance.now();
  const workshop = mkdtempSync(join(tmpdir(), 'broadphase-strangers-'));
  let failed = 0;
  try {
    const tarball = await furnish(workshop);
    for (const [name, test] of Object.entries(all)) {
      if (wanted.length > 0 && !wanted.some((word) => name.includes(word))) continue;
      if (name.startsWith('apart') && !existsSync(apart)) {
        console.log(`skipped ${name}: npm ci --prefix examples/apart brings what it needs`);
        if (process.env.CI) failed++;
        continue;
      }
      const started = performance.now();
      try {
        await test(workshop, tarball);
        console.log(`ok      ${name}, ${seconds(started)}`);
      } catch (error) {
        failed++;
        console.log(`FAILED  ${name}: ${error.message}`);
      }
    }
  } finally {
    await browser?.close();
    rmSync(workshop, { recursive: true, force: true });
  }
  console.log(`${failed > 0 ? `${failed} failed` : 'all passed'}, ${seconds(begun)}`);
  return failed > 0 ? 1 : 0;
}

process.exitCode = await main();
