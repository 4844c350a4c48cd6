// The page of the benchmark where something is missing: files of results, workers. And while it loads: nothing moves.
import { expect, test } from '@playwright/test';

test('nothing moves while results come', async ({ page }) => {
  await page.setViewportSize({ width: 1280, height: 800 });
  await page.route(/\.json$/, async (route) => {
    await new Promise((resolve) => setTimeout(resolve, 500));
    await route.continue();
  });
  await page.addInitScript(() => {
    const shifts: number[] = [];
    Object.assign(globalThis, { shifts });
    new PerformanceObserver((list) => {
      for (const entry of list.getEntries()) shifts.push((entry as PerformanceEntry & { value: number }).value);
    }).observe({ type: 'layout-shift', buffered: true });
  });
  await page.goto('/bench/');
  await expect(page.locator('#growth')).toBeVisible();
  await page.waitForTimeout(300);
  const sum = await page.evaluate(() =>
    (globalThis as unknown as { shifts: number[] }).shifts.reduce((a, b) => a + b, 0),
  );
  expect(sum).toBeLessThan(0.05);
});

test('results that cannot be fetched are said to be missing, and the rest is there', async ({ page }) => {
  await page.route(/amd-.*\.json$/, (route) => route.abort());
  await page.goto('/bench/');
  await expect(page.locator('#note')).toHaveText(/^Results are missing: .*Reload/);
  await expect(page.locator('#growth')).toBeVisible();

  await page.route(/\.json$/, (route) => route.fulfill({ status: 503 }));
  await page.reload();
  await expect(page.locator('#note')).toHaveText(/^Results are missing: the server answered 503\./);
  await expect(page.locator('#own')).toBeVisible();
});

test('where workers are forbidden the results are shown all the same, and the race says that it failed', async ({
  page,
}) => {
  await page.addInitScript(() => {
    globalThis.Worker = class {
      constructor() {
        throw new DOMException('access denied', 'SecurityError');
      }
    } as unknown as typeof Worker;
  });
  await page.goto('/bench/');
  await expect(page.locator('#frame-answer')).toHaveText(/a whole frame takes/);
  await expect(page.locator('#run-doing')).toHaveText('It failed: access denied');
  await expect(page.getByRole('button', { name: 'Run', exact: true })).toBeDisabled();
});

test('every table that scrolls can be reached by the keyboard, and every column has a title', async ({ page }) => {
  await page.setViewportSize({ width: 390, height: 800 });
  await page.goto('/bench/');
  await expect(page.locator('#motions tbody tr').first()).toBeVisible();
  for (const summary of await page.locator('summary').all()) await summary.click();
  const wrong = await page.evaluate(
    () =>
      [
        ...[...document.querySelectorAll('table')].filter((table) => getComputedStyle(table).overflowX !== 'visible'),
        ...[...document.querySelectorAll('table')].filter((table) => !table.closest('section.scroll[tabindex="0"]')),
        ...[...document.querySelectorAll('th')].filter((th) => th.textContent === ''),
      ].length,
  );
  expect(wrong).toBe(0);
});

for (const width of [360, 1280]) {
  test(`each bar can be read: its axis has marks, which keep their distance, ${width} pixels wide`, async ({
    page,
  }) => {
    await page.setViewportSize({ width, height: 800 });
    await page.goto('/bench/');
    await expect(page.locator('#charts figure')).not.toHaveCount(0);
    const wrong = await page.locator('main figure > svg, main figure > * > svg').evaluateAll((charts) =>
      charts.flatMap((chart) => {
        const marks = [...chart.querySelectorAll('text')].filter((text) => /^[\d.]+$/.test(text.textContent!));
        const boxes = marks.map((mark) => mark.getBoundingClientRect()).sort((a, b) => a.left - b.left);
        const apart = boxes.every((box, k) => k === 0 || box.left > boxes[k - 1].right + 2);
        return boxes.length >= 2 && apart ? [] : [marks.map((mark) => mark.textContent).join(' ')];
      }),
    );
    expect(wrong).toEqual([]);
  });
}
