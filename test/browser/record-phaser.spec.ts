// The recorder for Phaser, in a game that runs: all its bodies are in the recording, as large as they are, where they move.
import { readFile } from 'node:fs/promises';
import { expect, test } from '@playwright/test';
import { openTrace } from 'broadphase/trace';
import { openExample } from './example.ts';

test('a Phaser game is recorded as it runs', async ({ page }) => {
  test.slow();
  const faults = await openExample(page, 'record-phaser');
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
