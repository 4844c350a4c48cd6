// On paper: light, whatever the screen is; pictures keep their shape, and no code is cut off.
import { expect, test } from '@playwright/test';

test('the article in print: light, with whole code, and a word where a picture did not run', async ({ page }) => {
  await page.emulateMedia({ colorScheme: 'dark' });
  await page.goto('/article/');
  const [mapping, loops] = [page.locator('#fig-4'), page.locator('#fig-2')];
  for (const figure of [mapping, loops]) {
    await figure.scrollIntoViewIfNeeded();
    await expect(figure).toHaveAttribute('data-state', 'live');
  }
  const canvas = mapping.locator('canvas').first();
  // Looks for the grid of the light theme when the page turns to print, before the next frame.
  await canvas.evaluate((each: HTMLCanvasElement) => {
    const [red, green, blue] = [0xd3, 0xd5, 0xda];
    const grid = ((255 << 24) | (blue << 16) | (green << 8) | red) >>> 0;
    matchMedia('print').addEventListener('change', () => {
      const { data } = each.getContext('2d')!.getImageData(0, 0, each.width, each.height);
      each.dataset.light = String(new Uint32Array(data.buffer).includes(grid));
    });
  });
  await page.emulateMedia({ colorScheme: 'dark', media: 'print' });
  await expect(canvas).toHaveAttribute('data-light', 'true');
  await expect(page.locator('body')).toHaveCSS('background-color', 'rgb(251, 251, 250)');

  const stretched = await canvas.evaluate(
    (each: HTMLCanvasElement) => each.clientWidth / each.clientHeight / (each.width / each.height),
  );
  expect(stretched).toBeCloseTo(1, 1);
  const code = loops.locator('.listing pre').first();
  expect(await code.evaluate((each) => each.scrollHeight - each.clientHeight)).toBe(0);
  const unseen = page.locator('#fig-14 .live');
  expect(await unseen.evaluate((each) => getComputedStyle(each, '::before').content)).toContain('printed only if');
});
