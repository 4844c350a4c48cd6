// The first page as a visitor meets it: it runs, its numbers are live, every control does what it says,
// and nothing is written to the console as an error or fetched from elsewhere.
import { expect, type Page, test } from '@playwright/test';

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

const shown = (page: Page, name: string) => page.locator(`[data-number=${name}]`);
const number = async (page: Page, name: string) =>
  Number((await shown(page, name).textContent())!.replaceAll(',', '').replace('–', 'NaN'));
const solved = (page: Page) => expect.poll(() => number(page, 'pairs')).toBeGreaterThan(0);

/** How many colours the view shows: more than a few where boxes are drawn. */
async function coloursInView(page: Page): Promise<number> {
  const picture = (await page.locator('#view').screenshot()).toString('base64');
  return page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes]));
    const context = new OffscreenCanvas(image.width, image.height).getContext('2d')!;
    context.drawImage(image, 0, 0);
    return new Set(new Uint32Array(context.getImageData(0, 0, image.width, image.height).data.buffer)).size;
  }, picture);
}

/** Opens a page that stands still: it is paused after its first frame. */
async function openStill(page: Page, address: string): Promise<void> {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.goto(address);
  await solved(page);
}

test('opens with 100,000 moving boxes and live numbers, or as many as move smoothly, and says how many', async ({
  page,
}) => {
  await page.goto('/');
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('Which boxes overlap?');
  await solved(page);
  expect(await number(page, 'tests')).toBeGreaterThan(0);
  expect(await number(page, 'median')).toBeGreaterThan(0);
  const before = await number(page, 'pairs');
  await expect.poll(() => number(page, 'pairs'), { timeout: 20_000 }).not.toBe(before);
  await expect.poll(() => number(page, 'rate'), { timeout: 20_000 }).toBeGreaterThan(0);
  await page.waitForTimeout(4000);
  await expect(page.getByRole('status')).not.toContainText('because', { timeout: 20_000 }); // still trying
  await page.getByRole('button', { name: 'Pause' }).click();
  const boxes = (await shown(page, 'boxes').textContent())!;
  expect(['100,000', '50,000', '20,000', '10,000', '5,000']).toContain(boxes);
  await expect(page.locator('.lede')).toContainText(`${boxes} boxes move`);
  await expect(page.getByRole('img')).toHaveAttribute('aria-label', new RegExp(`^${boxes} boxes, paused`));
  const told = boxes === '100,000' ? 'From 2 to 2,000 wide' : boxes === '5,000' ? '5,000 boxes' : `${boxes} boxes, as`;
  await expect(page.getByRole('status')).toContainText(told);
});

test('a slow device is not said to move its boxes smoothly', async ({ page }) => {
  await page.addInitScript(() => {
    const { requestAnimationFrame } = window;
    window.requestAnimationFrame = (act) => window.setTimeout(() => requestAnimationFrame(act), 150);
  });
  await page.goto('/');
  const status = page.getByRole('status');
  await expect(status).toHaveText('This device does not move even 5,000 boxes smoothly; the slider goes to 200,000.', {
    timeout: 20_000,
  });
  await page.getByRole('combobox', { name: 'Scene' }).selectOption('sparse2d');
  await expect(status).toHaveText('Hardly anything touches.');
});

test('a recording in the address keeps its description: the page has not chosen its number of boxes', async ({
  page,
}) => {
  await openStill(page, '/?scene=rain&technique=auto');
  await expect(shown(page, 'boxes')).toHaveText('15,505');
  await expect(page.getByRole('status')).toContainText('Real input: every shape of a Box2D world');
});

