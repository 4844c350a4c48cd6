// Native libraries side by side: programs in C++ and Rust read the frames of a scene from a file and play them in turns
// with ours. A missing compiler or library is named and skipped.
import { execFileSync, spawn } from 'node:child_process';
import { existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { homedir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';
import { loadCases } from '../cases/index.mjs';
import { techniques } from '../contenders/techniques.mjs';
import { race } from '../harness/race.mjs';
import { openScene } from '../harness/scene.mjs';

export const title = 'Native libraries, side by side';

const path = (file) => fileURLToPath(new URL(file, import.meta.url));
const sources = path('../native');
const built = path('../../build/bench/native');
const plan = { warmUp: 20, timed: 40 };
/** Packages of Debian, and their linker options. */
const inDebian = {
  cgal: { package: 'libcgal-dev', link: ['-lgmp', '-lmpfr'], perDimension: true },
  boost: { package: 'libboost-dev', link: [], perDimension: true },
  bullet: { package: 'libbullet-dev', link: ['-I/usr/include/bullet', '-lBulletCollision', '-lLinearMath'] },
};
const inRust = ['broccoli', 'parry2d', 'parry3d'];

/** Programs that could be built, as contenders; `dimensions` are what they can do. */
const programs = [];
const versions = [];

/** Builds all programs that can be built; reports why the others cannot. */
export async function prepare() {
  mkdirSync(built, { recursive: true });
  const problems = [...buildRust(), ...buildDebian()];
  for (const problem of problems) console.log(problem);
  return programs.length === 0 ? 'no native library is at hand' : undefined;
}

function buildRust() {
  const manifest = join(sources, 'Cargo.toml');
  try {
    execFileSync('cargo', ['build', '--release', '--quiet', '--manifest-path', manifest, '--target-dir', built], {
      stdio: ['ignore', 'ignore', 'pipe'],
      env: { ...process.env, RUSTFLAGS: '-C target-cpu=native' },
    });
  } catch (error) {
    return [`no Rust: ${reasonOf(error)}`];
  }
  const program = (name) => join(built, 'release', name);
  programs.push({ name: 'broccoli', dimensions: [2], program: program('broccoli'), variant: '' });
  for (const variant of ['rebuild', 'refit', 'parallel']) {
    for (const d of [2, 3]) {
      programs.push({ name: `parry (${variant})`, dimensions: [d], program: program(`parry${d}d`), variant });
    }
  }
  for (const crate of inRust) versions.push(versionOfCrate(crate));
  return [];
}

/** From the lock file, and the commit named by the crate. */
function versionOfCrate(crate) {
  const lock = readFileSync(join(sources, 'Cargo.lock'), 'utf8');
  const [, version] = new RegExp(`name = "${crate}"\\nversion = "([^"]+)"`).exec(lock) ?? [];
  const registry = join(process.env.CARGO_HOME ?? join(homedir(), '.cargo'), 'registry', 'src');
  for (const index of existsSync(registry) ? readdirSync(registry) : []) {
    const file = join(registry, index, `${crate}-${version}`, '.cargo_vcs_info.json');
    if (existsSync(file)) return `${crate} ${version} (${JSON.parse(readFileSync(file, 'utf8')).git.sha1.slice(0, 9)})`;
  }
  return `${crate} ${version}`;
}

function buildDebian() {
  const problems = [];
  const compiler = process.env.CXX ?? 'g++';
  for (const [name, { package: from, link, perDimension }] of Object.entries(inDebian)) {
    for (const dimensions of perDimension ? [[2], [3]] : [[2, 3]]) {
      const program = join(built, `${name}${dimensions.join('')}`);
      const flags = ['-O3', '-march=native', '-std=c++20', '-w', `-DDIMENSIONS=${dimensions[0]}`];
      try {
        execFileSync(compiler, [...flags, join(sources, `${name}.cpp`), '-o', program, ...link], {
          stdio: ['ignore', 'ignore', 'pipe'],
        });
      } catch (error) {
        problems.push(`no ${name} (${from}): ${reasonOf(error)}`);
        break;
      }
      programs.push({ name, dimensions, program, variant: '' });
    }
    if (programs.some((each) => each.name === name)) versions.push(versionOfPackage(from));
  }
  return problems;
}

function versionOfPackage(name) {
  try {
    const query = ['-W', '-f', '$' + '{Version}', name];
    return `${name} ${execFileSync('dpkg-query', query, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] })}`;
  } catch {
    return name;
  }
}

const reasonOf = (error) =>
  error.code === 'ENOENT'
    ? 'it is not installed'
    : String(error.stderr ?? error)
        .trim()
        .split('\n')[0];

export function rows({ names, counts }) {
  const chosen = [...loadCases().values()].filter(({ name, scene }) => scene && (!names || names.includes(name)));
  return chosen.flatMap(({ name, scene, counts: usual }) => {
    const dimensions = name.includes('3d') ? 3 : 2;
    return (counts ?? usual.filter((count) => count === 10_000 || (count >= 100_000 && count < 500_000))).map(
      (count) => ({
        kind: 'native',
        name,
        scene,
        dimensions,
        count,
        numbers: 'float32',
        by: 'boxes',
        seed: 1,
        plan,
        budget: 20_000,
        playings: 2,
        versions,
        contenders: [
          ...techniques('strip-sweep', 'auto'),
          ...programs
            .filter((each) => each.dimensions.includes(dimensions))
            .map(({ name, program, variant }) => ({
              name,
              peer: name.split(' ')[0],
              runner: () => startNative(program, variant),
            })),
        ],
      }),
    );
  });
}

export function play(row) {
  writeFrames(row);
  return race(row);
}

const framesFile = join(built, 'frames.bin');

/** Dimensions and number of boxes as uint32, then float32 frame by frame. */
function writeFrames(row) {
  const { dimensions, count, boxes, step } = openScene(row);
  const { warmUp, timed } = row.plan;
  const bytes = new Uint8Array(8 + boxes.byteLength * (warmUp + timed));
  new Uint32Array(bytes.buffer, 0, 2).set([dimensions, count]);
  const all = new Float32Array(bytes.buffer, 8);
  for (let frame = 0; frame < warmUp + timed; frame++) {
    if (frame > 0) step(frame);
    all.set(boxes, boxes.length * frame);
  }
  writeFileSync(framesFile, bytes);
}

/** A program with the interface of the harness's processes: it starts again each time it is opened. */
function startNative(program, variant) {
  let [child, lines, row, played, notes] = [];
  const stop = () => child?.kill('SIGKILL');

  async function open(order) {
    stop();
    ({ row } = order);
    played = 0;
    notes = {
      frames: [],
      give: [],
      update: [],
      walk: [],
      pairs: [],
      found: [],
      seen: [],
      start: [],
      kept: 0,
      bytes: 0,
    };
    child = spawn(program, [framesFile, variant], { stdio: ['pipe', 'pipe', 'ignore'] });
    lines = createInterface({ input: child.stdout })[Symbol.asyncIterator]();
    const { value } = await lines.next();
    if (value !== 'ready') return { error: `${program} does not begin` };
    if (order.stride !== undefined) return { ms: 0, count: row.count };
    // The first frames show how slow it is.
    await next(3);
    return { ms: Math.min(...notes.start), count: row.count };
  }

  async function next(frames) {
    const { warmUp, timed } = row.plan;
    const wanted = Math.min(frames, warmUp + timed - played);
    if (wanted > 0) child.stdin.write(`${wanted}\n`);
    for (let k = 0; k < wanted; k++, played++) {
      const { value } = await lines.next();
      if (value === undefined) return { error: 'its process ended' };
      note(value.split(' '));
    }
    if (wanted > 0) await lines.next();
    return { over: played === warmUp + timed };
  }

  function note([ms, pairs, first, second, seen]) {
    if (played < row.plan.warmUp) {
      notes.start.push(Number(ms));
      return;
    }
    notes.frames.push(played);
    notes.update.push(Number(ms));
    notes.give.push(0);
    notes.walk.push(0);
    notes.pairs.push(Number(pairs));
    notes.found.push(`${pairs} ${first} ${second}`);
    notes.seen.push(seen);
  }

  const actions = { open, play: next, notes: () => notes };
  return { stop, ask: async (action, value) => actions[action](value) };
}
