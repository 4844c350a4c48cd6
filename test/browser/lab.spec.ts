// The lab as a visitor meets it: scenes, techniques, cells, the race, files, recordings and links do what they say, and
// nothing is written to the console as an error or fetched from elsewhere.
import { readFileSync } from 'node:fs';
import { expect, type Page, test } from '@playwright/test';
import { openTrace } from 'broadphase/trace';

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
const solved = (page: Page) => expect.poll(() => number(page, 'pairs'), { timeout: 20_000 }).toBeGreaterThan(0);
const note = (page: Page) => page.locator('#note');

/** Opens the lab so that it stands still at its first frame. */
async function openStill(page: Page, query: string): Promise<void> {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.goto(`/lab/?${query}`);
  await solved(page);
  await expect(page.getByRole('button', { name: 'Play' })).toBeVisible();
}

/** How many colours an element shows. */
const colours = async (page: Page, selector: string) => coloursOf(page, await page.locator(selector).screenshot());

async function coloursOf(page: Page, png: Buffer): Promise<number> {
  const picture = png.toString('base64');
  return page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes]));
    const context = new OffscreenCanvas(image.width, image.height).getContext('2d')!;
    context.drawImage(image, 0, 0);
    return new Set(new Uint32Array(context.getImageData(0, 0, image.width, image.height).data.buffer)).size;
  }, picture);
}

/** The share of a canvas in the colour of the page, where nothing is drawn. */
function backgroundShare(selector: string): number {
  const canvas = document.querySelector<HTMLCanvasElement>(selector)!;
  const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d')!;
  copy.drawImage(canvas, 0, 0);
  const pixels = new Uint32Array(copy.getImageData(0, 0, canvas.width, canvas.height).data.buffer);
  const page = getComputedStyle(canvas).getPropertyValue('--page').trim().slice(1);
  const [red, green, blue] = [0, 2, 4].map((at) => Number.parseInt(page.slice(at, at + 2), 16));
  const background = (0xff000000 | (blue << 16) | (green << 8) | red) >>> 0;
  return pixels.filter((pixel) => pixel === background).length / pixels.length;
}

/** Drops a file on the page. */
async function drop(page: Page, name: string, bytes: Buffer): Promise<void> {
  const transfer = await page.evaluateHandle(
    ([name, base64]) => {
      const data = new DataTransfer();
      data.items.add(new File([Uint8Array.from(atob(base64), (character) => character.charCodeAt(0))], name));
      return data;
    },
    [name, bytes.toString('base64')] as const,
  );
  await page.dispatchEvent('body', 'dragover', { dataTransfer: transfer });
  await page.dispatchEvent('body', 'drop', { dataTransfer: transfer });
}

test('opens from the first page, runs, and draws its charts', async ({ page }) => {
  await page.goto('/');
  await page.getByRole('navigation', { name: 'Site' }).getByRole('link', { name: 'Lab' }).click();
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('The lab');
  await solved(page);
  const before = await number(page, 'frame');
  await expect.poll(() => number(page, 'frame'), { timeout: 20_000 }).toBeGreaterThan(before + 5);
  await expect.poll(() => number(page, 'rate'), { timeout: 20_000 }).toBeGreaterThan(0);
  await expect(page.locator('.chart .uplot')).toHaveCount(5);
  await expect(page.locator('.reading').first()).not.toHaveText('–');
  expect(await page.evaluate(() => crossOriginIsolated)).toBe(true);
});

test('every technique finds the same pairs, and its cells are drawn', async ({ page }) => {
  await openStill(page, 'scene=mixed2d&boxes=800');
  const pairs = await number(page, 'pairs');
  const menu = page.getByRole('combobox', { name: 'Technique' });
  for (const name of await menu.locator('option').allTextContents()) {
    await menu.selectOption(name);
    await expect(page).toHaveURL(new RegExp(`technique=${name}&frame`));
    if (name !== 'auto') await expect(shown(page, 'technique')).toHaveText(name);
    expect(await number(page, 'pairs'), name).toBe(pairs);
    expect(await number(page, 'cells'), name).toBeGreaterThan(0);
  }
});

