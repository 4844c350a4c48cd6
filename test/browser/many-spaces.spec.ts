// How many spaces a page can hold: at least 100. One too many is refused by an error that says what to do, and one that
// was disposed of makes room.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect, test } from '@playwright/test';

const library = fileURLToPath(new URL('../../dist/index.js', import.meta.url));
/** More than Chromium allows in a page, which is 125. */
const tooMany = 1000;

test('a page holds 100 spaces, and says when there is no room for another', async ({ page }) => {
  await page.route('http://many.test/**', (route) => {
    const isScript = route.request().url().endsWith('.js');
    return route.fulfill({
      body: isScript ? readFileSync(library, 'utf8') : '<!doctype html><title>many</title>',
      contentType: isScript ? 'text/javascript' : 'text/html',
    });
  });
  await page.goto('http://many.test/');
  const { made, message, pairs } = await page.evaluate(async (most) => {
    const address = '/index.js';
    const { BroadPhase } = await import(address);
    const spaces: { dispose(): void }[] = [];
    let message = '';
    try {
      while (spaces.length < most) spaces.push(new BroadPhase());
    } catch (error) {
      message = String(error);
    }
    const made = spaces.length;
    for (const space of spaces.splice(0)) space.dispose();
    return { made, message, pairs: new BroadPhase().set(0, 0, 0, 9, 9).set(1, 5, 5, 6, 6).update().pairCount };
  }, tooMany);
  expect(made).toBeGreaterThanOrEqual(100);
  expect(message).toMatch(/^RangeError: no memory for another space: .*dispose\(\)/);
  expect(pairs).toBe(1);
});
