// Mistakes on the benchmark's command line: each is named, with what was expected, and nothing runs.
import { spawnSync } from 'node:child_process';
import { fileURLToPath } from 'node:url';
import { expect, test } from 'vitest';

const main = fileURLToPath(new URL('../../bench/main.mjs', import.meta.url));
const bench = (...words: string[]) => spawnSync(process.execPath, [main, ...words], { encoding: 'utf8' });

test.each([
  [['--counts', '1000'], '--counts: there is no such option, expected one of --objects, '],
  [['--scenes', '--count', '1e4'], '--count: got 1e4, expected numbers of boxes, such as 1000,10000'],
  [['--scenes', '--count', '1000,'], '--count: got 1000,, expected numbers of boxes'],
  [['--motions', '--dimensions', '4'], '--dimensions: got 4, expected 2, 3 or 2,3'],
  [['--motions', '--set', 'all'], '--set: got all, expected tune or check'],
  [['--motions', '--by', 'hand'], '--by: got hand, expected set, boxes or set,boxes'],
  [['--once', '--frames', '0'], '--frames: got 0, expected a number of frames'],
  [['--once', '--frames'], '--frames: got no value, expected a number of frames'],
  [['--motions=flock'], '--motions: got a value, flock, expected none'],
  [['--compare'], '--compare: got 0 names, expected '],
  [['--compare', 'no-such-branch'], '--compare: no-such-branch is no file, and no branch or commit'],
])('%j', (words, expected) => {
  const { status, stderr, stdout } = bench(...words);
  expect(stderr).toContain(expected);
  expect(stderr).not.toContain('    at ');
  expect(status).toBe(1);
  expect(stdout).toBe('');
});

test('--help is the table of commands', () => {
  const { status, stdout } = bench('--help');
  expect(stdout).toContain('npm run bench -- --figures');
  expect(status).toBe(0);
});
