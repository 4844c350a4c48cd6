// The article's demos as a reader meets them, on a desk and on a phone: pointing starts them and leaving stops them,
// clicks add, buttons and sliders change the counts and the picture, and the text alternatives stay true.
import { expect, type Locator, type Page, test } from '@playwright/test';

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

test.afterEach(async ({ page }) => {
  const beyond = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
  expect(beyond, 'no horizontal scroll bar').toBeLessThanOrEqual(0);
  expect(faults).toEqual([]);
});

/** Brings a figure into sight and waits until it is live. */
async function open(page: Page, id: string): Promise<Locator> {
  if (!page.url().includes('/article/')) await page.goto('/article/');
  const figure = page.locator(`#${id}`);
  await figure.scrollIntoViewIfNeeded();
  await expect(figure).toHaveAttribute('data-state', 'live', { timeout: 15_000 });
  // In the middle of the screen, clear of whatever stays at its edges.
  await figure
    .locator('canvas')
    .first()
    .evaluate((canvas) => canvas.scrollIntoView({ block: 'center', behavior: 'instant' }));
  return figure;
}

const counter = async (figure: Locator, name: string) => {
  const text = (await figure.locator(`[data-counter="${name}"]`).textContent())!;
  return Number.parseFloat(text.replaceAll(',', '').replace('–', 'NaN'));
};
const canvas = (figure: Locator) => figure.locator('canvas').first();
const label = (figure: Locator) => canvas(figure).getAttribute('aria-label');
const stage = (figure: Locator) => figure.locator('.stage');
const press = (figure: Locator, name: string) => figure.getByRole('button', { name, exact: true }).click();
const slide = (figure: Locator, name: string, value: number) =>
  figure.getByRole('slider', { name }).fill(String(value));
const choose = (figure: Locator, name: string) => figure.getByLabel(name, { exact: true }).click();
/** What is on the canvas: two pictures are the same exactly when these are. */
const picture = (figure: Locator) =>
  canvas(figure).evaluate(async (element) => {
    await new Promise((shown) => requestAnimationFrame(() => requestAnimationFrame(shown)));
    return (element as HTMLCanvasElement).toDataURL();
  });

async function changesPicture(figure: Locator, act: () => Promise<unknown>): Promise<void> {
  const before = await picture(figure);
  await act();
  await expect.poll(() => picture(figure)).not.toBe(before);
}

