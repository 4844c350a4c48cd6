// The guard against slow change: times are noisy, but how much work a technique does is the same on every machine. Each
// technique's counters in each scene are held against bench/expected-work.json, and so is the size of the kernel.
// Pairs must be equal. What else is counted may grow by the tolerance: a change that pays elsewhere may cost a little
// here, and what creeps is caught, for expectations only move when somebody moves them. Less work is always fine.
// What has no expectation yet, such as a new technique, is written down; on CI that is a failure instead.
//   npm run bench:work      rewrites all expectations
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { BroadPhase, type Stats } from 'broadphase';
import { afterAll, describe, expect, test } from 'vitest';
import { createScene, gameNames, sceneNames } from '../../src/scenes/index.ts';
import type { RecordedFrames } from '../../src/scenes/recorded.ts';
import { readTrace, type TraceName } from '../support/recordings.ts';

const tolerance = 0.02;
const boxes = 1000;
const frames = 3;
const recorded: readonly TraceName[] = ['tumbler', 'rapier3d-gravity8k'];
const counters = ['tests', 'candidates', 'pairs', 'cells', 'entries', 'bytes'] as const;

type Work = Partial<Record<(typeof counters)[number] | 'wasm', number>>;

const file = fileURLToPath(new URL('../../bench/expected-work.json', import.meta.url));
const rewrite = process.env.REWRITE_EXPECTED_WORK === '1' || !existsSync(file);
const expectations: Record<string, Work> = rewrite ? {} : JSON.parse(readFileSync(file, 'utf8'));
let written = rewrite;

const playable = [
  ...[...sceneNames, ...gameNames].map((name) => ({ name: name as string, open: () => createScene(name, boxes) })),
  ...recorded.map((name) => {
    const recording = readTrace(name);
    return { name: name as string, open: () => play(recording) };
  }),
];

describe.each(BroadPhase.techniques)('%s does no more work than before', (technique) => {
  test.each(playable)('in $name', ({ name, open }) => {
    const scene = open();
    const space = new BroadPhase({ dimensions: scene.dimensions, technique });
    const work: Record<(typeof counters)[number], number> = {
      tests: 0,
      candidates: 0,
      pairs: 0,
      cells: 0,
      entries: 0,
      bytes: 0,
    };
    for (let frame = 0; frame < frames; frame++) {
      scene.step();
      add(work, space.setAll(scene.boxes).update().stats);
    }
    compare(`${name} ${technique}`, work);
  });
});

test.each(['kernel', 'kernel-lean'])('the %s is no larger than before', (name) => {
  const wasm = readFileSync(fileURLToPath(new URL(`../../build/${name}.wasm`, import.meta.url))).length;
  compare(name, { wasm });
});

afterAll(() => {
  if (!written) return;
  const lines = Object.entries(expectations).map(
    ([name, work]) => `  ${JSON.stringify(name)}: ${JSON.stringify(work)}`,
  );
  writeFileSync(file, `{\n${lines.sort().join(',\n')}\n}\n`);
});

/** Counters of all frames are added up, but memory in use is that of the last. */
function add(work: Record<(typeof counters)[number], number>, stats: Stats): void {
  for (const counter of counters) work[counter] += stats[counter];
  work.bytes = stats.bytes;
}

function compare(name: string, work: Work): void {
  const expected = expectations[name];
  if (expected === undefined) {
    expect(process.env.CI, `${name} has no expectation: run the tests, and commit ${file}`).toBeFalsy();
    expectations[name] = work;
    written = true;
    return;
  }
  expect(work.pairs, `${name}: pairs`).toBe(expected.pairs);
  for (const [counter, count] of Object.entries(work)) {
    const most = Math.ceil((expected[counter as keyof Work] ?? 0) * (1 + tolerance));
    expect(count, `${name}: ${counter}; where the change is worth it: npm run bench:work`).toBeLessThanOrEqual(most);
  }
}

function play(recording: RecordedFrames) {
  let at = -1;
  return {
    dimensions: recording.dimensions,
    boxes: recording.frame(0),
    step() {
      this.boxes = recording.frame(++at % recording.frames);
    },
  };
}
