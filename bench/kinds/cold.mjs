// Cold: from the start of a process, or of a page, to the first pairs; and the first 120 frames of a game of 1,000 things.
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { basename } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { build } from 'vite';
import { start } from '../harness/race.mjs';
import { mean, median } from '../harness/statistics.mjs';

export const title = 'Cold';

const path = (file) => fileURLToPath(new URL(file, import.meta.url));
const times = 9;
/** The first use of each library, with its imports: two boxes, one pair. */
const first = {
  'no library': '',
  broadphase: `import { BroadPhase } from 'broadphase';
    const pairs = new BroadPhase().set(0, 0, 0, 10, 10).set(1, 5, 5, 15, 15).update().pairs.length / 2;`,
  flatbush: `import Flatbush from 'flatbush';
    const index = new Flatbush(2);
    index.add(0, 0, 10, 10); index.add(5, 5, 15, 15); index.finish();
    const pairs = index.search(0, 0, 10, 10).filter((id) => id > 0).length;`,
  rbush: `import RBush from 'rbush';
    const tree = new RBush().load([{ minX: 0, minY: 0, maxX: 10, maxY: 10 }, { minX: 5, minY: 5, maxX: 15, maxY: 15 }]);
    const pairs = tree.search({ minX: 0, minY: 0, maxX: 10, maxY: 10 }).length - 1;`,
  'box-intersect': `import boxIntersect from 'box-intersect';
    const pairs = boxIntersect([[0, 0, 10, 10], [5, 5, 15, 15]]).length;`,
};

export const rows = ({ names }) =>
  ['in Node', 'in a page', 'the first frames']
    .filter((name) => !names || names.includes(name))
    .map((name) => ({ kind: 'cold', name, dimensions: 2, count: name === 'the first frames' ? 1000 : 2 }));

export async function play(row) {
  const ways = { 'in Node': inNode, 'in a page': inPage, 'the first frames': firstFrames };
  return { ...row, ...(await ways[row.name](row)) };
}

/** Each as one script without imports, in the project's build folder. */
async function scripts() {
  const files = [];
  for (const [name, code] of Object.entries(first)) {
    const entry = `virtual:first-${name}`;
    const report = name === 'no library' ? 'const pairs = 1;' : '';
    const source = `${code}\n${report}\nif (pairs !== 1) throw new Error('no pair');\nglobalThis.firstPairs = performance.now();`;
    const plugin = {
      name: 'first',
      resolveId: (id) => (id === entry ? `\0${entry}` : undefined),
      load: (id) => (id === `\0${entry}` ? source : undefined),
    };
    const file = `${name.replaceAll(' ', '-')}.mjs`;
    await build({
      root: path('..'),
      configFile: false,
      logLevel: 'error',
      publicDir: false,
      plugins: [plugin],
      define: { global: 'globalThis' },
      resolve: { alias: { broadphase: path('../../src/index.ts'), buffer: path('../../site/bench/no-buffer.ts') } },
      build: {
        outDir: path('../../build/bench/cold'),
        emptyOutDir: false,
        target: 'es2022',
        rollupOptions: { input: entry, output: { entryFileNames: file, format: 'es' } },
      },
    });
    files.push({ name, file: path(`../../build/bench/cold/${file}`) });
  }
  return files;
}

/** Milliseconds from the start of the process to the first pairs, and of that since the import began: medians. */
async function inNode() {
  const contenders = [];
  for (const { name, file } of await scripts()) {
    const program = `const before = performance.now();
      await import(${JSON.stringify(file)});
      console.log(globalThis.firstPairs, globalThis.firstPairs - before);`;
    const run = () =>
      execFileSync(process.execPath, ['--input-type=module', '-e', program], { encoding: 'utf8' })
        .split(' ')
        .map(Number);
    const runs = Array.from({ length: times }, run);
    const [first, own] = [0, 1].map((k) => median(runs.map((each) => each[k])));
    contenders.push({ name, peer: name, first, own, kB: sizeOf(file) });
  }
  return { contenders };
}

const sizeOf = (file) => gzipSync(readFileSync(file), { level: 9 }).length / 1000;

/** Milliseconds from the navigation of a fresh page to the first pairs, and of that since the import began: medians. */
async function inPage() {
  const executablePath = process.env.CHROMIUM ?? ['/usr/bin/chromium', '/usr/bin/chromium-browser'].find(existsSync);
  if (!executablePath) return { error: 'no Chromium at hand: set CHROMIUM', contenders: [] };
  const { default: puppeteer } = await import('puppeteer-core');
  const files = await scripts();
  const server = serve(files);
  const browser = await puppeteer.launch({ executablePath, args: ['--no-sandbox'] });
  const contenders = [];
  try {
    for (const { name, file } of files) {
      const runs = [];
      for (let k = 0; k < times; k++) {
        const context = await browser.createBrowserContext();
        const page = await context.newPage();
        await page.goto(`http://localhost:${server.address().port}/${basename(file)}.html`);
        runs.push(await page.waitForFunction('globalThis.found').then((handle) => handle.jsonValue()));
        await context.close();
      }
      const [first, own] = [0, 1].map((k) => median(runs.map((each) => each[k])));
      contenders.push({ name, peer: name, first, own, kB: sizeOf(file) });
    }
  } finally {
    await browser.close();
    server.close();
  }
  return { contenders };
}

/** Each script, and for each a page that imports it. */
function serve(files) {
  const answers = new Map();
  for (const { file } of files) {
    const script = `/${basename(file)}`;
    const code = `const before = performance.now();
      await import(${JSON.stringify(script)});
      globalThis.found = [firstPairs, firstPairs - before];`;
    answers.set(script, ['text/javascript', readFileSync(file)]);
    answers.set(`${script}.html`, [
      'text/html',
      `<!doctype html><title>cold</title><script type="module">${code}</script>`,
    ]);
  }
  return createServer(({ url }, response) => {
    const [type, body] = answers.get(url) ?? ['text/plain', ''];
    response.setHeader('content-type', type).end(body);
  }).listen(0);
}

/** Milliseconds of a whole frame from objects, in a fresh process: the very first, the first ten, and the first 120. */
async function firstFrames(row) {
  const plan = { warmUp: 0, timed: 120 };
  const scene = { ...row, scene: 'uniform2d', numbers: 'double', objects: true, seed: 1, plan };
  const contenders = [];
  const objects = { module: path('../contenders/objects.mjs') };
  const flatbush = { module: path('../contenders/package-of-objects.mjs'), variant: { peer: 'flatbush' } };
  for (const [name, how] of [
    ['set', { ...objects, variant: 'set' }],
    ['sort and sweep', { ...objects, variant: 'sort and sweep' }],
    ['flatbush', flatbush],
  ]) {
    const runs = [];
    for (let k = 0; k < times; k++) {
      const runner = start();
      await runner.ask('open', { ...how, row: scene, stride: 1 });
      await runner.ask('play', plan.timed);
      const notes = await runner.ask('notes', 0);
      runner.stop();
      if (notes.error) throw new Error(notes.error.split('\n')[0]);
      runs.push(notes.give.map((give, frame) => give + notes.update[frame] + notes.walk[frame]));
    }
    const of = (from, end) => median(runs.map((each) => mean(each.slice(from, end))));
    contenders.push({ name, peer: name, first: of(0, 1), ten: of(0, 10), all: of(0, plan.timed) });
  }
  return { contenders };
}
