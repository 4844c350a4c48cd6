// Where the system forces its colours, as Windows' contrast themes do: what is chosen, pressed or current differs from
// the rest, the focus is seen, and bars and sliders have not vanished with their backgrounds. And where more contrast is
// asked for.
import { expect, type Locator, type Page, test } from '@playwright/test';

test.beforeEach(async ({ page }) => {
  test.slow();
  await page.emulateMedia({ forcedColors: 'active', reducedMotion: 'reduce' });
});

/** How an element differs from its like, without its text. */
const lookOf = (element: Locator) =>
  element.evaluate((each) => {
    const style = getComputedStyle(each);
    const line = style.textDecorationLine;
    return [style.backgroundColor, style.borderLeftColor, style.outlineStyle, style.color, line, style.fontWeight];
  });

/** It looks other than its like, and its letters are seen. */
async function expectMarked(chosen: Locator, other: Locator): Promise<void> {
  const look = await lookOf(chosen);
  expect(look).not.toEqual(await lookOf(other));
  expect(look[3], 'letters as the background').not.toBe(look[0]);
}

/** Colours across the middle of an element, as they are seen, and that of its upper left corner. */
async function acrossMiddle(page: Page, element: Locator): Promise<{ colours: Set<string>; ends: boolean[] }> {
  await element.scrollIntoViewIfNeeded();
  const picture = `data:image/png;base64,${(await element.screenshot()).toString('base64')}`;
  const row = await page.evaluate(async (url) => {
    const image = new Image();
    image.src = url;
    await image.decode();
    const { width, height } = image;
    const context = Object.assign(document.createElement('canvas'), { width, height }).getContext('2d')!;
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, Math.floor(height / 2), width, 1);
    return Array.from({ length: width }, (_, x) => data.slice(4 * x, 4 * x + 3).join(' '));
  }, picture);
  const canvas = await page.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g)!.join(' '));
  return { colours: new Set(row), ends: [row[3]!, row.at(-4)!].map((colour) => colour !== canvas) };
}

/** The contrast of two colours as WCAG defines it, from 1 to 21. */
function contrast(a: string, b: string): number {
  const [darker, lighter] = [a, b]
    .map((colour) => {
      const [r, g, blue] = colour.match(/\d+/g)!.map((part) => {
        const share = Number(part) / 255;
        return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
      });
      return 0.2126 * r! + 0.7152 * g! + 0.0722 * blue!;
    })
    .sort((one, other) => one - other);
  return (lighter! + 0.05) / (darker! + 0.05);
}

for (const colorScheme of ['light', 'dark'] as const) {
  test(`who asks for more contrast sees the borders of buttons, and small letters: ${colorScheme}`, async ({
    page,
  }) => {
    await page.emulateMedia({ forcedColors: 'none', contrast: 'more', colorScheme });
    await page.goto('/');
    const colourOf = (selector: string, property: 'color' | 'borderTopColor' | 'backgroundColor') =>
      page.locator(selector).evaluate((element, name) => getComputedStyle(element)[name], property);
    const behind = await colourOf('body', 'backgroundColor');
    expect(contrast(await colourOf('#step', 'borderTopColor'), behind)).toBeGreaterThan(5);
    expect(contrast(await colourOf('.lede', 'color'), behind)).toBeGreaterThan(7);
  });
}