for (const [device, width, height] of [
  ['desk', 1280, 900],
  ['phone', 375, 812],
] as const) {
  test.describe(device, () => {
    test.use({ viewport: { width, height } });

    for (const id of ['fig-3', 'fig-9', 'fig-16', 'fig-17', 'fig-18', 'fig-21', 'fig-22', 'fig-23', 'fig-10']) {
      test(`${id} runs while pointed at, rests otherwise, and steps by its button`, async ({ page }) => {
        const figure = await open(page, id);
        await page.mouse.move(1, 1);
        const still = await picture(figure);
        await page.waitForTimeout(150);
        expect(await picture(figure)).toBe(still);

        await changesPicture(figure, () => canvas(figure).hover());
        await expect(stage(figure)).toHaveAttribute('data-running', '');
        await page.mouse.move(1, 1);
        await expect(stage(figure)).not.toHaveAttribute('data-running', '');
        const rested = await picture(figure);
        await page.waitForTimeout(150);
        expect(await picture(figure)).toBe(rested);

        await changesPicture(figure, () => press(figure, 'Step'));
        await expect(stage(figure)).not.toHaveAttribute('data-running', '');
        expect(await label(figure)).not.toBe('');
        await page.screenshot({ path: `test-results/screens/article-${id}-${device}.png` });
      });
    }

    test('fig-3 and fig-9 add a ring at a click and at Enter, and start over', async ({ page }) => {
      for (const id of ['fig-3', 'fig-9']) {
        const figure = await open(page, id);
        const entities = () => counter(figure, 'entities');
        await expect.poll(entities).toBe(70);
        await canvas(figure).click();
        await expect.poll(entities).toBe(105);
        await canvas(figure).press('Enter');
        await expect.poll(entities).toBe(147);
        await press(figure, 'Add a ring');
        await expect.poll(entities).toBe(196);
        await page.mouse.move(1, 1);
        await expect.poll(() => label(figure)).toContain('196 squares on 7 rings');
        await press(figure, 'Start over');
        await expect.poll(entities).toBe(7);
        if (id === 'fig-3') expect(await counter(figure, 'tests')).toBe(21);
      }
    });

    test('fig-3 and fig-16 run by keyboard focus, and stop by Escape and by leaving', async ({ page }) => {
      for (const id of ['fig-3', 'fig-16']) {
        const figure = await open(page, id);
        await press(figure, 'Step');
        await page.keyboard.press('Shift+Tab');
        await expect(stage(figure)).toHaveAttribute('data-running', '');
        await page.keyboard.press('Escape');
        await expect(stage(figure)).not.toHaveAttribute('data-running', '');
      }
    });

    test('fig-9: smaller cells make more cells, larger ones more tests, all the same pairs', async ({ page }) => {
      const figure = await open(page, 'fig-9');
      const counts = async () => ({
        tests: await counter(figure, 'tests'),
        hashes: await counter(figure, 'hashes'),
        allocated: await counter(figure, 'allocated'),
        cells: await counter(figure, 'cells'),
        pairs: await counter(figure, 'pairs'),
      });
      const fitting = await counts();
      await choose(figure, 'Too small: 2');
      await expect.poll(() => counter(figure, 'cells')).toBe(240 * 180);
      const small = await counts();
      await choose(figure, 'Too large: 150');
      await expect.poll(() => counter(figure, 'cells')).toBe(4 * 3);
      const large = await counts();
      expect(small.allocated).toBeGreaterThan(10 * fitting.allocated);
      expect(small.tests).toBeLessThanOrEqual(fitting.tests);
      expect(large.tests).toBeGreaterThan(10 * fitting.tests);
      expect(large.hashes).toBeGreaterThanOrEqual(large.tests);
      expect([small.pairs, large.pairs]).toEqual([fitting.pairs, fitting.pairs]);
    });

    for (const [id, bruteForce] of [
      ['fig-6', 15],
      ['fig-7', 1128],
      ['fig-8', 3160],
    ] as const) {
      test(`${id}: the cell size changes the shading and the sums`, async ({ page }) => {
        const figure = await open(page, id);
        expect(await counter(figure, 'brute')).toBe(bruteForce);
        const slider = figure.getByRole('slider', { name: 'Cell size' });
        await changesPicture(figure, () => slider.press('Home'));
        const finest = await counter(figure, 'visits');
        await expect.poll(() => label(figure)).toContain('cells of 4.');
        await changesPicture(figure, () => slider.press('End'));
        expect(await counter(figure, 'visits')).toBe(1);
        expect(await counter(figure, 'tests')).toBe(bruteForce);
        expect(finest).toBeGreaterThan(100);
        await press(figure, 'Least work');
        await expect(figure.getByRole('status')).not.toContainText('as much work');
        await page.screenshot({ path: `test-results/screens/article-${id}-${device}.png` });
      });
    }

    test('fig-10 measures each technique in its turn', async ({ page }) => {
      const figure = await open(page, 'fig-10');
      for (const name of ['Cells of 1', 'Cells of 50', 'Library']) {
        await choose(figure, name);
        await canvas(figure).hover();
        await expect.poll(() => counter(figure, `${name} growth`), { timeout: 10_000 }).toBeGreaterThanOrEqual(0);
        await page.waitForTimeout(400);
        await page.mouse.move(1, 1);
      }
      expect(await counter(figure, 'Cells of 1 arrays')).toBeGreaterThan(10_000);
      expect(await counter(figure, 'Library arrays')).toBe(0);
      expect(await counter(figure, 'Cells of 1 growth')).toBeGreaterThan(3 * (await counter(figure, 'Library growth')));
      expect(await label(figure)).toContain('megabytes a second');
    });

    test('fig-15: giants close the valley', async ({ page }) => {
      const figure = await open(page, 'fig-15');
      const before = await counter(figure, 'least');
      await changesPicture(figure, () => slide(figure, 'Giants among 160 boxes', 16));
      expect(await counter(figure, 'least')).toBeGreaterThan(3 * before);
      await expect.poll(() => label(figure)).toContain('16 are giants');
    });

    test('fig-16: the player collects power-ups on the way, by pointer and by keys', async ({ page }) => {
      const figure = await open(page, 'fig-16');
      const { x, y, width: across, height: down } = (await canvas(figure).boundingBox())!;
      for (let i = 0; (await counter(figure, 'collected')) === 0 && i < 60; i++) {
        await page.mouse.move(x + across * (0.1 + 0.8 * (i % 2)), y + down * (0.1 + ((i * 0.13) % 0.8)), { steps: 4 });
        await page.waitForTimeout(150);
      }
      expect(await counter(figure, 'collected')).toBeGreaterThan(0);
      await page.mouse.move(1, 1);
      await canvas(figure).focus();
      await canvas(figure).press('Enter');
      await changesPicture(figure, () => canvas(figure).press('ArrowLeft', { delay: 200 }));
    });

    test('fig-17: a question that is asked finds more, and without questions nothing is found', async ({ page }) => {
      const figure = await open(page, 'fig-17');
      const found = () => counter(figure, 'found');
      const before = await found();
      await choose(figure, 'Enemies, enemies');
      await expect.poll(found).toBeGreaterThan(before);
      for (const name of ['Enemies, enemies', 'Players, power-ups', 'Players, enemies']) await choose(figure, name);
      await expect.poll(found).toBe(0);
      expect(await counter(figure, 'all')).toBeGreaterThan(0);
    });

    test('fig-18: the more boxes move, the more entries have to', async ({ page }) => {
      const figure = await open(page, 'fig-18');
      await slide(figure, 'Boxes that move', 0);
      for (let i = 0; i < 5; i++) await press(figure, 'Step');
      expect(await counter(figure, 'changed')).toBe(0);
      await slide(figure, 'Boxes that move', 100);
      for (let i = 0; i < 20; i++) await press(figure, 'Step');
      expect(await counter(figure, 'changed')).toBeGreaterThan(5);
      expect(await counter(figure, 'changed')).toBeLessThan(await counter(figure, 'rebuilt'));
    });

    test('fig-18: at rest, the numbers are those of the slider', async ({ page }) => {
      const figure = await open(page, 'fig-18');
      await page.mouse.move(1, 1);
      const numbers = () => Promise.all(['moved', 'changed'].map((name) => counter(figure, name)));
      const [few] = await numbers();
      expect(few).toBeGreaterThan(1);
      await slide(figure, 'Boxes that move', 100);
      const [moved, changed] = await numbers();
      expect(moved).toBeGreaterThan(5 * few);
      for (let i = 0; i < 40; i++) await press(figure, 'Step');
      const [later, changedLater] = await numbers();
      expect(Math.abs(later - moved)).toBeLessThan(0.2 * moved);
      expect(Math.abs(changedLater - changed)).toBeLessThan(0.2 * changed);
      await slide(figure, 'Boxes that move', 0);
      expect(await numbers()).toEqual([0, 0]);
    });

    test('fig-18 goes on while the reader is at its controls', async ({ page }) => {
      const figure = await open(page, 'fig-18');
      const slider = figure.getByRole('slider');
      await canvas(figure).hover();
      await expect(stage(figure)).toHaveAttribute('data-running', '');
      await slider.hover();
      await page.waitForTimeout(100);
      await expect(stage(figure)).toHaveAttribute('data-running', '');
      await changesPicture(figure, () => slider.click());
      await expect(stage(figure)).toHaveAttribute('data-running', '');
      await page.mouse.move(1, 1);
      await expect(stage(figure)).not.toHaveAttribute('data-running', '');
      await slider.hover();
      await page.waitForTimeout(100);
      await expect(stage(figure), 'it does not start from there').not.toHaveAttribute('data-running', '');
    });

    test('fig-19: another box, other cells; a larger giant, more of them', async ({ page }) => {
      const figure = await open(page, 'fig-19');
      await changesPicture(figure, () => press(figure, 'Next box'));
      const before = await counter(figure, 'cells');
      await changesPicture(figure, () => slide(figure, 'Largest box', 240));
      expect(await counter(figure, 'cells')).toBeGreaterThan(before);
      await changesPicture(figure, () => canvas(figure).press('Shift+ArrowRight'));
      await expect.poll(() => label(figure)).toMatch(/looks into \d+ cells/);
    });

    test('fig-20: each grid can be shown by itself', async ({ page }) => {
      const figure = await open(page, 'fig-20');
      await changesPicture(figure, () => choose(figure, 'Cells of 256'));
      await expect(figure.getByRole('status')).toContainText('4 of 80 boxes');
      await expect.poll(() => label(figure)).toContain('Shown: the grid with cells of 256, with 4 boxes.');
    });

    test('fig-22: every technique draws its structure and finds the same pairs', async ({ page }) => {
      const figure = await open(page, 'fig-22');
      const pairs = await counter(figure, 'pairs');
      const names = await figure.locator('.choice label').allTextContents();
      expect(names.length).toBeGreaterThan(2);
      for (const name of names) {
        await choose(figure, name);
        await expect.poll(() => label(figure)).toContain(`what ${name} has in memory`);
        expect(await counter(figure, 'pairs'), name).toBe(pairs);
      }
    });

    test('fig-23: more boxes, more strips', async ({ page }) => {
      const figure = await open(page, 'fig-23');
      const before = await counter(figure, 'cells');
      await changesPicture(figure, () => slide(figure, 'Boxes', 2000));
      expect(await counter(figure, 'cells')).toBeGreaterThan(before);
      expect(await counter(figure, 'share')).toBeLessThan(10);
    });

    test('fig-24: lanes follow the box, and the kernel is timed beside the article’s code', async ({ page }) => {
      const figure = await open(page, 'fig-24');
      await changesPicture(figure, () => canvas(figure).press('Shift+ArrowRight'));
      await expect(figure.getByRole('status').first()).toContainText('Yes in every row');
      await slide(figure, 'Boxes', 400);
      await expect(figure.getByRole('status').last()).toContainText('400 boxes', { timeout: 10_000 });
      await press(figure, 'Time again');
      const time = figure.locator('.timed b').first();
      await expect(time).toContainText('ms');
      await expect(figure).toContainText('Four lanes explain a factor of at most 4');
      // A long time stays on its line, and the figure as high as it was.
      const height = async () => (await figure.boundingBox())!.height;
      const before = await height();
      await time.evaluate((element) => {
        element.textContent = '148.44 ms';
      });
      expect(await height()).toBe(before);
    });

    test('table 1: both extremes as counted, and what lies between', async ({ page }) => {
      const figure = await open(page, 'table-1');
      const rows = figure.getByRole('row');
      await expect(rows.nth(1).getByRole('cell')).toHaveText(['0', '111', '4,950', '10,000']);
      await expect(rows.nth(2).getByRole('cell')).toHaveText(['4,950', '3', '4,950', '10,000']);
      await changesPicture(figure, () => slide(figure, 'Heap them up', 100));
      await expect(rows.nth(3).getByRole('cell')).toHaveText(['4,950', '3', '4,950', '10,000']);
    });
  });
}

