// The recorder for Phaser, in a game that runs: all its bodies are in the recording, as large as they are, where they move.
// Skipped where the packages of the examples are not installed.
import { execFile } from 'node:child_process';
import { existsSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { expect, test } from '@playwright/test';
import { openTrace } from 'broadphase/trace';

const path = (file: string) => fileURLToPath(new URL(`../../${file}`, import.meta.url));
const installed = Boolean(process.env.CI) || existsSync(path('examples/node_modules/phaser'));

test('a Phaser game is recorded as it runs', async ({ page }) => {
  test.skip(!installed, 'npm ci --prefix examples brings Phaser');
  test.slow();
  const faults: string[] = [];
  page.on('pageerror', (error) => faults.push(String(error)));
  const outDir = path('build/record-phaser');
  const vite = path('node_modules/vite/bin/vite.js');
  const config = path('examples/vite.config.mjs');
  const given = ['build', path('examples/record-phaser'), '--config', config, '--outDir', outDir, '--emptyOutDir'];
  await promisify(execFile)(process.execPath, [vite, ...given]);
  await page.route('http://phaser.test/**', async (route) => {
    const { pathname } = new URL(route.request().url());
    await route.fulfill({ path: outDir + (pathname === '/' ? '/index.html' : pathname) });
  });
  await page.goto('http://phaser.test/');
  await page.waitForFunction('globalThis.recorded?.recording.frames >= 90', undefined, { timeout: 60_000 });

  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save the recording' }).click();
  const file = await (await download).path();
  const trace = openTrace(await readFile(file));
  expect(trace.frames).toBeGreaterThanOrEqual(90);
  let moved = 0;
  for (const { index, count, boxes, rules, changed } of trace) {
    expect(count).toBe(206);
    expect(rules!.filter((number, k) => k % 3 === 2 && number === 1)).toHaveLength(6);
    // Balls and platforms, none further outside than a collision pushes it; one expectation a frame, since each takes its time.
    const strange = Array.from({ length: count }, (_, k) => [...boxes.subarray(4 * k, 4 * k + 4)]).filter(
      ([minX, , maxX]) => ![12, 70].includes(Math.round(maxX - minX)) || minX < -12 || maxX > 652,
    );
    expect(strange).toEqual([]);
    if (index > 0) moved += changed;
  }
  expect(moved).toBeGreaterThan(100 * 89);
  expect(faults).toEqual([]);
});
