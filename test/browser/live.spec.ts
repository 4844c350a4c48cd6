// The examples run on the site, above their code: built, and as `npm start` serves them.
import { readdirSync } from 'node:fs';
import { expect, test } from '@playwright/test';
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

test('so they do as npm start serves the site', async ({ page }) => {
  const faults: string[] = [];
  page.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
  await page.goto(`http://localhost:${startPort}/examples/smallest/`, { timeout: 90_000 });
  const output = page.frameLocator('.live iframe').locator('output');
  await expect(output).toHaveText('7, 9, 9, 11', { timeout: 90_000 });
  expect(faults).toEqual([]);
});