test('with less motion asked for, pointing starts nothing, and a click does', async ({ page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  const figure = await open(page, 'fig-9');
  await canvas(figure).hover();
  await page.waitForTimeout(200);
  await expect(stage(figure)).not.toHaveAttribute('data-running', '');
  await canvas(figure).click();
  await expect(stage(figure)).toHaveAttribute('data-running', '');
});

test('what runs stops when less motion is asked for', async ({ page }) => {
  await page.emulateMedia({ reducedMotion: 'no-preference' });
  const figure = await open(page, 'fig-9');
  await canvas(figure).hover();
  await expect(stage(figure)).toHaveAttribute('data-running', '');
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await expect(stage(figure)).not.toHaveAttribute('data-running', '');
});

test.describe('by touch', () => {
  test.use({ viewport: { width: 375, height: 812 }, hasTouch: true });

  test('a tap starts it and adds a ring, a tap elsewhere stops it', async ({ page }) => {
    const figure = await open(page, 'fig-3');
    await canvas(figure).tap();
    await expect(stage(figure)).toHaveAttribute('data-running', '');
    await expect.poll(() => counter(figure, 'entities')).toBe(105);
    const hint = () =>
      stage(figure).evaluate((place) => getComputedStyle(place.querySelector('.stage-hint')!, '::before').content);
    expect(await hint()).toBe('"Tap elsewhere to stop"');
    await figure.locator('figcaption').tap();
    await expect(stage(figure)).not.toHaveAttribute('data-running', '');
  });
});

test('turns with the colour scheme', async ({ page }) => {
  await page.emulateMedia({ colorScheme: 'light' });
  for (const id of ['fig-3', 'fig-6']) {
    const figure = await open(page, id);
    await page.mouse.move(1, 1);
    await page.emulateMedia({ colorScheme: 'light' });
    await changesPicture(figure, () => page.emulateMedia({ colorScheme: 'dark' }));
  }
});
