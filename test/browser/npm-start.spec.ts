// What `npm start` serves, which is not what a build makes: every page is alive, writes no error and asks nobody else;
// and what cannot work says so. The same pages as built are tested beside this.
import { mkdirSync } from 'node:fs';
import { expect, type Page, test } from '@playwright/test';
import { builtPort, startPort } from './ports.ts';

const home = `http://localhost:${startPort}`;
test.use({ baseURL: home });

let faults: string[] = [];
test.beforeEach(({ page }) => {
  faults = [];
  page.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
  page.on('pageerror', (error) => faults.push(String(error)));
  page.on('response', (response) => response.status() >= 400 && faults.push(`${response.status()} ${response.url()}`));
  page.on('request', (request) => {
    const url = request.url();
    if (!/^(data|blob):/.test(url) && !url.startsWith(home)) faults.push(`a request to ${url}`);
  });
});

const patient = { timeout: 30_000 };
const number = async (page: Page, name: string) =>
  Number((await page.locator(`[data-number=${name}]`).first().textContent())!.replace(/[^\d.].*|,/g, '') || Number.NaN);
const counts = (page: Page, name: string) => expect.poll(() => number(page, name), patient).toBeGreaterThan(0);
/** What an element shows changes by itself. */
async function moves(page: Page, selector: string): Promise<void> {
  const element = page.locator(selector).first();
  await element.scrollIntoViewIfNeeded();
  const before = await element.screenshot();
  await expect.poll(async () => (await element.screenshot()).equals(before), patient).toBe(false);
}

/** By address: how one sees that a page is alive. */
const alive: Record<string, (page: Page) => Promise<void>> = {
  '/': async (page) => {
    await counts(page, 'pairs');
    await moves(page, '#view');
  },
  '/article/': async (page) => {
    await page.locator('#fig-step').scrollIntoViewIfNeeded();
    await expect(page.locator('#fig-step .live button').first()).toBeVisible(patient);
  },
  '/lab/': (page) => counts(page, 'frame'),
  '/lab/?race=auto,quadtree&boxes=500': (page) =>
    expect(page.locator('#race-note')).toContainText('all find the same', patient),
  '/queries/': async (page) => {
    await counts(page, 'time');
    await moves(page, '#view');
  },
  '/narrow-phase/': async (page) => {
    await counts(page, 'pairs');
    await moves(page, '#canvas');
  },
  '/bench/': async (page) => {
    await expect(page.getByRole('checkbox', { name: 'flatbush' })).toBeVisible(patient);
    await expect(page.locator('figure svg').first()).toBeVisible(patient);
  },
  '/guides/': (page) => expect(page.getByRole('link', { name: 'Getting started' }).first()).toBeVisible(),
  '/guides/getting-started/': (page) => expect(page.locator('pre code .hljs-keyword').first()).toBeVisible(),
  '/examples/': (page) => expect(page.getByRole('link', { name: 'record-matter' }).first()).toBeVisible(),
  '/examples/ecs/': (page) => expect(page.locator('pre code').first()).toBeVisible(),
  '/api/': (page) => expect(page.getByRole('heading', { level: 1 })).toBeVisible(patient),
};

for (const [address, isAlive] of Object.entries(alive)) {
  test(`npm start: ${address} is alive`, async ({ page }) => {
    test.slow();
    await page.goto(address);
    await isAlive(page);
    await expect(page.locator('h1').first()).toBeVisible();
    expect(faults).toEqual([]);
  });
}

const devices = { phone: { width: 390, height: 844 }, desktop: { width: 1280, height: 860 } };
for (const [device, viewport] of Object.entries(devices)) {
  for (const colorScheme of ['light', 'dark'] as const) {
    test(`npm start: every page fits a ${device}, ${colorScheme}`, async ({ page }) => {
      test.slow();
      mkdirSync('test-results/screens', { recursive: true });
      await page.setViewportSize(viewport);
      await page.emulateMedia({ colorScheme });
      for (const [address, isAlive] of Object.entries(alive)) {
        await page.goto(address);
        await isAlive(page);
        const name = address.replace(/\?.*/, 'race').replaceAll('/', '-').replace(/^-|-$/g, '') || 'home';
        await page.evaluate('scrollTo(0, 0)');
        await page.screenshot({ path: `test-results/screens/start-${name}-${device}-${colorScheme}.png` });
        const wide = await page.evaluate('document.documentElement.scrollWidth');
        expect(wide, address).toBeLessThanOrEqual(viewport.width);
      }
      expect(faults).toEqual([]);
    });
  }
}

test('npm start: the first race of the benchmark is not lost to a reload of the page', async ({ page }) => {
  test.slow();
  let loads = 0;
  page.on('load', () => loads++);
  await page.goto('/bench/');
  await page.locator('#run-scene').selectOption('sparse2d');
  await page.getByRole('button', { name: 'Run' }).click();
  await expect(page.locator('#run-doing')).toContainText('Done', { timeout: 60_000 });
  expect(loads).toBe(1);
  expect(faults).toEqual([]);
});

for (const [from, at] of [
  ['npm start', home],
  ['the built site', `http://localhost:${builtPort}`],
] as const) {
  test(`${from}: an address that is no page is answered with 404`, async ({ request }) => {
    for (const address of ['/nothing', '/nothing/', '/lab/nothing.js', '/guides/nothing/', '/api/nothing.html']) {
      const answer = await request.get(at + address, { headers: { Accept: 'text/html' } });
      expect(answer.status(), address).toBe(404);
    }
  });

  test(`${from}: the page of an address that is no page leads back to the site`, async ({ page }) => {
    for (const address of ['/nothing', '/guides/nothing/deep/', '/api/nothing.html']) {
      expect((await page.goto(at + address))!.status(), address).toBe(404);
      await expect(page.getByRole('heading', { level: 1 })).toHaveText('No page has this address');
      await expect(page.locator('.site-nav'), address).toHaveCSS('display', 'flex');
      await page.locator('main').getByRole('link', { name: 'The guides' }).click();
      await expect(page).toHaveURL(`${at}/guides/`);
    }
  });

  test(`${from}: a folder without its slash leads to the page`, async ({ request }) => {
    for (const address of ['/lab', '/guides/getting-started', '/api', '/examples/ecs?x=1']) {
      const answer = await request.get(at + address, { headers: { Accept: 'text/html' } });
      expect(answer.status(), address).toBe(200);
      expect(answer.url().slice(at.length), address).toBe(address.replace(/$|(?=\?)/, '/'));
    }
  });
}

for (const [what, script] of [
  ['never answers', ''],
  ['cannot be loaded', undefined],
] as const) {
  test(`npm start: a lab whose worker ${what} says so within seconds`, async ({ page }) => {
    await page.route('**/lab/worker/worker.ts**', (route) =>
      script === undefined
        ? route.fulfill({ status: 500 })
        : route.fulfill({
            body: script,
            contentType: 'text/javascript',
            headers: { 'Cross-Origin-Embedder-Policy': 'require-corp' },
          }),
    );
    await page.goto('/lab/');
    const colour = () =>
      page
        .locator('#flat canvas')
        .first()
        .evaluate((canvas: HTMLCanvasElement) => {
          return [...canvas.getContext('2d')!.getImageData(9, 9, 1, 1).data];
        });
    await expect.poll(colour, 'that of the page').toEqual([251, 251, 250, 255]);
    const said = what === 'never answers' ? 'its worker did not start within 6 s' : 'its worker could not be loaded';
    await expect(page.locator('#note')).toContainText(`This stopped: ${said}`, { timeout: 9000 });
  });
}