test('sweep-and-prune has intervals, of which so few are drawn that the boxes are seen', async ({ page }) => {
  await openStill(page, 'boxes=5000&technique=sweep-and-prune');
  await expect(shown(page, 'cells').locator('..')).toHaveText('5,000 intervals, 40 drawn');
  expect(await page.evaluate(backgroundShare, '#boxes')).toBeGreaterThan(0.3);
  await page.getByRole('checkbox', { name: 'Cells', exact: true }).uncheck();
  await expect(shown(page, 'cells').locator('..')).toHaveText('5,000 intervals');
});

test('cells that are too small to be seen are said to be, until the view is zoomed', async ({ page }) => {
  await openStill(page, 'boxes=200000&technique=spatial-grid');
  const told = shown(page, 'cells').locator('..');
  await expect(told).toHaveText(/^[\d,]+ cells, too small to see here$/);
  for (let k = 0; k < 4; k++) await page.getByRole('button', { name: 'Zoom in' }).click();
  await expect(told).toHaveText(/^[\d,]+ cells$/);
});

test('every scene can be shown', async ({ page }) => {
  test.slow();
  await openStill(page, 'boxes=500&show=structure,heat,pairs');
  const menu = page.getByRole('combobox', { name: 'Scene' });
  const names = await menu
    .locator('option')
    .evaluateAll((options) => options.map((o) => (o as HTMLOptionElement).value));
  for (const name of names) {
    await menu.selectOption(name);
    await expect(page).toHaveURL(new RegExp(`scene=${name}&`), { timeout: 20_000 });
    expect(await number(page, 'boxes'), name).toBeGreaterThan(100);
    await expect(page.locator('#flat')).toBeVisible({ visible: !/3d|gravity/.test(name) });
    await expect(page.locator('#solid')).toBeVisible({ visible: /3d|gravity/.test(name) });
  }
});

test('steps frame by frame, plays and pauses, by button and by the space key', async ({ page }) => {
  await openStill(page, 'boxes=300');
  await page.getByRole('button', { name: 'Step' }).click();
  await expect(shown(page, 'frame')).toHaveText('1');
  await expect(page).toHaveURL(/frame=1/);
  await page.locator('#flat').press(' ');
  await expect(page.getByRole('button', { name: 'Pause' })).toBeVisible();
  await expect.poll(() => number(page, 'frame')).toBeGreaterThan(3);
  await page.locator('#flat').press(' ');
  await expect(page.getByRole('button', { name: 'Play' })).toBeVisible();
});

test('a click on a box shows its pairs and cells, and its partners can be followed', async ({ page }) => {
  await openStill(page, 'scene=dense2d&boxes=100&technique=spatial-grid');
  await page.locator('#flat').click();
  const chosen = page.locator('#chosen');
  await expect(chosen.getByRole('heading')).toHaveText(/^Box \d+/);
  await expect(chosen).toContainText(/In \d+ cells?, \d+ pairs? with/);
  const first = await chosen.getByRole('heading').textContent();
  await chosen.locator('.partners button').first().click();
  await expect(chosen.getByRole('heading')).not.toHaveText(first!);
  await expect(page).toHaveURL(/box=\d+/);
  await chosen.getByRole('button', { name: 'Close the box' }).click();
  await expect(chosen).toBeHidden();
});

test('what is told of a box is written in place while it moves, and Escape closes it', async ({ page }) => {
  await page.goto('/lab/?scene=dense2d&boxes=100&technique=spatial-grid&box=7');
  const chosen = page.locator('#chosen');
  const close = chosen.getByRole('button', { name: 'Close the box' });
  await close.focus();
  const told = await chosen.locator('p').first().textContent();
  await expect(chosen.locator('p').first()).not.toHaveText(told!);
  await expect(close).toBeFocused();
  await page.keyboard.press('Escape');
  await expect(chosen).toBeHidden();
  await expect(page.locator('#flat')).toBeFocused();
});

test('pans and zooms, keeps the view in the address, and shows everything again', async ({ page }) => {
  await openStill(page, 'boxes=300');
  const view = page.locator('#flat');
  await view.press('+');
  await view.press('ArrowLeft');
  await expect(page).toHaveURL(/view=0\.\d+,0\.5,1\.25/);
  await page.getByRole('button', { name: 'Show everything' }).click();
  await expect(page).not.toHaveURL(/view=/);
  const box = (await view.boundingBox())!;
  await page.mouse.move(box.x + 200, box.y + 200);
  await page.mouse.down();
  await page.mouse.move(box.x + 260, box.y + 220, { steps: 4 });
  await page.mouse.up();
  await expect(page).toHaveURL(/view=/);
  await expect(page.locator('#chosen')).toBeHidden(); // a drag is no click
});

