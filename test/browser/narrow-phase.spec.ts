// The page of what comes after the pairs: each of the three narrow phases finds some of the pairs, and never more.
import { expect, type Page, test } from '@playwright/test';

let faults: string[] = [];

test.beforeEach(({ page }) => {
  faults = [];
  page.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
  page.on('pageerror', (error) => faults.push(String(error)));
});

test.afterEach(() => expect(faults).toEqual([]));

const number = async (page: Page, name: string) => Number(await page.locator(`[data-number=${name}]`).textContent());

for (const [name, label] of [
  ['shapes', 'Convex shapes'],
  ['masks', 'Pixel masks'],
  ['fast', 'Fast boxes'],
] as const) {
  test(`${label}: what touches is among the pairs`, async ({ page }) => {
    await page.emulateMedia({ reducedMotion: 'reduce' });
    await page.goto(`/narrow-phase/#${name === 'shapes' ? 'masks' : 'shapes'}`);
    await expect(page.locator('#code')).not.toBeEmpty(); // the page waits for its kernel, and hears nobody before
    await page.getByRole('radio', { name: label }).check({ force: true });
    await expect(page).toHaveURL(new RegExp(`#${name}$`));
    await page.getByRole('combobox', { name: 'Things' }).selectOption('150');
    let [pairs, hits] = [0, 0];
    for (let step = 0; step < 5; step++) {
      await page.getByRole('button', { name: 'Step' }).click();
      const now = [await number(page, 'pairs'), await number(page, 'hits')];
      expect(now[1]).toBeLessThanOrEqual(now[0]);
      pairs += now[0];
      hits += now[1];
    }
    expect(hits).toBeGreaterThan(0);
    expect(hits).toBeLessThan(pairs);
  });
}

test('it runs by itself, and fits a phone', async ({ page }) => {
  await page.setViewportSize({ width: 375, height: 740 });
  await page.goto('/narrow-phase/#masks');
  await expect(page.getByRole('radio', { name: 'Pixel masks' })).toBeChecked();
  const before = await page.locator('#canvas').screenshot();
  await expect.poll(async () => (await page.locator('#canvas').screenshot()).equals(before)).toBe(false);
  await page.getByRole('button', { name: 'Pause' }).click();
  await expect(page.getByRole('button', { name: 'Play' })).toBeVisible();
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(375);
});

test('the numbers beside a picture that was paused are those of the picture', async ({ page }) => {
  // Counts the shapes that were filled in the last frame, which begins with its background.
  await page.addInitScript(`{
    const { fill, setTransform } = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.setTransform = function (...given) {
      if (given[0] === 1) window.filled = 0;
      return setTransform.apply(this, given);
    };
    CanvasRenderingContext2D.prototype.fill = function (...given) {
      window.filled++;
      return fill.apply(this, given);
    };
  }`);
  await page.goto('/narrow-phase/#shapes');
  for (let round = 0; round < 12; round++) {
    await page.waitForTimeout(130);
    await page.getByRole('button', { name: 'Pause' }).click();
    const filled = (await page.evaluate('filled')) as number;
    const hits = await number(page, 'hits');
    expect(filled, `${hits} touch`).toBeLessThanOrEqual(2 * hits);
    expect(filled > 0, `${hits} touch`).toBe(hits > 0);
    await page.getByRole('button', { name: 'Play' }).click();
  }
});