test('shows 100,000 boxes, still, to those who ask for less motion; what they choose stays', async ({ page }) => {
  await openStill(page, '/');
  await expect(shown(page, 'boxes')).toHaveText('100,000');
  await expect(page.locator('.lede')).toContainText('100,000 boxes move');
  expect(await number(page, 'pairs')).toBeGreaterThan(40_000);
  expect(await number(page, 'tests')).toBeGreaterThan(0); // of an update in which boxes have moved
  await expect(page).not.toHaveURL(/boxes=/);
  await page.waitForTimeout(2500);
  await expect(shown(page, 'boxes')).toHaveText('100,000');
  await page.getByRole('slider', { name: 'Boxes' }).press('End');
  await expect(shown(page, 'boxes')).toHaveText('200,000');
  await page.getByRole('button', { name: 'Play' }).click();
  await page.waitForTimeout(2500);
  await expect(shown(page, 'boxes')).toHaveText('200,000');
});

test('is cross-origin isolated, so that its clock is fine', async ({ page }) => {
  await openStill(page, '/?boxes=100');
  expect(await page.evaluate(() => crossOriginIsolated)).toBe(true);
});

test('the slider goes from 100 to 200,000 in even ratios and keeps its place in the address', async ({ page }) => {
  await openStill(page, '/?boxes=1000');
  const slider = page.getByRole('slider', { name: 'Boxes' });
  await slider.press('Home');
  await expect(shown(page, 'boxes')).toHaveText('100');
  await expect(slider).toHaveAttribute('aria-valuetext', '100 boxes');
  await slider.fill('500');
  await expect(shown(page, 'boxes')).toHaveText('4,500');
  await expect(page).toHaveURL(/boxes=4500/);
  await slider.press('End');
  await expect(shown(page, 'boxes')).toHaveText('200,000');
  expect(await number(page, 'pairs')).toBeGreaterThan(90_000);
  expect(await coloursInView(page)).toBeGreaterThan(10);
});

test('brute force stops at a number that a page can bear, and says so', async ({ page }) => {
  await openStill(page, '/?boxes=50000');
  await page.getByRole('combobox', { name: 'Technique' }).selectOption('brute-force');
  await expect(shown(page, 'boxes')).toHaveText('20,000');
  await expect(page.getByRole('status')).toContainText('199,990,000 tests per frame');
});

test('every technique of the menu finds the same pairs', async ({ page }) => {
  await openStill(page, '/?boxes=1500&scene=mixed2d');
  const pairs = await number(page, 'pairs');
  const menu = page.getByRole('combobox', { name: 'Technique' });
  for (const name of await menu.locator('option').allTextContents()) {
    await menu.selectOption(name);
    await expect(page).toHaveURL(new RegExp(`technique=${name}`));
    expect(await number(page, 'pairs'), name).toBe(pairs);
    expect(await number(page, 'tests'), name).toBeGreaterThan(0);
  }
});

test('every scene of the menu has pairs, the recorded rain with all its boxes', async ({ page }) => {
  test.slow();
  await openStill(page, '/?boxes=2000');
  const menu = page.getByRole('combobox', { name: 'Scene' });
  for (const label of await menu.locator('option').allTextContents()) {
    await menu.selectOption({ label });
    const name = await menu.inputValue();
    await expect(page).toHaveURL(new RegExp(`scene=${name}`), { timeout: 20_000 });
    await expect(shown(page, 'boxes')).toHaveText(name === 'rain' ? '15,505' : '2,000');
    expect(await number(page, 'pairs'), label).toBeGreaterThan(name === 'rain' ? 50_000 : 0);
    expect(await coloursInView(page), label).toBeGreaterThan(2);
  }
  await expect(page.getByRole('slider', { name: 'Boxes' })).toBeDisabled();
});

test('pauses, steps, and plays again, by button and by the space key', async ({ page }) => {
  await page.goto('/?boxes=1500');
  await solved(page);
  await page.getByRole('button', { name: 'Pause' }).click();
  const pairs = await number(page, 'pairs');
  await page.waitForTimeout(600);
  expect(await number(page, 'pairs')).toBe(pairs);
  const step = page.getByRole('button', { name: 'Step' });
  await expect
    .poll(async () => {
      await step.click();
      return number(page, 'pairs');
    })
    .not.toBe(pairs);
  await page.locator('#view').press(' ');
  await expect(page.getByRole('button', { name: 'Pause' })).toBeVisible();
  await page.locator('#view').press(' ');
  await expect(page.getByRole('button', { name: 'Play' })).toBeVisible();
});