test('the cell size costs what the curve shows, which is drawn as the slider moves', async ({ page }) => {
  await openStill(page, 'boxes=3000&technique=spatial-grid');
  const slider = page.getByRole('slider', { name: 'Side of a cell' });
  const curve = page.getByRole('img', { name: /Milliseconds by cell size/ });
  await expect(curve).toHaveAttribute('aria-label', /nothing measured/);
  const tests = await number(page, 'tests');
  await slider.fill('24');
  await expect(page).toHaveURL(/cell=640/);
  await expect(curve).toHaveAttribute('aria-label', /21 sizes measured/, { timeout: 30_000 });
  expect(await number(page, 'tests')).toBeGreaterThan(2 * tests);
  await page.getByRole('button', { name: 'Draw the whole curve' }).click();
  await expect(curve).toHaveAttribute('aria-label', /41 sizes measured, the best is \d/, { timeout: 30_000 });
  await page.getByRole('checkbox', { name: 'The library chooses' }).check();
  await expect(page).not.toHaveURL(/cell=/);
  await expect.poll(() => number(page, 'tests')).toBe(tests);
  await page.getByRole('combobox', { name: 'Technique' }).selectOption('brute-force');
  await expect(page.locator('#cells')).toBeHidden();
});

test('techniques race on the same frames, and agree', async ({ page }) => {
  await page.goto('/lab/?boxes=500&race=brute-force,spatial-grid,quadtree,auto');
  const bars = page.locator('#bars li');
  await expect(bars).toHaveCount(4);
  await expect(page.locator('.tile')).toHaveCount(4);
  await expect(page.locator('#race-note')).toContainText(/all find the same \d+ pairs/, { timeout: 20_000 });
  await expect.poll(() => number(page, 'frame'), { timeout: 20_000 }).toBeGreaterThan(5);
  for (const text of await bars.allTextContents()) expect(text).toMatch(/ ms, \d+\.\d×$/);
  expect(
    await bars.locator('.bar').evaluateAll((all) => new Set(all.map((bar) => bar.style.cssText)).size),
  ).toBeGreaterThan(1);
  expect(await colours(page, '.tile >> nth=1')).toBeGreaterThan(10);
  await page.getByRole('checkbox', { name: 'quadtree' }).uncheck();
  await expect(bars).toHaveCount(3);
  await page.getByRole('button', { name: 'Race' }).click();
  await expect(page.locator('#flat')).toBeVisible();
  await expect(page).not.toHaveURL(/race=/);
});

test('a race of nobody shows nobody, cannot be played, and is still a race when the page is loaded again', async ({
  page,
}) => {
  await openStill(page, 'boxes=300');
  await page.getByRole('button', { name: 'Race' }).click();
  await expect(page.locator('#race-note')).toContainText('Median of 1 frame,');
  await page.getByRole('button', { name: 'Step' }).click();
  await expect(page.locator('#race-note')).toContainText('Median of 2 frames,');
  for (const racer of await page.locator('#racer-list input').all()) await racer.uncheck();
  const expectNobody = async () => {
    await expect(note(page)).toHaveText('Choose who races.');
    await expect(page.locator('.tile, #bars li')).toHaveCount(0);
    await expect(page.locator('#race-note')).toBeEmpty();
    await expect(page.getByRole('button', { name: 'Play' })).toBeDisabled();
    await expect(page.getByRole('button', { name: 'Step' })).toBeDisabled();
    await expect(page.getByRole('button', { name: 'Race' })).toHaveAttribute('aria-pressed', 'true');
    await expect(page).toHaveURL(/race=$/);
  };
  await expectNobody();
  await page.reload();
  await expectNobody();
  await page.getByRole('checkbox', { name: 'quadtree' }).check();
  await expect(page.locator('#race-note')).toContainText('Median of 1 frame,');
  await expect(page.locator('.tile')).toHaveCount(1);
  await page.getByRole('button', { name: 'Step' }).click();
  await expect(shown(page, 'frame')).toHaveText('1');
});

