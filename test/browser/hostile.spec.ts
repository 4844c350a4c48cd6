// Addresses and files made by strangers: the page neither runs what they say, nor hangs, nor breaks. And browsers that
// have no WebAssembly: the page says so.
import { gzipSync } from 'node:zlib';
import { expect, type Page, test } from '@playwright/test';

/** What must not happen on any page; call what it returns at the end. */
function watch(page: Page): () => void {
  const faults: string[] = [];
  page.on('pageerror', (error) => faults.push(String(error)));
  page.on('dialog', (dialog) => {
    faults.push(`a dialog: ${dialog.message()}`);
    void dialog.dismiss();
  });
  page.on('crash', () => faults.push('the page crashed'));
  return () => expect(faults).toEqual([]);
}

const values = [
  '999999999999999999',
  '-1',
  'NaN',
  '1e308',
  '<img src=x onerror=alert(1)>',
  'javascript:alert(1)',
  'constructor',
  '__proto__',
  '%00%ff',
  'x'.repeat(450),
];
const names = ['boxes', 'scene', 'technique', 'cell', 'show', 'rate', 'frame', 'view', 'box', 'race', 'renderer'];

for (const path of ['', 'article/', 'lab/', 'bench/', 'narrow-phase/', 'queries/']) {
  test(`no address breaks /${path}`, async ({ page }) => {
    test.setTimeout(240_000);
    const done = watch(page);
    await page.emulateMedia({ reducedMotion: 'reduce' });
    for (const value of values) {
      const query = names.map((name) => `${name}=${value.includes('%') ? value : encodeURIComponent(value)}`).join('&');
      await page.goto(`/${path}?${query}#${value}`);
      await expect(page.getByRole('heading', { level: 1 })).toBeVisible();
      await expect.poll(() => page.evaluate(() => 6 * 7)).toBe(42);
      expect(await page.locator('img[src=x]').count()).toBe(0);
    }
    done();
  });
}

test('no file breaks the lab', async ({ page }) => {
  test.setTimeout(240_000);
  const done = watch(page);
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.goto('/lab/?boxes=100');
  const zeros = Buffer.alloc(64 * 2 ** 20);
  const recording = Buffer.alloc(16);
  recording.writeInt32LE(0x424f5841, 0);
  recording.writeInt32LE(2, 4);
  recording.writeInt32LE(2 ** 30, 8); // boxes
  recording.writeInt32LE(2 ** 30, 12); // frames
  const files = {
    'empty.trace': Buffer.alloc(0),
    'text.trace': Buffer.from('<script>alert(1)</script>'.repeat(100)),
    'deep.json': Buffer.from('['.repeat(200_000)),
    'bomb.trace': gzipSync(gzipSync(zeros)),
    'zeros.gz': gzipSync(zeros),
    'huge.bin': recording,
    '<img src=x onerror=alert(1)>.trace': Buffer.from([1, 2, 3]),
  };
  for (const [name, buffer] of Object.entries(files)) {
    await page.locator('input[type=file]').setInputFiles({ name, mimeType: 'application/octet-stream', buffer });
    await page.waitForTimeout(700);
    await expect.poll(() => page.evaluate(() => 6 * 7)).toBe(42);
    expect(await page.locator('img[src=x]').count(), name).toBe(0);
  }
  await expect(page.getByRole('heading', { level: 1 })).toBeVisible();
  done();
});

test('without WebGL, the lab says that solid scenes need it, and shows a flat one', async ({ page }) => {
  await page.addInitScript(() => {
    const { getContext } = HTMLCanvasElement.prototype;
    HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, kind: string) {
      return kind.startsWith('webgl') ? null : getContext.call(this, kind);
    } as typeof getContext;
  });
  await page.goto('/lab/?scene=uniform3d&boxes=100');
  const note = page.locator('#note');
  await expect(note).toHaveText(
    'uniform3d cannot be shown: solid scenes need WebGL, which is switched off or missing here',
  );
  await expect(page.locator('#scene')).toHaveValue('uniform2d');
  await expect(page.locator('[data-number="boxes"]').first()).toHaveText('100');
  await expect(page.locator('#flat')).toBeVisible();
  await expect(page.locator('#solid')).toBeHidden();
  await page.locator('#scene').selectOption('mixed3d');
  await expect(note).toHaveText(/^mixed3d cannot be shown: solid scenes need WebGL/);
  await expect(page.locator('#scene')).toHaveValue('uniform2d');
});

test('without WebAssembly, each showcase says what is missing', async ({ page }) => {
  test.setTimeout(120_000);
  await page.addInitScript('delete globalThis.WebAssembly');
  await page.goto('/showcases/');
  for (const id of ['nodes', 'chart', 'cloud', 'map', 'belt']) {
    await page.locator(`#${id}`).scrollIntoViewIfNeeded();
    const controls = page.locator(`#${id} .controls`);
    await expect(controls, id).toContainText(/This (stopped|did not start): broadphase needs WebAssembly/, {
      timeout: 30_000,
    });
  }
});

for (const path of ['', 'narrow-phase/', 'queries/']) {
  test(`without WebAssembly, /${path} says what is missing`, async ({ page }) => {
    await page.addInitScript('delete globalThis.WebAssembly');
    await page.goto(`/${path}`);
    const said = page.getByRole('alert');
    await expect(said).toHaveText(/^This stopped: broadphase needs WebAssembly/);
    await expect(said).toBeInViewport();
  });
}
