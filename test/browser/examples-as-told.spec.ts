// The README of the examples leads to each, and each page has its look, at a phone's width too. That they start as they
// are taken out of the repository is tried by scripts/strangers.mjs.
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { expect, test } from '@playwright/test';
import { examples, openExample } from './example.ts';
import { examplesPort } from './ports.ts';

const readme = readFileSync(`${examples}/README.md`, 'utf8');
const folders = readdirSync(examples, { withFileTypes: true }).filter((entry) => entry.isDirectory());
const has = (file: string) =>
  folders.map(({ name }) => name).filter((name) => existsSync(`${examples}/${name}/${file}`));
// csp has a server and a test of its own; what the smallest wants from a CDN, strangers.mjs gives it.
const pages = has('index.html').filter((name) => !['csp', 'smallest'].includes(name));
const programs = has('index.mjs').filter((name) => !pages.includes(name));

test('the README tells how to start each', () => {
  for (const name of [...pages, ...programs]) expect(readme).toContain(`](${name}`);
  for (const [, file] of readme.matchAll(/node (examples\/[\w./-]+)/g)) expect(existsSync(file), file).toBe(true);
  for (const told of ['npm i && npm start', 'npx vite examples`']) expect(readme).toContain(told);
});

test('the first page of the examples leads to each that has one', async ({ page }) => {
  const faults = await openExample(page, '.');
  const links = page.getByRole('listitem').getByRole('link');
  const hrefs = await links.evaluateAll((all) => (all as HTMLAnchorElement[]).map(({ pathname }) => pathname));
  expect(hrefs.sort()).toEqual(pages.map((name) => `/${name}/`).sort());
  await page.screenshot({ path: 'test-results/screens/examples.png' });
  expect(faults).toEqual([]);
  const mistyped = await page.request.get(`http://localhost:${examplesPort}/nothing/`, {
    headers: { Accept: 'text/html' },
  });
  expect(mistyped.status()).toBe(404);
});

for (const name of pages) {
  for (const [device, width, height] of [
    ['phone', 390, 844],
    ['desktop', 1280, 800],
  ] as const) {
    test(`${name} has its look on a ${device}`, async ({ page }) => {
      test.slow();
      await page.setViewportSize({ width, height });
      await page.emulateMedia({ reducedMotion: 'reduce', colorScheme: device === 'phone' ? 'dark' : 'light' });
      // WebGL on a processor is too slow for these pictures at times: what is drawn is tested in examples.spec.ts.
      if (name.includes('phaser')) {
        await page.addInitScript(`{
          const { getContext } = HTMLCanvasElement.prototype;
          HTMLCanvasElement.prototype.getContext = function (kind, ...options) {
            return kind.includes('webgl') ? null : getContext.call(this, kind, ...options);
          };
        }`);
      }
      // On a processor 20,000 boxes take most of a minute to draw, which once is enough.
      const fewer = name === 'instancing-three' && device === 'desktop' ? '?boxes=1500' : '';
      const faults = await openExample(page, name, fewer);
      // The style sheet came, and is one.
      const margin = await page.evaluate('getComputedStyle(document.body).margin');
      expect(margin).toBe('0px');
      await expect(page.locator('canvas, [role=listbox], .react-flow, .note').first()).toBeVisible({ timeout: 30_000 });
      expect(await page.evaluate('document.documentElement.scrollWidth')).toBeLessThanOrEqual(width);
      await page.screenshot({ path: `test-results/screens/example-${name}-${device}.png`, timeout: 60_000 });
      expect(faults).toEqual([]);
    });
  }
}