test('a race goes on after a recording that was long in coming', async ({ page }) => {
  await page.context().route('**/*.trace*.gz', async (route) => {
    await new Promise((resolve) => setTimeout(resolve, 1500));
    await route.continue();
  });
  await page.goto('/lab/?boxes=2000&race=auto,strip-sweep');
  const note = page.locator('#race-note');
  await expect(note).toContainText('all find the same', { timeout: 20_000 });
  const menu = page.getByRole('combobox', { name: 'Scene' });
  for (let k = 0; k < 8; k++) {
    await menu.selectOption('rain');
    await page.waitForTimeout(700);
    await menu.selectOption('crowd');
    await expect(page).toHaveURL(/scene=crowd/, { timeout: 20_000 });
    await expect(page.getByRole('button', { name: 'Pause' })).toBeVisible();
  }
  await expect(shown(page, 'frame')).not.toContainText('/'); // as a recording's does
  const frame = await number(page, 'frame');
  await expect.poll(() => number(page, 'frame'), { timeout: 20_000 }).toBeGreaterThan(frame);
});

test('a race whose scene is changed again and again goes on, and leaves no workers behind', async ({ page }) => {
  test.slow();
  let [workers, most] = [0, 0];
  page.on('worker', (worker) => {
    most = Math.max(most, ++workers);
    worker.on('close', () => workers--);
  });
  await page.goto(
    '/lab/?boxes=2000&race=auto,strip-sweep,quadtree,r-tree,bsp-tree,aabb-tree,spatial-grid,home-cell-grid',
  );
  await expect(page.locator('#race-note')).toContainText('all find the same', { timeout: 20_000 });
  const menu = page.getByRole('combobox', { name: 'Scene' });
  const names = await menu
    .locator('option')
    .evaluateAll((options) => options.map((o) => (o as HTMLOptionElement).value));
  for (let k = 0; k < 25; k++) {
    await menu.selectOption(names[(3 * k) % names.length]);
    await page.waitForTimeout(150);
  }
  await menu.selectOption('crowd');
  await expect(page).toHaveURL(/scene=crowd/, { timeout: 30_000 });
  await expect(page.locator('#race-note')).toContainText('all find the same', { timeout: 20_000 });
  await expect(menu).toHaveValue('crowd');
  await expect(page.locator('.tile.out')).toHaveCount(0);
  await expect(shown(page, 'frame')).not.toContainText('/'); // as a recording's does
  const frame = await number(page, 'frame');
  await expect.poll(() => number(page, 'frame'), { timeout: 20_000 }).toBeGreaterThan(frame);
  await expect.poll(() => page.workers().length, { timeout: 20_000 }).toBe(8 + 1);
  expect(most).toBeLessThanOrEqual(2 * (8 + 1)); // some of the race before, until the browser has ended them
});

test('a corrupted file gives a readable message, and the page goes on', async ({ page }) => {
  await page.goto('/lab/?boxes=300');
  await solved(page);
  const bytes = readFileSync('recordings/smash.trace.gz');
  const broken = Buffer.from(bytes);
  broken[broken.length >> 1] ^= 0x55;
  await drop(page, 'game.trace', broken);
  await expect(note(page)).toContainText(/game\.trace cannot be shown: trace: .*(broken|corrupted)/);
  await drop(page, 'notes.txt', Buffer.from('not a recording at all'));
  await expect(note(page)).toContainText('notes.txt cannot be shown: trace: header, byte 0: not a trace');
  await drop(page, 'empty.trace', Buffer.alloc(0));
  await expect(note(page)).toContainText('empty.trace cannot be shown');
  await expect(shown(page, 'boxes')).toHaveText('300');
  await expect(page.getByRole('combobox', { name: 'Scene' })).toHaveValue('uniform2d');
  const before = await number(page, 'frame');
  await expect.poll(() => number(page, 'frame')).toBeGreaterThan(before);
});

