// The page of the benchmark as a visitor meets it: figures out of a file of results, filters, growth, the heat map and its
// advice; and a race in the browser itself, whose result can be saved and shown again.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect, type Page, test } from '@playwright/test';

const file = fileURLToPath(new URL('../fixtures/bench-results.json', import.meta.url));
const coherence = fileURLToPath(new URL('../fixtures/bench-coherence.json', import.meta.url));
const { races } = JSON.parse(readFileSync(file, 'utf8'));

let faults: string[] = [];

test.beforeEach(({ page, baseURL }) => {
  faults = [];
  page.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
  page.on('pageerror', (error) => faults.push(String(error)));
  page.on('response', (response) => response.status() >= 400 && faults.push(`${response.status()} ${response.url()}`));
  page.on('request', (request) => {
    const url = request.url();
    if (!/^(data|blob):/.test(url) && !url.startsWith(baseURL!)) faults.push(`a request to ${url}`);
  });
});

test.afterEach(() => expect(faults).toEqual([]));

async function openResults(page: Page): Promise<void> {
  await page.goto('/bench/');
  await page.getByLabel('Results of your own').setInputFiles(file);
  await expect(page.getByLabel('Measured on')).toHaveValue('bench-results.json');
}

const charts = (page: Page) => page.locator('#charts figure');

test('the front page leads here', async ({ page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.goto('/');
  await page.getByRole('navigation', { name: 'Site' }).getByRole('link', { name: 'Benchmark' }).click();
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('The benchmark');
});

test('each race is a figure with its bars, its numbers and its command', async ({ page }) => {
  await openResults(page);
  await expect(charts(page)).toHaveCount(races.length);
  await page.getByLabel('Dimensions').selectOption('3D');
  await expect(charts(page)).toHaveCount(races.filter((race: { dimensions: number }) => race.dimensions === 3).length);
  await page.locator('#count').selectOption('2,000');
  await expect(charts(page)).toHaveCount(1);
  const figure = charts(page).first();
  await expect(figure.getByRole('img')).toHaveAttribute('aria-label', /uniform3d with 2,000 boxes\. The fastest: \S+/);
  const timed = races.find(
    (race: { scene: string; count: number }) => race.scene === 'uniform3d' && race.count === 2000,
  );
  const contenders = timed.results.filter(
    (each: { peer: string; figures?: object }) => each.figures && each.peer !== 'floor',
  );
  await expect(figure.locator('svg rect')).toHaveCount(contenders.length);
  await figure.getByText('Figures, and how').click();
  await expect(figure.locator('code')).toHaveText('npm run bench -- --scenes uniform3d --n 2000');
  await expect(figure.locator('tbody tr')).not.toHaveCount(0);
});

test('growth has a line and a power for each contender, the heat map advice', async ({ page }) => {
  await openResults(page);
  await page.locator('#growth-scene').selectOption('mixed2d');
  const rows = page.locator('#growth tbody tr');
  await expect(rows.filter({ hasText: 'strip-sweep' })).toHaveText(/strip-sweep0\.\d\d|strip-sweep1\.\d\d/);
  await expect(page.locator('#growth svg path')).not.toHaveCount(0);
  await expect(page.locator('#advice tbody tr')).toHaveCount(5);
  await expect(page.locator('#advice')).toContainText('best, or within 10 %');
});

test('what an update costs when little changes is a table, with the goals', async ({ page }) => {
  await page.goto('/bench/');
  await page.getByLabel('Results of your own').setInputFiles(coherence);
  const part = page.getByRole('region', { name: 'When little changes' });
  await expect(part).toContainText('Measured on A machine, 2026-11-21');
  const rows = part.getByRole('region', { name: 'Figures, scene by scene' }).locator('tbody tr');
  await expect(rows).toHaveCount(3);
  await expect(rows.first()).toContainText('0.320 / 0.384 / 0.448');
  await expect(part.getByRole('region', { name: 'Goals' })).toContainText('0 of 1; the worst: 0.31xno');
});

test('a file that is none is refused in words', async ({ page }) => {
  await page.goto('/bench/');
  await page
    .getByLabel('Results of your own')
    .setInputFiles({ name: 'a.json', mimeType: '', buffer: Buffer.from('{}') });
  await expect(page.locator('#note')).toContainText('a.json was not read: these are no results');
});

test('the race runs in the browser: all find the same pairs, and the result can be saved and shown', async ({
  page,
}) => {
  await page.goto('/bench/');
  await page.locator('#run-count').selectOption('1,000');
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await expect(page.locator('#run-doing')).toContainText(/checking|round/);
  await expect(page.locator('#run-doing')).toContainText('Done', { timeout: 45_000 });
  const figure = page.locator('#run-result figure');
  await expect(figure.locator('svg rect')).toHaveCount(7);
  await expect(figure.locator('tbody tr').filter({ hasText: 'box-intersect' })).toHaveText(/box-intersect[\d.]+/);
  const saving = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save the result' }).click();
  const saved = await (await saving).path();
  await page.getByLabel('Results of your own').setInputFiles(saved);
  await expect(charts(page)).toHaveCount(1);

  await page.locator('#run-scene').selectOption('uniform3d');
  await expect(page.getByLabel('flatbush')).toBeDisabled();
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await page.getByRole('button', { name: 'Stop' }).click();
  await expect(page.locator('#run-doing')).toHaveText('Stopped.');
});

for (const [name, width, colorScheme] of [
  ['phone-light', 390, 'light'],
  ['phone-dark', 390, 'dark'],
  ['desktop-light', 1280, 'light'],
  ['desktop-dark', 1280, 'dark'],
] as const) {
  test(`looks right: ${name}`, async ({ page }) => {
    await page.setViewportSize({ width, height: 900 });
    await page.emulateMedia({ colorScheme });
    await openResults(page);
    await page.getByLabel('Results of your own').setInputFiles(coherence);
    await expect(page.locator('#coherence')).toBeVisible();
    const overflow = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    expect(overflow).toBeLessThanOrEqual(0);
    await page.screenshot({ path: `test-results/screens/bench-${name}.png`, fullPage: true });
  });
}