for (const colorScheme of ['light', 'dark'] as const) {
  test.describe(colorScheme, () => {
    test.use({ colorScheme });

    test('the first page: sliders have a track, the share of a frame is a bar', async ({ page }) => {
      await page.goto('/?boxes=1000');
      expect((await acrossMiddle(page, page.locator('#count'))).ends).toEqual([true, true]);
      await page.locator('#meter').evaluate((meter) => meter.style.setProperty('--share', '0.5'));
      const { colours, ends } = await acrossMiddle(page, page.locator('.meter'));
      expect(ends).toEqual([true, true]);
      expect(colours.size).toBeGreaterThan(1);
      await page.locator('#play').focus();
      await page.keyboard.press('Tab');
      const focused = page.locator(':focus');
      await expect(focused).toHaveCSS('outline-style', 'solid');
      await expect(focused).not.toHaveCSS('outline-color', 'rgba(0, 0, 0, 0)');
    });

    test('the navigation: the section is marked', async ({ page }) => {
      await page.goto('/guides/queries/');
      const links = page.locator('.site-nav a');
      await expectMarked(links.filter({ hasText: 'Guides' }), links.filter({ hasText: 'API' }));
    });

    test('the article: what is chosen, the line that runs, full cells, bars', async ({ page }) => {
      await page.goto('/article/');
      await page.locator('#fig-9').scrollIntoViewIfNeeded();
      const choice = page.locator('#fig-9 .choice').first();
      await expect(choice).toBeVisible();
      const label = (inputs: string) => choice.locator(`${inputs} + span`).first();
      await expectMarked(label(':checked'), label(':not(:checked)'));

      await page.locator('#fig-2').scrollIntoViewIfNeeded();
      const lit = page.locator('#fig-2 .code-line[data-lit]').first();
      await expect(lit).toBeVisible();
      const other = page.locator('#fig-2 .code-line:not([data-lit])').first();
      expect(await lookOf(lit)).not.toEqual(await lookOf(other));
      const border = (line: Locator) => line.evaluate((each) => getComputedStyle(each).borderLeftColor);
      expect(await border(other)).toBe(await page.evaluate(() => getComputedStyle(document.body).backgroundColor));

      await page.locator('#fig-4').scrollIntoViewIfNeeded();
      const slots = page.locator('#fig-4 .slot');
      await expect(slots.first()).toBeVisible();
      await expectMarked(page.locator('#fig-4 .slot.full').first(), page.locator('#fig-4 .slot:not(.full)').first());

      await page.locator('#fig-6').scrollIntoViewIfNeeded();
      const bar = page.locator('#fig-6 .bar > :nth-child(2)').first();
      await expect(bar).toBeVisible();
      expect((await acrossMiddle(page, bar)).ends[0]).toBe(true);
    });

    test('the lab: a race is seen to be on, and has bars', async ({ page }) => {
      await page.goto('/lab/?boxes=1000');
      const race = page.getByRole('button', { name: 'Race' });
      await race.click();
      await expect(race).toHaveAttribute('aria-pressed', 'true');
      await expectMarked(race, page.getByRole('button', { name: 'Step' }));
      const bar = page.locator('#bars li:last-child .bar');
      await expect(bar).toBeVisible({ timeout: 40_000 });
      await expect(async () => expect((await acrossMiddle(page, bar)).ends).toEqual([true, true])).toPass({
        timeout: 20_000,
      });
    });

    test('the benchmark: its legend has colours', async ({ page }) => {
      await page.goto('/bench/');
      await expect(page.locator('#legend')).toBeVisible();
      const [ours, others] = [page.locator('#legend .ours'), page.locator('#legend .swatch:not(.ours)')];
      expect((await acrossMiddle(page, ours)).ends).toEqual([true, true]);
      expect(await lookOf(ours)).not.toEqual(await lookOf(others));
    });

    test('the queries: the one that is chosen is marked', async ({ page }) => {
      await page.goto('/queries/');
      const label = (has: string) => page.locator(`.asks label${has}`).first();
      await expectMarked(label(':has(:checked)'), label(':not(:has(:checked))'));
    });

    test('the reference: what was searched for is legible, the result and the page are marked', async ({ page }) => {
      await page.goto('/api/classes/broadphase.BroadPhase.html');
      const links = page.locator('.site-nav a');
      await expectMarked(links.filter({ hasText: 'API' }), links.filter({ hasText: 'Guides' }));
      const names = page.locator('.tsd-navigation a');
      await expectMarked(
        names.locator('xpath=self::*[contains(@class, "current")]').first(),
        names.filter({ hasText: /^init$/ }),
      );
      await page.locator('#tsd-search-trigger').click();
      await page.locator('#tsd-search-input').fill('queryb');
      const results = page.locator('#tsd-search-results > li');
      await expect(results.nth(1)).toBeVisible();
      const mark = results.first().locator('mark');
      const [background, , , colour] = await lookOf(mark);
      expect(colour).not.toBe(background);
      await page.keyboard.press('ArrowDown');
      const chosen = page.locator('#tsd-search-results > [aria-selected="true"]');
      await expectMarked(chosen, page.locator('#tsd-search-results > :not([aria-selected="true"])').first());
      await expect(page.locator('#tsd-search')).not.toHaveCSS('border-top-width', '0px');
    });

    test('the showcases: a node with the focus, and bars', async ({ page }) => {
      await page.goto('/showcases/#nodes');
      const nodes = page.locator('#nodes .react-flow__node');
      await expect(nodes.first()).toBeVisible({ timeout: 40_000 });
      const before = await lookOf(nodes.nth(1).locator('.card'));
      await page.locator('#nodes .stage').evaluate((stage) => {
        stage.tabIndex = -1;
        stage.focus();
      });
      await page.keyboard.press('Tab');
      await page.keyboard.press('Tab');
      await expect(nodes.nth(1)).toBeFocused();
      expect(await lookOf(nodes.nth(1).locator('.card'))).not.toEqual(before);
      const share = page.locator('#nodes .share').last();
      await expect(async () => expect((await acrossMiddle(page, share)).ends[0]).toBe(true)).toPass({
        timeout: 40_000,
      });
    });
  });
}