test('a dropped recording is shown, also in the race', async ({ page }) => {
  await openStill(page, 'boxes=300');
  await drop(page, 'my-game.trace.gz', readFileSync('recordings/smash.trace.gz'));
  await expect(note(page)).toContainText('my-game.trace.gz: 20 frames');
  await expect(shown(page, 'boxes')).toHaveText('9,601');
  await expect(shown(page, 'frame')).toHaveText('0 / 19');
  await expect(page.getByRole('slider', { name: 'Boxes' })).toBeDisabled();
  await expect(page).not.toHaveURL(/scene=/);
  await page.getByRole('button', { name: 'Race' }).click();
  await expect(page.locator('#race-note')).toContainText('all find the same', { timeout: 30_000 });
});

test('what is recorded is a trace of the frames shown', async ({ page }) => {
  await openStill(page, 'scene=crowd&boxes=150');
  await page.getByRole('button', { name: 'Record', exact: true }).click();
  for (let k = 1; k <= 4; k++) {
    await page.getByRole('button', { name: 'Step' }).click();
    await expect(shown(page, 'frame')).toHaveText(String(k));
  }
  const download = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Stop and save' }).click();
  const file = await download;
  expect(file.suggestedFilename()).toBe('crowd.trace');
  const trace = openTrace(readFileSync((await file.path())!));
  expect(trace.frames).toBe(5);
  expect(Array.from(trace, ({ count }) => count)).toEqual([150, 150, 150, 150, 150]);
});

test('another scene, or a race, ends a recording and saves it', async ({ page }) => {
  await openStill(page, 'scene=crowd&boxes=150');
  const record = page.locator('#record');
  for (const act of [
    () => page.getByRole('combobox', { name: 'Scene' }).selectOption('dense2d'),
    () => page.getByRole('button', { name: 'Race' }).click(),
  ]) {
    await record.click();
    await expect(record).toHaveText('Stop and save');
    const [file] = await Promise.all([page.waitForEvent('download'), act()]);
    expect(openTrace(readFileSync((await file.path())!)).frames).toBe(1);
    await expect(record).toHaveText('Record');
    await expect(page.locator('#recording')).toContainText('Something else was opened. Saved.');
  }
});

test('a link shows the same: scene, technique, cells, frame, view and box', async ({ page }) => {
  const query = 'scene=crowd&boxes=640&technique=quadtree&show=heat,pairs&frame=30&view=0.4,0.6,3&box=7';
  await openStill(page, query);
  await expect(shown(page, 'frame')).toHaveText('30');
  await expect(page.locator('#chosen')).toContainText('Box 7');
  await expect(page.getByRole('checkbox', { name: 'Pairs' })).toBeChecked();
  await expect(page.getByRole('checkbox', { name: 'Cells', exact: true })).not.toBeChecked();
  await page.getByRole('button', { name: 'Step' }).click();
  await expect(page).toHaveURL(/frame=31/);
  const { searchParams } = new URL(page.url());
  for (const [name, value] of new URLSearchParams(query)) {
    const now = searchParams.get(name)!.split(',').sort().join();
    expect(now, name).toBe(name === 'frame' ? '31' : value.split(',').sort().join());
  }
});

test('a link that is copied right after a change has the change', async ({ page }) => {
  await openStill(page, 'boxes=300');
  const copied = await page.evaluate(async () => {
    let copied = '';
    navigator.clipboard.writeText = async (text) => {
      copied = text;
    };
    document.querySelector<HTMLInputElement>('#layers [value=pairs]')!.click();
    document.querySelector<HTMLButtonElement>('#share')!.click();
    return copied;
  });
  expect(copied).toContain('show=structure,pairs');
  await expect(page).toHaveURL(copied);
});

test('an address that makes no sense is said to, and the defaults are shown', async ({ page }) => {
  await page.goto(
    '/lab/?boxes=99999999999&scene=%3Cimg%20src=x%3E&technique=magic&frame=1e9&view=1,2&race=nobody&cell=-3',
  );
  await solved(page);
  await expect(note(page)).toContainText('boxes is ‘99999999999’, expected a whole number from 2 to 200000');
  await expect(note(page)).toContainText('scene is ‘<img src=x>’');
  await expect(shown(page, 'boxes')).toHaveText('5,000');
});

