// The page of queries as a visitor meets it: every query is asked and answered by mouse, finger and keys.
import { expect, type Page, test } from '@playwright/test';

let faults: string[] = [];

test.beforeEach(({ page, baseURL }) => {
  faults = [];
  page.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
  page.on('pageerror', (error) => faults.push(String(error)));
  page.on('request', (request) => {
    const url = request.url();
    if (!/^(data|blob):/.test(url) && !url.startsWith(baseURL!)) faults.push(`a request to ${url}`);
  });
});

test.afterEach(() => expect(faults).toEqual([]));

/** Opens one query, standing still. */
async function open(page: Page, query: string): Promise<void> {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.goto(`/queries/#${query}`);
  await expect(page.locator('#call')).not.toBeEmpty();
}

const call = (page: Page) => page.locator('#call');
const found = async (page: Page) =>
  Number((await page.locator('[data-number=found]').textContent())!.replaceAll(',', ''));
const expectFound = (page: Page) => expect.poll(() => found(page));

/** Drags across the view, from one share of its size to another. */
async function drag(page: Page, from: [number, number], to: [number, number]): Promise<void> {
  const { x, y, width, height } = (await page.locator('#view').boundingBox())!;
  await page.mouse.move(x + from[0] * width, y + from[1] * height);
  await page.mouse.down();
  await page.mouse.move(x + to[0] * width, y + to[1] * height, { steps: 4 });
  await page.mouse.up();
}

/** The ids in the comment below the call. */
const ids = async (page: Page) => [...(await call(page).textContent())!.matchAll(/\/\/ \[([^\]]*)/g)][0][1].split(', ');

test('a box that is dragged across everything finds all, and a small one few', async ({ page }) => {
  await open(page, 'box');
  await drag(page, [0.001, 0.001], [0.999, 0.999]);
  await expectFound(page).toBe(400);
  await expect(call(page)).toContainText('space.queryBox(');
  await drag(page, [0.4, 0.4], [0.55, 0.6]);
  await expectFound(page).toBeLessThan(100);
  expect(await found(page)).toBeGreaterThan(1);
});

test('a mask leaves layers out', async ({ page }) => {
  await open(page, 'box');
  await drag(page, [0.001, 0.001], [0.999, 0.999]);
  await expectFound(page).toBe(400);
  await page.getByRole('checkbox', { name: '1', exact: true }).uncheck();
  await expectFound(page).toBe(400 - 134);
  await expect(call(page)).toContainText('{ mask: 6 }');
  await page.getByRole('checkbox', { name: '2', exact: true }).uncheck();
  await page.getByRole('checkbox', { name: '4', exact: true }).uncheck();
  await expectFound(page).toBe(0);
});

test('a page that is there at once has its answers too', async ({ page }) => {
  await page.addInitScript(() => {
    performance.now = () => 50; // milliseconds after it was asked for
  });
  await open(page, 'nearest');
  await expectFound(page).toBeGreaterThan(0);
});

