// The article as a reader meets it: its frame, and the figures that step, drag and count. At phone and desktop size,
// light and dark, with nothing on the console, nothing fetched from elsewhere, nothing that jumps.
import { existsSync, readFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import { expect, type Locator, type Page, test } from '@playwright/test';

/** The figures that this file drives. */
const driven = ['fig-step', 'fig-1', 'fig-2', 'fig-4', 'fig-5', 'fig-11', 'fig-12', 'fig-13', 'fig-14'] as const;
const firstPaintWithin = 1000;
/** Bytes gzipped, of which the kernel with every technique takes some 87,000. */
const scriptWithin = 239_000;
/** What layout shift a reader does not notice. */
const shiftWithin = 0.01;

let faults: string[] = [];

test.beforeEach(({ page, baseURL }) => {
  faults = [];
  page.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
  page.on('pageerror', (error) => faults.push(String(error)));
  page.on('requestfailed', (request) => {
    // What a page still loads when the reader goes on to the next is called off, and no fault.
    if (request.failure()?.errorText !== 'net::ERR_ABORTED') faults.push(`failed: ${request.url()}`);
  });
  page.on('response', (response) => response.status() >= 400 && faults.push(`${response.status()} ${response.url()}`));
  page.on('request', (request) => {
    const url = request.url();
    if (!/^(data|blob):/.test(url) && !url.startsWith(baseURL!)) faults.push(`a request to ${url}`);
  });
});

test.afterEach(() => expect(faults).toEqual([]));

/** A figure that is in sight and alive. */
async function figure(page: Page, id: string): Promise<Locator> {
  const found = page.locator(`#${id}`);
  await found.scrollIntoViewIfNeeded();
  await expect(found).toHaveAttribute('data-state', 'live');
  return found;
}

const counter = async (within: Locator, name: string) =>
  Number((await within.locator(`[data-counter=${name}]`).textContent())!.replaceAll(',', ''));
const press = (within: Locator, name: string) => within.getByRole('button', { name, exact: true }).click();
const track = (within: Locator) => within.locator('.track').getByRole('slider');
const picture = (within: Locator) => within.getByRole('img').first();
const words = async (within: Locator) => (await picture(within).getAttribute('aria-label'))!;

test('the front page leads to the article and its demos, and the article back', async ({ page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.goto('/');
  await page.getByRole('link', { name: /How it works: the article/ }).click();
  await expect(page).toHaveURL(/\/article\/$/);
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('How a game knows what touches what');
  await page.getByRole('navigation', { name: 'Site' }).getByRole('link', { name: 'broadphase' }).click();
  await page.getByRole('link', { name: 'The cell size of a grid' }).click();
  await expect(page).toHaveURL(/#fig-9$/);
  await expect(page.locator('#fig-9')).toBeInViewport();
  await page.goBack();
  await page.getByRole('navigation', { name: 'Site' }).getByRole('link', { name: 'Article' }).click();
  await expect(page).toHaveURL(/\/article\/$/);
});

test('every link within the article has somewhere to go, and every note a way back', async ({ page }) => {
  await page.goto('/article/');
  const lost = await page.$$eval('a[href^="#"]', (links) =>
    links.map((link) => link.getAttribute('href')!).filter((href) => !document.querySelector(href)),
  );
  expect(lost).toEqual([]);
  for (let note = 1; note <= 6; note++) {
    await expect(page.locator(`a[href="#note-${note}"]`)).toHaveCount(1);
    await expect(page.locator(`a[href="#mark-${note}"]`)).toHaveCount(1);
  }
});

test('figures start only when they are near the viewport', async ({ page }) => {
  await page.goto('/article/');
  await expect(page.locator('h1')).toBeVisible();
  await expect(page.locator('#fig-14')).not.toHaveAttribute('data-state');
  await figure(page, 'fig-14');
});

test('the world: eight stages in their order, then the next step', async ({ page }) => {
  await page.goto('/article/');
  const world = await figure(page, 'fig-step');
  const current = world.locator('[aria-current=step]');
  for (const stage of [
    'Clear the screen',
    'Draw',
    'Accelerate all',
    'Update the technique',
    'Query for pairs',
    'handleCollisions',
    'Inertia for all',
    'update',
  ]) {
    await expect(current).toHaveText(stage);
    expect(await words(world)).toContain('Step 1');
    await press(world, 'Step');
  }
  await expect(current).toHaveText('Clear the screen');
  expect(await words(world)).toContain('Step 2');
  await press(world, 'Back');
  await expect(current).toHaveText('update');
  await press(world, 'Play');
  await expect(current).not.toHaveText('update');
  await press(world, 'Pause');
});

test('figure 1: 4,950 comparisons for 100 boxes, counted, and more boxes by the slider', async ({ page }) => {
  await page.goto('/article/');
  const plot = await figure(page, 'fig-1');
  const slider = plot.getByRole('slider', { name: 'Boxes' });
  await slider.press('Home');
  const cells = plot.locator('tbody td');
  await expect(cells.nth(0)).toHaveText('100');
  await expect(cells.nth(1)).toHaveText('4,950');
  await slider.fill('1500');
  await expect(cells.nth(0)).toHaveText('1,500', { timeout: 20_000 });
  await expect(cells.nth(1)).toHaveText('1,124,250');
  const grid = Number((await cells.nth(2).textContent())!.replaceAll(',', ''));
  expect(grid).toBeGreaterThan(0);
  expect(grid).toBeLessThan(1_124_250 / 100);
  await picture(plot).press('ArrowLeft');
  await expect(cells.nth(0)).toHaveText('1,400');
  await expect.poll(() => words(plot)).toContain('1,400 boxes: brute force 979,300');
  await plot.getByRole('radio', { name: '×10' }).check();
});

test('figure 1 counts to the end while it is out of sight', async ({ page }) => {
  await page.goto('/article/');
  const plot = await figure(page, 'fig-1');
  const counted = plot.locator('tbody td').first();
  await plot.getByRole('slider', { name: 'Boxes' }).fill('3000');
  await page.evaluate(() => window.scrollTo({ top: document.body.scrollHeight, behavior: 'instant' }));
  await expect(plot).not.toBeInViewport();
  await expect(counted).toHaveText('3,000', { timeout: 20_000 });
});

test('figure 2: every operation of brute force, 15 comparisons of six boxes', async ({ page }) => {
  await page.goto('/article/');
  const loops = await figure(page, 'fig-2');
  const lit = loops.locator('[data-lit]');
  await expect(lit).toContainText('for (let i');
  await press(loops, 'Step');
  await expect(lit).toContainText('for (let j');
  await press(loops, 'Step');
  await expect(lit).toContainText('this.collisionTests++');
  await press(loops, 'Step');
  await expect(lit).toContainText('this.aabb2DIntersection');
  expect(await counter(loops, 'tests')).toBe(1);
  expect(await counter(loops, 'pairs')).toBe(1);
  await track(loops).press('End');
  expect(await counter(loops, 'tests')).toBe(15);
  expect(await counter(loops, 'pairs')).toBe(2);
  await expect(loops.getByRole('img').nth(1)).toHaveAttribute('aria-label', /15 of 15 pairs/);
});

test('figure 4: the box at 20, 50 lies in six cells, and moves by mouse and by keys', async ({ page }) => {
  await page.goto('/article/');
  const mapping = await figure(page, 'fig-4');
  const said = mapping.getByRole('status');
  await expect(said).toContainText('6 cells hold the box');
  await expect(said).toContainText('grid[0][B], which is grid[0][1]');
  await expect(mapping.locator('.slot.full')).toHaveCount(6);
  const canvas = picture(mapping);
  await canvas.press('Shift+ArrowRight');
  await expect(said).toContainText('grid[1][B]');
  expect(await words(mapping)).toContain('at 70, 50');
  const frame = (await canvas.boundingBox())!;
  await page.mouse.move(frame.x + frame.width / 2, frame.y + frame.height / 2);
  await page.mouse.down();
  await page.mouse.move(frame.x + frame.width / 2, frame.y, { steps: 5 });
  await page.mouse.up();
  await expect(said).toContainText('grid[1][A]');
  await mapping.getByRole('slider', { name: 'Cell size' }).press('End');
  await expect(mapping.locator('.arrays > code')).toHaveCount(3);
});

test('a figure that could not be fetched can be tried again', async ({ page }) => {
  const script = /mapping[^/]*\.(js|ts)/;
  await page.route(script, (route) => route.abort());
  await page.goto('/article/');
  const mapping = page.locator('#fig-4');
  await mapping.scrollIntoViewIfNeeded();
  await expect(mapping).toContainText('This figure stopped');
  await page.unroute(script);
  await mapping.getByRole('button', { name: 'Try again' }).click();
  await expect(mapping.getByRole('slider', { name: 'Cell size' })).toBeVisible();
  await expect(mapping).not.toContainText('This figure stopped');
  faults = []; // those of the first try
});

for (const width of [1440, 768, 390]) {
  test(`figure 4 stays as high and its slider where it is, whatever the cells: ${width}`, async ({ page }) => {
    await page.setViewportSize({ width, height: 900 });
    await page.goto('/article/');
    const mapping = await figure(page, 'fig-4');
    const slider = mapping.getByRole('slider', { name: 'Cell size' });
    const places = async () => {
      const [whole, part] = [(await mapping.boundingBox())!, (await slider.boundingBox())!];
      return [whole.height, part.y - whole.y].map(Math.round);
    };
    const before = await places();
    for (const size of ['20', '25', '30', '35', '80']) {
      await slider.fill(size);
      expect(await places(), `cells of ${size}`).toEqual(before);
    }
  });
}

test('figure 5: a point is found in a grid with a negative minimum, in and beyond it', async ({ page }) => {
  await page.goto('/article/');
  const offset = await figure(page, 'fig-5');
  await expect(offset.getByRole('status')).toContainText('grid[2][3]');
  await expect(offset.locator('.sum')).toContainText('floor((-30 − (-120)) / 40)');
  await picture(offset).press('Shift+ArrowLeft');
  await expect(offset.locator('.sum')).toContainText('border cell');
  await expect(offset.getByRole('status')).toContainText('grid[0][3]');
  await offset.getByRole('radio', { name: 'the grid' }).check();
  await picture(offset).press('ArrowRight');
  await expect(offset.getByRole('status')).toContainText('grid.min is { x: -110, y: -90 }');
});

test('figures 11 and 12: the grid is filled and asked, and finds what there is', async ({ page }) => {
  await page.goto('/article/');
  const filling = await figure(page, 'fig-11');
  await expect(filling.locator('[data-lit]')).toContainText('this.grid = new Array');
  expect(await counter(filling, 'arrays')).toBe(1);
  await track(filling).press('End');
  await expect(filling.locator('[data-lit]')).toContainText('column[cell].push');
  const cells = await counter(filling, 'cells');
  expect(await counter(filling, 'arrays')).toBe(1 + 4 + cells);
  await expect(filling.locator('.slot.full')).toHaveCount(cells);

  const asking = await figure(page, 'fig-12');
  await track(asking).press('End');
  expect(await counter(asking, 'visits')).toBe(cells);
  expect(await counter(asking, 'pairs')).toBe(2);
  // 3 and 4 meet in two cells, and are compared in one.
  expect(await counter(asking, 'lookups')).toBe((await counter(asking, 'tests')) + 1);
});

test('figure 13: numbers are handed out in turn and never twice', async ({ page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.goto('/article/');
  const ids = await figure(page, 'fig-13');
  for (let id = 0; id < 3; id++) {
    if (id > 0) await press(ids, 'Add an entity');
    await track(ids).press('End');
    await expect(ids.getByRole('status')).toContainText(`Entity ${id} is in the list`);
  }
  await press(ids, 'Take out entity 1');
  await expect(ids.locator('.chips li')).toHaveText(['0', '2']);
  await expect(ids.getByRole('status')).toContainText('Entity 1 is gone');
  await expect(ids.getByRole('button', { name: 'Back' })).toBeDisabled(); // nothing is told of who is gone
  await press(ids, 'Add an entity');
  await track(ids).press('End');
  await expect(ids.locator('.chips li')).toHaveText(['0', '2', '3']);
  expect(await counter(ids, 'uniq')).toBe(4);
});

test('figure 14: smaller cells make more lookups, and no pair is compared twice', async ({ page }) => {
  await page.goto('/article/');
  const table = await figure(page, 'fig-14');
  const ends: number[] = [];
  for (const size of ['large', 'fitting', 'small']) {
    await table.getByRole('radio', { name: size }).check();
    await track(table).press('End');
    const tests = await counter(table, 'tests');
    await expect(table.locator('.keys li')).toHaveCount(tests);
    expect(await counter(table, 'saved')).toBe((await counter(table, 'lookups')) - tests);
    ends.push(await counter(table, 'lookups'));
  }
  expect(ends[2]).toBeGreaterThan(ends[1]);
});

test('who asks for less motion sees nothing start by itself', async ({ page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.goto('/article/');
  const world = await figure(page, 'fig-step');
  const before = await words(world);
  await picture(world).hover();
  await page.waitForTimeout(1000);
  expect(await words(world)).toBe(before);
  expect(await page.evaluate(() => getComputedStyle(document.documentElement).scrollBehavior)).toBe('auto');
});

test('the first paint comes within a second', async ({ page }) => {
  await page.goto('/article/');
  const paint = () =>
    page.evaluate(() => performance.getEntriesByName('first-contentful-paint')[0]?.startTime ?? Number.NaN);
  await expect.poll(paint).toBeLessThan(firstPaintWithin);
});

/** Scrolls through the whole page, a part of a screen at a time, so that every figure is mounted. */
async function readThrough(page: Page): Promise<void> {
  const { height, step } = await page.evaluate(() => ({
    height: document.documentElement.scrollHeight,
    step: innerHeight * 0.6,
  }));
  for (let y = 0; y < height; y += step) {
    await page.evaluate((top) => scrollTo({ top, behavior: 'instant' }), y);
    await page.waitForTimeout(60);
  }
}

for (const [device, width, height] of [
  ['phone', 375, 812],
  ['wide', 1440, 900],
] as const) {
  for (const colorScheme of ['light', 'dark'] as const) {
    test(`reads well on a ${device} screen, ${colorScheme}`, async ({ page }) => {
      test.slow();
      await page.setViewportSize({ width, height });
      await page.emulateMedia({ colorScheme, reducedMotion: 'reduce' });
      await page.addInitScript(() => {
        const shifts: number[] = [];
        Object.assign(globalThis, { shifts });
        new PerformanceObserver((list) => {
          for (const entry of list.getEntries()) shifts.push((entry as unknown as { value: number }).value);
        }).observe({ type: 'layout-shift', buffered: true });
      });
      await page.goto('/article/');
      await page.screenshot({ path: `test-results/screens/article-${device}-${colorScheme}.png` });
      await readThrough(page);
      await expect(page.locator('figure[data-state=failed]')).toHaveCount(0);
      const shifted = await page.evaluate(() => (globalThis as unknown as { shifts: number[] }).shifts);
      expect(shifted.reduce((sum, shift) => sum + shift, 0)).toBeLessThan(shiftWithin);
      expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
      const column = (await page.locator('.page > p').first().boundingBox())!;
      expect(column.width).toBeGreaterThan(Math.min(600, width * 0.85));
      // Every canvas says what it shows.
      const silent = await page.$$eval('canvas', (all) =>
        all.filter((canvas) => canvas.getAttribute('role') !== 'img' || !canvas.getAttribute('aria-label')).map(String),
      );
      expect(silent).toEqual([]);
      for (const id of driven) {
        const shown = await figure(page, id);
        await page.waitForTimeout(100);
        await shown.screenshot({ path: `test-results/screens/${id}-${device}-${colorScheme}.png` });
      }
    });
  }
}

test("each page's script is small, every figure included", () => {
  const site = new URL('../../site/dist/', import.meta.url);
  for (const page of ['index.html', 'article/index.html']) {
    /** The scripts that the page names, those that they name, and so on. */
    const scripts = new Set<string>();
    const collect = (text: string) => {
      for (const [, name] of text.matchAll(/[/"'`]([\w-]{1,80}\.js)\b/g)) {
        const file = new URL(`assets/${name}`, site);
        if (scripts.has(name) || !existsSync(file)) continue;
        scripts.add(name);
        collect(readFileSync(file, 'utf8'));
      }
    };
    collect(readFileSync(new URL(page, site), 'utf8'));
    expect(scripts.size, page).toBeGreaterThan(page === 'index.html' ? 0 : driven.length);
    const sizes = [...scripts].map((name) => gzipSync(readFileSync(new URL(`assets/${name}`, site))).length);
    expect(
      sizes.reduce((sum, size) => sum + size, 0),
      page,
    ).toBeLessThan(scriptWithin);
  }
});