test('what takes too long is stopped, said to be, and the page goes on', async ({ page }) => {
  test.slow();
  await page.goto('/lab/?scene=uniform2d&boxes=200000&technique=home-cell-grid&cell=1e30');
  await expect(note(page)).toContainText('home-cell-grid with cells of 1e+30 was stopped: it took more than 10 s', {
    timeout: 60_000,
  });
  await expect(shown(page, 'boxes')).toHaveText('200,000');
  await page.getByRole('button', { name: 'Step' }).click();
  await expect(shown(page, 'frame')).toHaveText('1', { timeout: 20_000 });
});

test('a solid scene is drawn, turned by keys, and its boxes can be clicked', async ({ page }) => {
  await openStill(page, 'scene=dense3d&boxes=400&technique=spatial-grid');
  await expect(page.locator('#solid')).toBeVisible();
  expect(await colours(page, '#solid')).toBeGreaterThan(20);
  await page.locator('#solid').press('ArrowLeft');
  await expect(page).toHaveURL(/view=[-\d.]+(,[-\d.]+){5}/);
  await page.locator('#solid').click();
  await expect(page.locator('#chosen')).toContainText(/Box \d+/);
});

test('everything of a solid scene is in view, wide or tall', async ({ page }) => {
  await openStill(page, 'scene=gravity');
  for (const [width, height] of [
    [1440, 900],
    [390, 844],
  ]) {
    await page.setViewportSize({ width, height });
    await page.waitForTimeout(300);
    const view = (await page.locator('#solid').boundingBox())!;
    for (const x of [view.x + 1, view.x + view.width - 5]) {
      const clip = { x, y: view.y + 4, width: 4, height: view.height - 8 };
      expect(await coloursOf(page, await page.screenshot({ clip, fullPage: true })), `${width}: at ${x}`).toBe(1);
    }
  }
});

test('the library for solid scenes is fetched for those alone', async ({ page }) => {
  const fetched: string[] = [];
  page.on('request', (request) => fetched.push(request.url()));
  await openStill(page, 'boxes=300');
  expect(fetched.filter((url) => url.includes('view-3d'))).toEqual([]);
  await page.getByRole('combobox', { name: 'Scene' }).selectOption('sparse3d');
  await expect(page.locator('#solid')).toBeVisible();
  expect(fetched.some((url) => url.includes('view-3d'))).toBe(true);
});

test('200,000 boxes run', async ({ page }) => {
  test.slow();
  await page.goto('/lab/?boxes=200000');
  await expect.poll(() => number(page, 'frame'), { timeout: 60_000 }).toBeGreaterThan(10);
  expect(await number(page, 'pairs')).toBeGreaterThan(90_000);
});

test('the tests of brute force, of nine digits, fit beside the pairs', async ({ page }) => {
  await page.setViewportSize({ width: 1440, height: 900 });
  await openStill(page, 'scene=sparse2d&boxes=20000&technique=brute-force');
  await expect(page.locator('#numbers [data-number=tests]')).toHaveText('199,990,000');
  const rightOf = async (selector: string) => {
    const { x, width } = (await page.locator(selector).boundingBox())!;
    return x + width;
  };
  expect(await rightOf('#numbers [data-number=tests]')).toBeLessThanOrEqual(await rightOf('#numbers'));
});

for (const [device, width, height] of [
  ['phone', 390, 844],
  ['wide', 1100, 800],
  ['very-wide', 1440, 900],
] as const) {
  for (const colorScheme of ['light', 'dark'] as const) {
    test(`fits a ${device} screen, ${colorScheme}`, async ({ page }) => {
      await page.setViewportSize({ width, height });
      await page.emulateMedia({ colorScheme });
      for (const [name, query] of [
        ['grid', 'scene=clustered2d&boxes=2000&technique=spatial-grid&show=structure,heat'],
        ['race', 'scene=clustered2d&boxes=2000&race=spatial-grid,quadtree,r-tree,bsp-tree'],
      ]) {
        await openStill(page, query);
        if (name === 'race') await expect(page.locator('#race-note')).toContainText('all find the same');
        expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
        expect(await colours(page, '#stage')).toBeGreaterThan(10);
        await page.screenshot({
          path: `test-results/screens/lab-${name}-${device}-${colorScheme}.png`,
          fullPage: true,
        });
      }
    });
  }
}