test('starts paused for those who ask for less motion', async ({ page }) => {
  await openStill(page, '/?boxes=1000');
  await expect(page.getByRole('button', { name: 'Play' })).toBeVisible();
  await expect(page.getByRole('img')).toHaveAttribute('aria-label', /1,000 boxes, paused, with \d+ overlapping pairs/);
});

test('zooms by keys, wheel and buttons, and shows everything again', async ({ page }) => {
  await openStill(page, '/?boxes=1000');
  const view = page.locator('#view');
  /** The picture without the ring of the focus. */
  const picture = async () => {
    await view.blur();
    return view.screenshot();
  };
  const whole = await picture();
  const showsAll = () => expect.poll(async () => (await picture()).equals(whole));
  await view.press('+');
  await view.press('ArrowLeft');
  await showsAll().toBe(false);
  await view.press('0');
  await showsAll().toBe(true);
  await view.hover();
  await page.mouse.wheel(0, -400);
  await showsAll().toBe(false);
  await page.getByRole('button', { name: 'Show everything' }).click();
  await page.mouse.move(0, 0);
  await showsAll().toBe(true);
});

test('a wheel scrolls past a solid scene, and zooms one that was clicked', async ({ page }) => {
  await page.setViewportSize({ width: 390, height: 700 });
  await openStill(page, '/lab/?scene=dense3d&boxes=400');
  await page.locator('#solid').hover();
  await page.mouse.wheel(0, 100);
  await expect.poll(() => page.evaluate(() => scrollY)).toBeGreaterThan(0);
  await expect(page).not.toHaveURL(/view=/);
  await page.locator('#solid').click();
  const before = await page.evaluate(() => scrollY);
  await page.mouse.wheel(0, 100);
  await expect(page).toHaveURL(/view=/);
  expect(await page.evaluate(() => scrollY)).toBe(before);
});

test('at no width is a link of the navigation alone below the name: all are beside it, or all start at its left', async ({
  page,
}) => {
  await openStill(page, '/?boxes=100');
  for (const width of [390, 640, 720, 820, 860, 900]) {
    await page.setViewportSize({ width, height: 600 });
    const [home, ...links] = await page.locator('.site-nav a').evaluateAll((all) =>
      all.map((link) => {
        const { left, top, height } = link.getBoundingClientRect();
        return { left: left + Number.parseFloat(getComputedStyle(link).paddingLeft), middle: top + height / 2 };
      }),
    );
    const below = links.filter(({ middle }) => middle > home.middle + 10);
    expect([0, links.length], `${width} pixels wide`).toContain(below.length);
    if (below.length > 0) expect(below[0].left, `${width} pixels wide`).toBe(home.left);
  }
});

test('in a low window every control can be reached', async ({ page }) => {
  await openStill(page, '/?boxes=100');
  for (const [width, height] of [
    [1366, 625],
    [1100, 500],
  ]) {
    await page.setViewportSize({ width, height });
    await page.evaluate(() => scrollTo(0, 0));
    for (const name of ['Play', 'Show everything']) {
      await expect(page.getByRole('button', { name }), `${width} by ${height}`).toBeInViewport({ ratio: 1 });
    }
    await page.mouse.move(200, 200);
    await page.mouse.wheel(0, 500);
    await expect(page.locator('#technique'), `${width} by ${height}`).toBeInViewport({ ratio: 1 });
  }
});

