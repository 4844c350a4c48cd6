// The examples run on the site, above their code: built, and as `npm start` serves them.
import { readdirSync } from 'node:fs';
import { expect, type Page, test } from '@playwright/test';
import { waysTo } from '../../site/plugins/live.ts';
import { examples, needExamples } from './example.ts';
import { startPort } from './ports.ts';

test.beforeEach(() => {
  needExamples();
  test.slow();
});

test('how to take an example: its folder, and an editor where the repository has an address on GitHub', () => {
  const at = (url: string) => waysTo('examples/react', { version: '1.2.3', repository: { url } });
  expect(at('git+https://broadphase.invalid/broadphase.git')).toBe('Take the folder <code>examples/react</code>.');
  const home = 'https://github.com/someone/broadphase';
  expect(at(`git+${home}.git`)).toContain(`href="${home}/tree/v1.2.3/examples/react"`);
  expect(at(`git+${home}.git`)).toContain('stackblitz.com/github/someone/broadphase/tree/v1.2.3/examples/react"');
  expect(at('git+https://codeberg.org/someone/broadphase.git')).not.toContain('editor');
});

test('each example with a page runs beside its code, and leads to it alone', async ({ page }) => {
  const names = readdirSync(examples).filter((name) => !['csp', 'node_modules', 'page'].includes(name));
  const live: string[] = [];
  for (const name of names) {
    const text = await (await page.request.get(`examples/${name}/`)).text();
    if (!text.includes('<iframe')) continue;
    live.push(name);
    expect(text).toContain(`href="../../live/${name}/"`);
    expect((await page.request.get(`live/${name}/`)).ok()).toBe(true);
  }
  expect(live.length).toBeGreaterThanOrEqual(9);
});

for (const [device, width, height, colorScheme] of [
  ['phone', 390, 844, 'dark'],
  ['wide', 1280, 900, 'light'],
] as const) {
  test(`on a ${device} screen, ${colorScheme}`, async ({ page, baseURL }) => {
    const faults: string[] = [];
    page.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
    page.on('pageerror', (error) => faults.push(String(error)));
    page.on('request', (request) => {
      if (!/^(data|blob):/.test(request.url()) && !request.url().startsWith(baseURL!)) faults.push(request.url());
    });
    await page.setViewportSize({ width, height });
    await page.emulateMedia({ colorScheme, reducedMotion: 'reduce' });
    for (const [name, where, says] of [
      ['smallest', 'output', /^7, 9, 9, 11$/],
      ['react', '[role=status]', /of [1-9]\d+ tiles/],
      ['culling-pixi', '#numbers', /of 100,000 drawn/],
    ] as const) {
      await page.goto(`examples/${name}/`);
      await expect(page.frameLocator('.live iframe').locator(where)).toHaveText(says, { timeout: 60_000 });
      expect(await page.evaluate('document.documentElement.scrollWidth')).toBeLessThanOrEqual(width);
      await page.screenshot({ path: `test-results/screens/live-${name}-${device}-${colorScheme}.png` });
    }
    expect(faults).toEqual([]);
  });
}

/** Those whose stage takes the pointer, and what is on it once they run. */
const stages = {
  react: '.tile',
  vue: '.note',
  'culling-pixi': 'canvas',
  'draw-pixi': 'canvas',
  'draw-three': 'canvas',
  'instancing-three': 'canvas',
  'culling-three': 'canvas',
  'force-d3': 'canvas',
  'nodes-xyflow': '.react-flow__node',
  'record-phaser': 'canvas',
};

/** Opens the page of an example with its stage in sight; gives the box of the stage on the page. */
async function openLive(page: Page, name: keyof typeof stages) {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.goto(`examples/${name}/`);
  const inside = page.frameLocator('.live iframe');
  await expect(inside.locator(`.stage ${stages[name]}`).first()).toBeVisible({ timeout: 60_000 });
  await page.locator('.live').evaluate((each) => each.scrollIntoView({ block: 'center', behavior: 'instant' }));
  return { inside, stage: (await inside.locator('.stage').boundingBox())! };
}

