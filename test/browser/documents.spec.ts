// The pages to read: every link within the site leads somewhere, the guides and the reference fit a phone, light and
// dark, and are reached by keyboard; the reference can be searched.
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect, test } from '@playwright/test';

const dist = fileURLToPath(new URL('../../site/dist/', import.meta.url));
const readme = readFileSync(fileURLToPath(new URL('../../README.md', import.meta.url)), 'utf8');
/** Anchors that scripts make when the page runs. */
const made = /^(article\/index\.html#fig-\d+|queries\/index\.html#\w+)$/;

test('no link within the site is dead, and none leaves the path that the site stands under', () => {
  const pages = readdirSync(dist, { recursive: true, encoding: 'utf8' }).filter((file) => file.endsWith('.html'));
  const ids = (html: string) => new Set([...html.matchAll(/\bid="([^"]+)"/g)].map(([, id]) => id));
  const idsIn = new Map(pages.map((page) => [page, ids(readFileSync(dist + page, 'utf8'))]));
  const dead: string[] = [];
  let links = 0;
  for (const page of pages) {
    const html = readFileSync(dist + page, 'utf8');
    const fromRoot = page === '404.html' ? [' href="/'] : null; // its base
    expect(html.match(/\s(href|src)="\//g), page).toEqual(fromRoot);
    for (const { 1: attribute } of html.matchAll(/<a\b[^>]*?\shref="([^"]+)"/g)) {
      const href = attribute.replaceAll('&amp;', '&');
      if (/^(https?:|data:)/.test(href)) continue;
      links++;
      const { pathname, hash } = new URL(href, `http://site/${page}`);
      const target = decodeURIComponent(pathname.slice(1)).replace(/(^|\/)$/, '$1index.html');
      const id = decodeURIComponent(hash.slice(1));
      const known = idsIn.get(target);
      if (known && (id === '' || known.has(id) || made.test(`${target}#${id}`))) continue;
      dead.push(`${page}: ${href}`);
    }
  }
  expect(links).toBeGreaterThan(1000);
  expect(dead).toEqual([]);
});

test('each page says what it is to those who meet it as a link', () => {
  const pages = readdirSync(dist, { recursive: true, encoding: 'utf8' })
    .filter((file) => file.endsWith('.html'))
    .filter((file) => !/^(live\/|404)/.test(file));
  const titles = new Map<string, string>();
  for (const page of pages) {
    const html = readFileSync(dist + page, 'utf8');
    const title = /<title>([^<]+)<\/title>/.exec(html)![1]!;
    const description = /<meta\s+name="description"\s+content="([^"]*)"/.exec(html)?.[1] ?? '';
    expect(description.length, page).toBeGreaterThan(25);
    if (/^(api|guides|examples)\//.test(page)) expect(title, page).toMatch(/ broadphase$/);
    if (!page.startsWith('api/')) expect([titles.get(title), page], title).toContain(undefined);
    titles.set(title, page);
  }
});

test('no page of the site asks others for anything', async ({ page, baseURL }) => {
  const strangers: string[] = [];
  page.on('request', (request) => {
    if (!/^(data|blob):/.test(request.url()) && !request.url().startsWith(baseURL!)) strangers.push(request.url());
  });
  page.on(
    'response',
    (response) => response.status() >= 400 && strangers.push(`${response.status()} ${response.url()}`),
  );
  for (const address of [
    'guides/',
    'guides/moving-here/',
    'api/',
    'api/classes/broadphase.BroadPhase.html',
    'examples/ecs/',
  ]) {
    await page.goto(address);
    await page.waitForLoadState('networkidle');
  }
  expect(strangers).toEqual([]);
});

test('on paper no line of code and no column is cut off', async ({ page }) => {
  await page.setViewportSize({ width: 718, height: 1000 }); // A4 within the margins of Chromium
  await page.emulateMedia({ media: 'print' });
  for (const address of [
    'guides/queries/',
    'guides/figures/',
    'guides/worth-it/',
    'guides/command/',
    'examples/react/',
  ]) {
    await page.goto(address);
    const blocks = page.locator('.document :is(pre, .scroll)');
    expect(await blocks.count(), address).toBeGreaterThan(2);
    const cut = await blocks.evaluateAll((all) =>
      all.filter((each) => each.scrollWidth > each.clientWidth).map((each) => each.textContent!.slice(0, 40)),
    );
    expect(cut, address).toEqual([]);
    await expect(page.locator('.site-nav')).toBeHidden();
  }
});

for (const colorScheme of ['light', 'dark'] as const) {
  for (const [device, width, height] of [
    ['phone', 390, 844],
    ['wide', 1280, 900],
  ] as const) {
    test(`fit a ${device} screen, ${colorScheme}`, async ({ page }) => {
      await page.setViewportSize({ width, height });
      await page.emulateMedia({ colorScheme });
      for (const [name, address] of [
        ['guide', 'guides/moving-here/'],
        ['promises', 'guides/promises/'],
        ['example', 'examples/ecs/'],
        ['reference', 'api/'],
        ['reference-class', 'api/classes/broadphase.BroadPhase.html'],
        ['reference-all', 'api/documents/broadphase_all.html'],
      ]) {
        await page.goto(address);
        await expect(page.getByRole('heading', { level: 1 })).toBeVisible();
        const background = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
        expect(background, name).toBe(colorScheme === 'light' ? 'rgb(251, 251, 250)' : 'rgb(16, 17, 19)');
        expect(await page.evaluate(() => document.documentElement.scrollWidth), name).toBeLessThanOrEqual(width);
        await page.screenshot({ path: `test-results/screens/${name}-${device}-${colorScheme}.png` });
      }
    });
  }
}

test('the navigation leads by keyboard from the first page to a guide, and on to the reference', async ({ page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.goto('/');
  const follow = async (name: string) => {
    for (let presses = 0; presses < 40; presses++) {
      await page.keyboard.press('Tab');
      if ((await page.evaluate(() => document.activeElement?.textContent?.trim())) !== name) continue;
      return page.keyboard.press('Enter');
    }
    throw new Error(`the tab key does not come to ${name}`);
  };
  await follow('Guides');
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('Guides');
  await follow('Getting started');
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('Getting started');
  await follow('API');
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('API');
});

for (const width of [390, 800, 1280]) {
  test(`the tab key goes through a guide as it is read, ${width} pixels wide`, async ({ page }) => {
    await page.setViewportSize({ width, height: 900 });
    await page.goto('guides/events/');
    const places: { part: string; top: number; left: number }[] = [];
    do {
      await page.keyboard.press('Tab');
      places.push(
        await page.evaluate(() => {
          const { left, top } = document.activeElement!.getBoundingClientRect();
          const part = document.activeElement!.closest('.site-nav, .documents, .document')?.classList[0] ?? '';
          return { part, top: top + scrollY, left: left + scrollX };
        }),
      );
    } while (places.at(-1)!.part !== '');
    places.pop();
    const parts = places.map(({ part }) => part).filter((part, k, all) => part !== all[k - 1]);
    expect(parts).toEqual(width < 1024 ? ['site-nav', 'document', 'documents'] : ['site-nav', 'documents', 'document']);
    for (const part of parts) {
      const tops = places.filter((place) => place.part === part).map(({ top }) => Math.round(top / 40));
      if (part !== 'document') expect(tops, part).toEqual(tops.toSorted((a, b) => a - b)); // code has a button at its top
    }
    if (width < 1024) expect(places.at(-1)!.top).toBe(Math.max(...places.map(({ top }) => top)));
  });
}

test('a guide leads on to the next and back, and to the reference where it names something of it', async ({ page }) => {
  await page.goto('guides/queries/');
  const beside = page.getByRole('navigation', { name: 'Previous and next' });
  await beside.getByRole('link', { name: 'Events' }).click();
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('Events');
  await beside.getByRole('link', { name: 'Queries' }).click();
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('Queries');
  await expect(page.getByRole('link', { name: 'queryPlanes' })).toHaveCount(1); // the first time alone
  await page.getByRole('link', { name: 'queryPlanes' }).click();
  await expect(page).toHaveURL(/api\/classes\/broadphase\.BroadPhase\.html#queryplanes$/);
});

test('code of a guide is copied by a button', async ({ page, context }) => {
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  await page.goto('guides/getting-started/');
  const block = page.locator('.copied').first();
  await block.hover();
  await block.getByRole('button', { name: 'Copy' }).click();
  await expect(block.getByRole('button')).toHaveText('Copied');
  expect(await page.evaluate(() => navigator.clipboard.readText())).toMatch(/^mkdir overlaps && cd overlaps\n.*\S$/s);
});

test('llms.txt lists what there is to read, llms-full.txt has it', () => {
  const list = readFileSync(`${dist}llms.txt`, 'utf8');
  const links = [...list.matchAll(/\]\(([^)]+)\)/g)].map(([, link]) => link.replace(/\/$/, '/index.html'));
  expect(links.length).toBeGreaterThan(20);
  expect(links.filter((link) => !existsSync(dist + link))).toEqual([]);
  const full = readFileSync(`${dist}llms-full.txt`, 'utf8');
  for (const words of ['# Getting started', "import from 'broadphase/trace'", '#### queryBox(', 'within?: boolean']) {
    expect(full).toContain(words);
  }
  expect(full).not.toMatch(/\]\([\w./-]+\.md/);
});

test('the reference leads with BroadPhase: a line for each member, in the groups of the README', async ({ page }) => {
  await page.goto('api/');
  const groups = [...readme.matchAll(/^\| \*\*(.+?)\*\*/gm)].map(([, title]) => title);
  const headings = (await page.getByRole('heading', { level: 3 }).allTextContents()).map((text) => text.trim());
  expect(headings.slice(0, groups.length)).toEqual(groups);
  expect(groups.length).toBeGreaterThan(4);
  const line = page.getByRole('row').filter({ has: page.getByRole('link', { name: 'rayCast()', exact: true }) });
  await expect(line).toContainText('The first box that a ray hits');
  await line.getByRole('link').click();
  await expect(page).toHaveURL(/broadphase\.BroadPhase\.html#raycast$/);
  await page.goto('api/');
  await page.locator('h3').getByRole('link', { name: 'broadphase/all' }).click();
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('broadphase/all, /2d and /3d');
});

/** The smallest contrast of a coloured word in code with its background, as WCAG counts it. */
function leastContrast(): number {
  const channels = (colour: string) =>
    colour
      .match(/[\d.]+/g)!
      .slice(0, 3)
      .map(Number);
  const luminance = (colour: string) => {
    const [red, green, blue] = channels(colour).map((value) => {
      const share = value / 255;
      return share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4;
    });
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
  };
  const contrasts = Array.from(document.querySelectorAll('pre span[class^=hl-]'), (word) => {
    const pair = [getComputedStyle(word).color, getComputedStyle(word.closest('pre')!).backgroundColor].map(luminance);
    return (Math.max(...pair) + 0.05) / (Math.min(...pair) + 0.05);
  });
  return Math.min(...contrasts);
}

test('the reference can be read: its code has contrast, its links are underlined, and it has a main part', async ({
  page,
}) => {
  for (const colorScheme of ['light', 'dark'] as const) {
    await page.emulateMedia({ colorScheme });
    await page.goto('api/classes/broadphase.BroadPhase.html');
    await expect(page.getByRole('main').getByRole('heading', { level: 1 })).toBeVisible();
    expect(await page.evaluate(leastContrast), colorScheme).toBeGreaterThan(4.5);
    await expect(page.locator('.tsd-comment p a').first()).toHaveCSS('text-decoration-line', 'underline');
  }
});

test('the reference has the options of a method beside it', async ({ page }) => {
  await page.goto('api/classes/broadphase.BroadPhase.html#querybox');
  const told = page
    .locator('.tsd-member')
    .filter({ has: page.locator('#querybox') })
    .locator('.tsd-comment li');
  await expect(told.filter({ hasText: 'within?: boolean' })).toContainText('wholly inside');
  await expect(told.filter({ hasText: 'mask?: number' })).toContainText('32 bits');
});

test('the reference finds a method by its name', async ({ page }) => {
  await page.goto('api/');
  await page.getByRole('button', { name: 'Search' }).click();
  await page.keyboard.type('rayCastAll');
  const first = page.getByRole('option').first();
  await expect(first).toContainText('rayCastAll'); // not what the first letters found
  await first.click();
  await expect(page).toHaveURL(/broadphase\.BroadPhase\.html#raycastall/);
  await expect(page.getByText('All boxes that a ray hits').first()).toBeVisible();
});

test('Enter leads to the first that the search finds, also at once after typing', async ({ page }) => {
  await page.goto('api/');
  await page.getByRole('button', { name: 'Search' }).click();
  await page.keyboard.type('rayCastAll');
  await page.keyboard.press('Enter');
  await expect(page).toHaveURL(/broadphase\.BroadPhase\.html#raycastall/);
});

test('keys open the menu of the reference on a screen that is zoomed in, go through it, and close it', async ({
  page,
}) => {
  await page.setViewportSize({ width: 640, height: 450 });
  await page.goto('api/classes/broadphase.BroadPhase.html');
  const link = page.locator('.tsd-navigation').getByRole('link', { name: 'findPairsBetween' });
  await expect(link).toBeHidden();
  const button = page.locator('#tsd-toolbar-menu-trigger');
  await button.focus();
  await page.keyboard.press('Enter');
  await expect(link).toBeVisible();
  expect(await page.locator('.col-sidebar :focus').count()).toBe(1);
  await page.keyboard.press('Escape');
  await expect(link).toBeHidden();
  await expect(button).toBeFocused();
  await page.keyboard.press('Enter');
  await link.focus();
  await page.keyboard.press('Enter');
  await expect(page).toHaveURL(/findPairsBetween/);
});
