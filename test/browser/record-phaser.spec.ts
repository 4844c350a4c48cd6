// The recorder for Phaser, in a game that runs: every collision of arcade physics is among the pairs of the recording.
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
    for (let at = 0; at < boxes.length; at += 4) {
      expect([12, 70]).toContain(Math.round(boxes[at + 2] - boxes[at]));
      expect(boxes[at]).toBeGreaterThan(-1);
      expect(boxes[at + 2]).toBeLessThan(641);
    }
    if (index > 0) moved += changed;
  }
  expect(moved).toBeGreaterThan(100 * 89);
  expect(faults).toEqual([]);
});