test.describe('by touch', () => {
  test.use({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });

  /** Moves one finger, and waits until the page is still. */
  async function swipe(page: Page, [x, y]: readonly number[], [dx, dy]: readonly number[]) {
    const touch = await page.context().newCDPSession(page);
    for (let step = 0; step <= 8; step++) {
      const touchPoints = [{ x: x! + (dx! * step) / 8, y: y! + (dy! * step) / 8 }];
      await touch.send('Input.dispatchTouchEvent', { type: step === 0 ? 'touchStart' : 'touchMove', touchPoints });
    }
    await touch.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
    for (let [before, now] = [-1, 0]; before !== now; ) {
      await page.waitForTimeout(400);
      [before, now] = [now, await page.evaluate(() => scrollY)];
    }
  }
  const scrolled = (page: Page) => page.evaluate(() => scrollY);

  for (const name of Object.keys(stages) as (keyof typeof stages)[]) {
    test(`${name}: it has room, and a finger scrolls the page past it`, async ({ page }) => {
      const { inside, stage } = await openLive(page, name);
      expect(stage.height).toBeGreaterThan(300);
      const before = await scrolled(page);
      // Downwards, the frame has nothing to scroll itself.
      await swipe(page, [stage.x + 0.97 * stage.width, stage.y + 60], [0, 200]);
      expect(await scrolled(page)).toBeLessThan(Math.max(1, before - 30));
      await expect(inside.locator('[aria-selected=true]')).toHaveCount(0);
    });
  }

  test('a finger that moves sideways first draws a band, and one on a note drags it', async ({ page }) => {
    const { inside, stage } = await openLive(page, 'react');
    const before = await scrolled(page);
    await swipe(page, [stage.x + 20, stage.y + 40], [160, 60]);
    await expect.poll(() => inside.locator('[aria-selected=true]').count()).toBeGreaterThan(4);
    expect(await scrolled(page)).toBe(before);
    const selected = await inside.locator('[aria-selected=true]').count();
    const tile = (await inside.locator('.tile').first().boundingBox())!;
    await swipe(page, [tile.x + 5, tile.y + 5], [0, 200]);
    expect(await scrolled(page)).toBeLessThan(Math.max(1, before - 30));
    await expect(inside.locator('[aria-selected=true]')).toHaveCount(selected);

    await openLive(page, 'vue');
    const note = inside.locator('.note').first();
    const [from, at] = [(await note.boundingBox())!, await scrolled(page)];
    await swipe(page, [from.x + 10, from.y + 10], [0, 120]);
    expect((await note.boundingBox())!.y).toBeCloseTo(from.y + 120, 0);
    expect(await scrolled(page)).toBe(at);
  });
});

test('the wheel scrolls the page past an example until that has been clicked', async ({ page }) => {
  for (const name of ['culling-pixi', 'draw-three', 'record-phaser', 'nodes-xyflow'] as const) {
    const { inside, stage } = await openLive(page, name);
    expect(await page.evaluate(() => document.activeElement === document.body)).toBe(true);
    await page.evaluate(() => scrollTo(0, 0));
    const { y } = (await inside.locator('.stage').boundingBox())!;
    await page.mouse.move(stage.x + 20, y + 60);
    await page.mouse.wheel(0, 200);
    await expect.poll(() => page.evaluate(() => scrollY), name).toBeGreaterThan(50);
  }
  const { inside, stage } = await openLive(page, 'culling-pixi');
  await page.mouse.click(stage.x + 100, stage.y + 100);
  const numbers = await inside.locator('#numbers b').first().textContent();
  await page.mouse.wheel(0, 200);
  await expect(inside.locator('#numbers b').first()).not.toHaveText(numbers!);
});

test('an example that moves rests while the page shows something else, and for who prefers less motion', async ({
  page,
}) => {
  await page.addInitScript(() => {
    const next = requestAnimationFrame;
    let asked = 0;
    Object.defineProperty(globalThis, 'asked', { get: () => asked });
    globalThis.requestAnimationFrame = (draw) => {
      asked++;
      return next(draw);
    };
  });
  const asked = () => page.frames()[1]!.evaluate('asked') as Promise<number>;
  const expectRest = () =>
    expect(async () => {
      const before = await asked();
      await page.waitForTimeout(300);
      expect(await asked()).toBe(before);
    }).toPass({ timeout: 10_000 });
  const expectMotion = async () => {
    const before = await asked();
    await expect.poll(asked, { timeout: 30_000 }).toBeGreaterThan(before + 3);
  };
  for (const name of ['draw-three', 'record-phaser'] as const) {
    await openLive(page, name);
    await page.evaluate(() => scrollTo(0, 0));
    await expectRest();
    await page.emulateMedia({ reducedMotion: 'no-preference' });
    await expectMotion();
    await page.evaluate(() => scrollTo(0, document.body.scrollHeight));
    await expectRest();
    await page.evaluate(() => scrollTo(0, 0));
    await expectMotion();
  }
});

test('so they do as npm start serves the site', async ({ page }) => {
  const faults: string[] = [];
  page.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
  await page.goto(`http://localhost:${startPort}/examples/smallest/`, { timeout: 90_000 });
  const output = page.frameLocator('.live iframe').locator('output');
  await expect(output).toHaveText('7, 9, 9, 11', { timeout: 90_000 });
  expect(faults).toEqual([]);
});
