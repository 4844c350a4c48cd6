// Checks that the same calls give the same answers in the same order everywhere: plays the same tapes
// (test/promises/determinism/tape.ts) with every technique in Node, in Chromium, in Firefox, and natively as g++ and
// clang compile the kernel, and compares the hash of all answers with those kept in
// test/promises/determinism/golden.json.
//
//   npm run determinism                 everything on this machine; names what is missing
//   npm run determinism -- --write      rewrites the hashes, if all agree: after an intended change of the order
//
// CHROMIUM and FIREFOX choose the browsers.
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { join } from 'node:path';
import { gunzipSync } from 'node:zlib';
import { bundle } from './bundle.mjs';
import { build, clangs, findCompiler, root, run } from './native.mjs';

const write = process.argv.includes('--write');
const folder = join(root, 'build/determinism');
const golden = join(root, 'test/promises/determinism/golden.json');
const script = 'build/determinism/player.mjs';
const { play, techniqueNames, randomTape, framesTape, framesOf, openTrace } = await import(
  await bundle('test/promises/determinism/index.ts', script)
);
mkdirSync(folder, { recursive: true });

// For each recording, the first frame that is played.
const recordings = {
  rain: 0,
  junkyard: 14,
  smash: 0,
  spinner: 0,
  tumbler: 0,
  'rapier3d-freefall10k': 0,
  'rapier3d-gravity8k': 0,
};
const framesPlayed = 5; // of a recording
const callsPlayed = 4000; // of a random tape
const seeds = [1, 2, 3];

const techniques = techniqueNames();
const tapes = {};
for (const dimensions of [2, 3]) {
  for (const seed of seeds) {
    tapes[`calls${dimensions}d-${seed}`] = randomTape(dimensions, techniques.length, seed, callsPlayed);
  }
}
for (const dimensions of [2, 3]) {
  tapes[`switched${dimensions}d`] = randomTape(dimensions, techniques.length, 4, callsPlayed, 'setEnabled');
  tapes[`grouped${dimensions}d`] = randomTape(dimensions, techniques.length, 5, callsPlayed, 'setGroup');
  tapes[`reaching${dimensions}d`] = randomTape(dimensions, techniques.length, 6, callsPlayed, 'setReach');
  tapes[`apart${dimensions}d`] = randomTape(dimensions, techniques.length, 7, callsPlayed, 'setReach', false);
}
for (const dimensions of [2, 3]) {
  tapes[`many${dimensions}d`] = randomTape(dimensions, techniques.length, 6, callsPlayed, 'many');
}
for (const [name, first] of Object.entries(recordings)) {
  const trace = openTrace(gunzipSync(readFileSync(join(root, `recordings/${name}.trace.gz`))));
  const recording = framesOf(trace, first, first + framesPlayed);
  const frames = Array.from({ length: recording.frames }, (_, k) => recording.frame(k));
  tapes[name] = framesTape(recording.dimensions, frames);
}
const file = (name) => join(folder, `${name}.tape`);
for (const [name, tape] of Object.entries(tapes)) writeFileSync(file(name), new Uint8Array(tape.buffer));
const cases = Object.keys(tapes).flatMap((tape) =>
  techniques.map((technique, number) => ({ name: `${tape} ${technique}`, tape, number })),
);

/** Each returns the hashes of all cases, in order, or says why it cannot. */
const players = {
  [`Node ${process.versions.node}`]: () => cases.map(({ tape, number }) => play(tapes[tape], number)),
  Chromium: () => inBrowser('chrome', [process.env.CHROMIUM, '/usr/bin/chromium', '/usr/bin/google-chrome']),
  Firefox: () => inBrowser('firefox', [process.env.FIREFOX, '/usr/bin/firefox-esr', '/usr/bin/firefox']),
  'g++': () => natively(['g++']),
  clang: () => natively(clangs),
};

class Absent extends Error {}

async function inBrowser(browser, places) {
  const executablePath = places.find((place) => place && existsSync(place));
  if (!executablePath) throw new Absent('not found');
  const { launch } = await import('puppeteer-core');
  const files = {
    '/': ['text/html', '<!doctype html><title>determinism</title>'],
    '/player.mjs': ['text/javascript', readFileSync(join(root, script))],
  };
  const server = createServer(({ url }, answer) => {
    const tape = url.endsWith('.tape') && existsSync(file(url.slice(1, -5))) && readFileSync(file(url.slice(1, -5)));
    const [type, body] = files[url] ?? ['application/octet-stream', tape];
    answer.writeHead(body ? 200 : 404, { 'Content-Type': type }).end(body || '');
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  const args = browser === 'chrome' ? ['--no-sandbox', '--disable-gpu', '--disable-background-networking'] : [];
  const opened = await launch({ browser, executablePath, args, headless: true, protocolTimeout: 600_000 });
  try {
    const page = await opened.newPage();
    await page.goto(`http://127.0.0.1:${server.address().port}/`);
    console.log(`  ${await opened.version()}`);
    return await page.evaluate(async (cases) => {
      const { play } = await import('/player.mjs');
      const hashes = [];
      let name;
      let tape;
      for (const { tape: wanted, number } of cases) {
        if (wanted !== name) tape = new Float64Array(await (await fetch(`/${wanted}.tape`)).arrayBuffer());
        name = wanted;
        hashes.push(play(tape, number));
      }
      return hashes;
    }, cases);
  } finally {
    await opened.close();
    server.close();
  }
}

async function natively(names) {
  const options = ['-O2'];
  const { compiler, reasons } = await findCompiler(names, options, 'int main() { return 0; }\n', folder);
  if (!compiler) throw new Absent(reasons.join('\n') || 'not found');
  const source = join(root, 'kernel/test/play/main.cpp');
  const program = await build(compiler, options, [source], folder, `play-${compiler}`);
  const { ok, output } = await run(
    program,
    cases.flatMap(({ tape, number }) => [String(number), file(tape)]),
  );
  if (!ok) throw new Error(`the native player failed: ${output}`);
  return output.trim().split('\n');
}

let expected = write ? undefined : Object.values(JSON.parse(readFileSync(golden, 'utf8')));
if (!write) {
  const known = Object.keys(JSON.parse(readFileSync(golden, 'utf8')));
  if (known.join() !== cases.map(({ name }) => name).join()) {
    console.error('determinism: the cases are others than those of golden.json: run it with --write');
    process.exit(1);
  }
}
let failed = false;
let played = 0;
for (const [player, hashesOf] of Object.entries(players)) {
  const started = performance.now();
  try {
    const hashes = await hashesOf();
    expected ??= hashes;
    const wrong = cases.filter((_, k) => hashes[k] !== expected[k]).map(({ name }) => name);
    const seconds = ((performance.now() - started) / 1000).toFixed(1);
    console.log(`${player}: ${cases.length - wrong.length} of ${cases.length} as expected, ${seconds} s`);
    for (const name of wrong.slice(0, 10)) console.log(`  differs: ${name}`);
    failed ||= wrong.length > 0;
    played++;
  } catch (error) {
    if (!(error instanceof Absent)) throw error;
    console.log(`${player}: skipped, ${error.message}`);
  }
}
if (write && !failed) {
  const lines = cases.map(({ name }, k) => `  ${JSON.stringify(name)}: ${JSON.stringify(expected[k])}`);
  writeFileSync(golden, `{\n${lines.join(',\n')}\n}\n`);
  console.log(`determinism: ${cases.length} hashes written, ${played} players agree`);
}
if (failed) {
  console.error(
    'determinism: answers differ. Where the order of pairs was meant to change: npm run determinism -- --write',
  );
}
process.exit(failed ? 1 : 0);