/** Drags a finger over a view in eight steps; returns by how much that scrolled the page, which is then undone. */
async function dragFinger(page: Page, id: string, across: number, up: number): Promise<number> {
  const touch = await page.context().newCDPSession(page);
  const scrolled = () => page.evaluate(() => Math.round(scrollY));
  const was = await scrolled();
  const { x, y, height } = (await page.locator(`#${id}`).boundingBox())!;
  for (let step = 0; step <= 8; step++) {
    const touchPoints = [{ x: x + 150 + across * step, y: y + 0.8 * height - up * step }];
    await touch.send('Input.dispatchTouchEvent', { type: step === 0 ? 'touchStart' : 'touchMove', touchPoints });
  }
  await touch.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  await page.waitForTimeout(300);
  const by = (await scrolled()) - was;
  await page.evaluate((to) => scrollTo(0, to), was);
  return by;
}

test.describe('by touch', () => {
  test.use({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });

  for (const [address, id] of [
    ['/?boxes=1000', 'view'],
    ['/lab/?boxes=1000', 'flat'],
  ]) {
    test(`${address}: a finger moves a view that was zoomed by a button, and scrolls past one that shows everything`, async ({
      page,
    }) => {
      await openStill(page, address);
      const view = page.locator(`#${id}`);
      /** Drags a finger upwards; returns by how much that scrolled the page, and whether the picture changed. */
      const drag = async () => {
        const before = await view.locator('canvas').first().screenshot();
        const by = await dragFinger(page, id, 0, 15);
        return { by, moved: !(await view.locator('canvas').first().screenshot()).equals(before) };
      };
      await view.scrollIntoViewIfNeeded();
      expect((await drag()).by).toBeGreaterThan(50);
      await expect(async () => {
        await page.getByRole('button', { name: 'Zoom in' }).tap();
        await expect(view).toHaveCSS('touch-action', 'none', { timeout: 500 });
      }).toPass();
      expect(await drag()).toEqual({ by: 0, moved: true });
      // A tap right after a drag may still count as part of it.
      await expect(async () => {
        await page.getByRole('button', { name: 'Show everything' }).tap();
        await expect(view).not.toHaveCSS('touch-action', 'none', { timeout: 500 });
      }).toPass();
      const { by, moved } = await drag();
      expect(by).toBeGreaterThan(50);
      expect(moved).toBe(false);
    });
  }

  test('a finger that moves up scrolls past a solid scene, and one that moves aside turns it', async ({ page }) => {
    await openStill(page, '/lab/?scene=dense3d&boxes=400');
    expect(await dragFinger(page, 'solid', 0, 15)).toBeGreaterThan(60);
    const seen = await page.locator('#solid').screenshot();
    expect(await dragFinger(page, 'solid', -15, 0)).toBe(0);
    expect((await page.locator('#solid').screenshot()).equals(seen)).toBe(false);
    await expect(page).toHaveURL(/view=/);
  });
});

for (const renderer of ['webgl2', 'canvas-2d']) {
  test(`draws by ${renderer}`, async ({ page }) => {
    await openStill(page, `/?boxes=1000&renderer=${renderer}`);
    expect(await coloursInView(page)).toBeGreaterThan(10);
    await page.getByRole('button', { name: 'Step' }).click();
    await page.screenshot({ path: `test-results/screens/${renderer}.png` });
  });
}

for (const [device, width, height] of [
  ['phone', 375, 812],
  ['tablet', 820, 1180],
  ['wide', 1440, 900],
  ['very-wide', 1920, 1080],
] as const) {
  for (const colorScheme of ['light', 'dark'] as const) {
    test(`fits a ${device} screen, ${colorScheme}`, async ({ page }) => {
      await page.setViewportSize({ width, height });
      await page.emulateMedia({ colorScheme });
      await openStill(page, '/');
      expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
      expect(await coloursInView(page)).toBeGreaterThan(10);
      await page.screenshot({ path: `test-results/screens/${device}-${colorScheme}.png`, fullPage: true });
    });
  }
}
