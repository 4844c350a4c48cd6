// On phones: what a finger presses is large enough, and nothing is wider than the screen, however large the letters are.
import { mkdirSync, writeFileSync } from 'node:fs';
import { expect, test } from '@playwright/test';

test.use({ viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true });

const pages = ['', 'article/', 'lab/', 'queries/', 'showcases/', 'bench/', 'guides/getting-started/', 'api/'];

for (const path of pages) {
  test(`/${path}: links of the navigation, buttons and menus are large enough`, async ({ page }) => {
    await page.emulateMedia({ reducedMotion: 'reduce' });
    await page.goto(`/${path}`);
    await expect(page.getByRole('heading', { level: 1 })).toBeVisible();
    const small = await page
      .locator('.site-nav a, button:not([class^="tsd"], [id^="tsd"]), select')
      .evaluateAll((controls) =>
        controls.flatMap((control) => {
          const { width, height } = control.getBoundingClientRect();
          if (width === 0) return [];
          return height >= 44 && width >= 32 ? [] : [`${control.textContent!.trim()}: ${width} by ${height}`];
        }),
      );
    expect(small).toEqual([]);
  });
}

test('the buttons below the first picture are in one row', async ({ page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.goto('/?boxes=100');
  const tops = await page
    .locator('.tools button')
    .evaluateAll((all) => all.map((each) => Math.round(each.getBoundingClientRect().top)));
  expect(new Set(tops).size).toBe(1);
});

test('no page is wider than the screen where letters are twice as large', async ({ playwright, baseURL }, info) => {
  test.setTimeout(120_000);
  const profile = info.outputPath('profile');
  mkdirSync(`${profile}/Default`, { recursive: true });
  writeFileSync(
    `${profile}/Default/Preferences`,
    JSON.stringify({ webkit: { webprefs: { default_font_size: 32, default_fixed_font_size: 26 } } }),
  );
  const context = await playwright.chromium.launchPersistentContext(profile, {
    ...info.project.use.launchOptions,
    baseURL: baseURL!,
    viewport: { width: 360, height: 740 },
    reducedMotion: 'reduce',
  });
  const page = await context.newPage();
  const wide: string[] = [];
  for (const path of [...pages, 'guides/troubleshooting/', 'guides/command/', 'examples/']) {
    await page.goto(`/${path}`);
    await expect(page.getByRole('heading', { level: 1 })).toBeVisible();
    expect(await page.evaluate(() => getComputedStyle(document.documentElement).fontSize)).toBe('32px');
    await page.waitForTimeout(500);
    const over = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    if (over > 0) wide.push(`/${path}: ${over}`);
  }
  await context.close();
  expect(wide).toEqual([]);
});