test('a point finds what holds it, a circle what it touches', async ({ page }) => {
  await open(page, 'nearest');
  const [nearest] = await ids(page);
  await page.getByRole('radio', { name: 'Circle' }).check({ force: true });
  await expect(page).toHaveURL(/#circle$/);
  await page.getByRole('slider', { name: 'Radius' }).fill('30');
  await expectFound(page).toBeGreaterThan(0);
  expect(await ids(page)).toContain(nearest);
  await page.getByRole('slider', { name: 'Radius' }).fill('0');
  await expect(call(page)).toContainText(', 0);');
  const touched = await found(page);
  await page.getByRole('radio', { name: 'Point' }).check({ force: true });
  await expectFound(page).toBe(touched);
});

test('a ray meets the first box, and all of them in order', async ({ page }) => {
  await open(page, 'ray');
  await drag(page, [0.5, 0.99], [0.5, 0.5]);
  await expectFound(page).toBe(1);
  const one = /id: (\d+), distance: ([\d.]+), normal: \[(-?\d), (-?\d)\]/;
  const [, id, distance, , down] = one.exec((await call(page).textContent())!)!;
  expect(Number(distance)).toBeGreaterThan(0);
  expect(Number(down)).toBe(-1);
  await page.getByRole('checkbox', { name: 'All hits' }).check();
  await expectFound(page).toBeGreaterThan(2);
  await expect(call(page)).toContainText('space.rayCastAll(');
  expect(one.exec((await call(page).textContent())!)![1]).toBe(id);
  const distances = [...(await call(page).textContent())!.matchAll(/distance: ([\d.]+)/g)].map(([, text]) =>
    Number(text),
  );
  expect(distances).toEqual(distances.toSorted((a, b) => a - b));
});

test('a box that is swept stops at the first', async ({ page }) => {
  await open(page, 'sweep');
  await drag(page, [0.5, 1], [0.5, 0.02]);
  await expectFound(page).toBe(1);
  expect(Number(/time: ([\d.]+)/.exec((await call(page).textContent())!)![1])).toBeLessThan(0.9);
  await drag(page, [0.001, 0.001], [0.002, 0.03]);
  await expectFound(page).toBe(0);
  await expect(call(page)).toContainText('undefined');
});

test('as many as are wanted are nearest, and more hold the fewer', async ({ page }) => {
  await open(page, 'nearest');
  await expectFound(page).toBe(10);
  const ten = await ids(page);
  const slider = page.getByRole('slider', { name: 'How many' });
  await slider.press('ArrowRight');
  await expectFound(page).toBe(11);
  expect((await ids(page)).slice(0, 10)).toEqual(ten);
});

test('the partners of a chosen box are those that collide with it', async ({ page }) => {
  await open(page, 'partners');
  await expect(call(page)).toContainText('space.collisionsOf(');
  const shares = Array.from({ length: 40 }, (_, k) => 0.3 + 0.01 * k);
  for (const share of shares) {
    await drag(page, [share, 0.5], [share, 0.5]);
    await page.waitForTimeout(50);
    if ((await found(page)) > 0) break;
  }
  expect(await found(page)).toBeGreaterThan(0);
  await expect(call(page)).toContainText('// true');
});

test('pairs begin and end as boxes move', async ({ page }) => {
  await open(page, 'events');
  await expectFound(page).toBe(0);
  let changes = 0;
  for (let k = 0; k < 10; k++) {
    await page.getByRole('button', { name: 'Step' }).click();
    changes += await found(page);
  }
  expect(changes).toBeGreaterThan(5);
  await expect(call(page)).toContainText('space.began');
});

test('pairs that began and ended differ by more than their colours: by rings and crosses', async ({ page }) => {
  await page.addInitScript(`{
    window.drawn = { rings: 0, lines: 0 };
    const { arc, lineTo } = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.arc = function (...given) {
      window.drawn.rings++;
      return arc.apply(this, given);
    };
    CanvasRenderingContext2D.prototype.lineTo = function (...given) {
      window.drawn.lines++;
      return lineTo.apply(this, given);
    };
  }`);
  await open(page, 'events');
  for (let k = 0; k < 10; k++) await page.getByRole('button', { name: 'Step' }).click();
  const { rings, lines } = (await page.evaluate('drawn')) as { rings: number; lines: number };
  expect(rings).toBeGreaterThan(2);
  expect(lines).toBeGreaterThan(4);
  expect(lines % 2).toBe(0);
});

const time = (page: Page) => page.locator('[data-number=time]');

test('what is there after update() has its time, once something has moved', async ({ page }) => {
  const label = page.locator('#time-label');
  await open(page, 'box');
  await expect(label).toHaveText('Answered in');
  await expect(time(page)).toHaveText(/^\d/);
  for (const name of ['events', 'filters', 'debug']) {
    await open(page, name);
    await expect(label).toHaveText('update() took');
    await expect(time(page)).toHaveText('–');
    await page.getByRole('button', { name: 'Step' }).click();
    await expect(time(page)).toHaveText(/^\d/);
  }
});

test('the time of an answer is not that of building its query', async ({ page }) => {
  // A clock that a cosine, as each ray of a fan needs, moves on by a second.
  await page.addInitScript(() => {
    const { cos } = Math;
    const now = performance.now.bind(performance);
    let more = 0;
    performance.now = () => now() + more;
    Math.cos = (angle) => {
      more += 1000;
      return cos(angle);
    };
  });
  for (const name of ['fan', 'spaces']) {
    await open(page, name);
    await expect(time(page)).toHaveText(/^\d/);
    expect(Number(await time(page).textContent()), name).toBeLessThan(1e6); // µs
  }
});

test('filters say who meets whom', async ({ page }) => {
  await open(page, 'filters');
  const before = await found(page);
  expect(before).toBeGreaterThan(10);
  await page.getByRole('checkbox', { name: '1 and 2' }).check();
  await expectFound(page).toBeGreaterThan(before);
  await expect(call(page)).toContainText('space.setFilter(0, 1, 7)');
  for (const box of await page.locator('[name=meet]').all()) await box.uncheck();
  await expectFound(page).toBe(0);
});

test('keys move what is asked, and with shift its end', async ({ page }) => {
  await open(page, 'box');
  const corners = async () =>
    /\((.*?)\)/
      .exec((await call(page).textContent())!)![1]
      .split(', ')
      .map(Number);
  const [minX, minY, maxX, maxY] = await corners();
  await page.locator('#view').focus();
  await page.keyboard.press('ArrowRight');
  await expect.poll(corners).toEqual([minX + 8, minY, maxX + 8, maxY]);
  await page.keyboard.press('Shift+ArrowUp');
  await expect.poll(corners).toEqual([minX + 8, minY, maxX + 8, maxY + 8]);
  // At the border it stops, and keeps its shape.
  for (let press = 0; press < 60; press++) await page.keyboard.press('ArrowLeft');
  await expect.poll(async () => (await corners())[0]).toBe(0);
  const [left, bottom, right, top] = await corners();
  expect([right - left, top - bottom]).toEqual([maxX - minX, maxY + 8 - minY]);
  await page.keyboard.press('Tab');
  expect(await page.evaluate(() => document.activeElement?.id)).toBe('play');
});

test('it moves by itself, and stops where asked', async ({ page }) => {
  await page.goto('/queries/#nearest');
  const text = await call(page).textContent();
  await expect.poll(() => call(page).textContent(), { timeout: 20_000 }).not.toBe(text);
  await page.getByRole('button', { name: 'Pause' }).click();
  await expect(page.getByRole('button', { name: 'Play' })).toBeVisible();
});

test.describe('on a phone', () => {
  test.use({ viewport: { width: 375, height: 740 }, hasTouch: true });

  test('what is below the hint stays where it is, whichever query is chosen', async ({ page }) => {
    await open(page, 'box');
    const top = () => page.locator('#controls').evaluate((form) => form.getBoundingClientRect().top + scrollY);
    const before = await top();
    for (const name of await page.locator('[name=ask]').evaluateAll((all) => all.map(({ id }) => id))) {
      await page.locator(`#${name}`).check({ force: true });
      expect(await top(), name).toBe(before);
    }
  });

  test('a tap moves the point, and nothing is wider than the screen', async ({ page }) => {
    await open(page, 'nearest');
    const before = await ids(page);
    await page.locator('#view').tap({ position: { x: 60, y: 80 } });
    await expect.poll(() => ids(page)).not.toEqual(before);
    for (const address of ['/queries/', '/', '/article/', '/lab/', '/bench/']) {
      await page.goto(address);
      expect(await page.evaluate(() => document.documentElement.scrollWidth), address).toBeLessThanOrEqual(375);
    }
  });
});

test('a box that must contain boxes wholly finds fewer', async ({ page }) => {
  await open(page, 'box');
  await drag(page, [0.2, 0.2], [0.8, 0.8]);
  await expectFound(page).toBeGreaterThan(50);
  const touched = await found(page);
  await page.getByRole('checkbox', { name: 'Wholly inside' }).check();
  await expectFound(page).toBeLessThan(touched);
  await expect(call(page)).toContainText('{ within: true }');
});

test('a camera sees what is not behind its planes, and which boxes are wholly in view', async ({ page }) => {
  await open(page, 'view');
  await drag(page, [0.05, 0.5], [0.9, 0.5]);
  await expectFound(page).toBeGreaterThan(20);
  await expect(call(page)).toContainText('space.queryPlanes(planes)');
  const [, all, whole] = /\/\/ (\d+) boxes, (\d+) wholly inside/.exec((await call(page).textContent())!)!;
  expect(Number(all)).toBe(await found(page));
  expect(Number(whole)).toBeGreaterThan(5);
  expect(Number(whole)).toBeLessThan(Number(all));
});

test('many rays are cast in one call, and move with the point', async ({ page }) => {
  await open(page, 'fan');
  await drag(page, [0.5, 0.5], [0.5, 0.5]);
  await expectFound(page).toBeGreaterThan(20);
  expect(await found(page)).toBeLessThanOrEqual(90);
  const before = await call(page).textContent();
  await drag(page, [0.2, 0.8], [0.2, 0.8]);
  await expect(call(page)).not.toHaveText(before!);
  await expect(call(page)).toContainText('space.rayCasts(rays, { maxDistance: ');
});

test('the pairs of two spaces follow the one that is moved', async ({ page }) => {
  await open(page, 'spaces');
  await page.getByRole('slider', { name: 'Radius' }).fill('100');
  await expectFound(page).toBeGreaterThan(0);
  await expect(call(page)).toContainText('ring.pairsWith(space)');
  await drag(page, [0.001, 0.001], [0.001, 0.001]);
  await page.getByRole('slider', { name: 'Radius' }).fill('0');
  await expectFound(page).toBeLessThan(40);
  await drag(page, [0.5, 0.5], [0.5, 0.5]);
  await page.getByRole('slider', { name: 'Radius' }).fill('60');
  await expectFound(page).toBeGreaterThan(2);
});

test('what broadphase/draw shows of the space is drawn above the boxes', async ({ page }) => {
  await open(page, 'debug');
  await expectFound(page).toBeGreaterThan(10);
  const { after, now } = await page.evaluate(async () => {
    const canvas = document.querySelector<HTMLCanvasElement>('#upper')!;
    const inked = () => {
      const { data } = canvas.getContext('2d')!.getImageData(0, 0, canvas.width, canvas.height);
      return data.filter((value, k) => k % 4 === 3 && value > 0).length / (canvas.width * canvas.height);
    };
    const now = inked();
    document.querySelector<HTMLInputElement>('#ask-point')!.click();
    await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
    return { after: inked(), now };
  });
  expect(now).toBeGreaterThan(0.05);
  expect(after).toBeLessThan(0.01); // of a point there is but a dot
  await page.goto('/queries/#debug');
  const told = await call(page).textContent();
  await drag(page, [0.2, 0.2], [0.8, 0.7]);
  await expect(call(page)).not.toHaveText(told!);
  await expect(call(page)).toContainText('rays: [[');
});
