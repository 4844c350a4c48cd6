// The page of the benchmark as a visitor meets it: how long a frame of a game takes, out of a file of results; scenes,
// growth, the heat map and its advice, motions; and a race in the browser itself, whose result can be saved and shown.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect, type Page, test } from '@playwright/test';

const file = fileURLToPath(new URL('../bench/bench-results.json', import.meta.url));
const { rows } = JSON.parse(readFileSync(file, 'utf8'));
const scenes = rows.filter(({ kind }: { kind: string }) => kind === 'scenes');

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

async function openResults(page: Page): Promise<void> {
  await page.goto('/bench/');
  await page.getByLabel('Your own results').setInputFiles(file);
  await expect(page.getByLabel('Measured on')).toHaveValue('bench-results.json');
}

const charts = (page: Page) => page.locator('#charts figure');

test('the front page leads here', async ({ page }) => {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.goto('/');
  await page.getByRole('navigation', { name: 'Site' }).getByRole('link', { name: 'Benchmark' }).click();
  await expect(page.getByRole('heading', { level: 1 })).toHaveText('The benchmark');
});

test('the page answers how long a frame of a game takes', async ({ page }) => {
  await openResults(page);
  const part = page.getByRole('region', { name: 'How long does a frame of my game take?' });
  await expect(page.locator('#things')).toHaveValue('1000');
  await expect(part.locator('#frame-answer')).toHaveText(
    /1,000 things: a whole frame takes 0\.030 ms with this library.*0\.150 ms.*sort and sweep.*0\.500 ms.*flatbush/,
  );
  await expect(part.locator('figure svg rect')).toHaveCount(7);
  await part.getByText('Figures, and how').click();
  await expect(part.locator('code')).toHaveText('npm run bench -- --objects "all move" --count 1000');
  await expect(part.locator('tbody')).toContainText('it fell');
  await page.locator('#things').selectOption('100');
  await page.getByLabel('What moves').selectOption('one in twenty');
  await expect(part.locator('#frame-answer')).toContainText('100 things');
});

test('each scene is a figure with its bars, its numbers and its command', async ({ page }) => {
  await openResults(page);
  await page.locator('#count').selectOption('any number');
  await expect(charts(page)).toHaveCount(scenes.length);
  await page.getByLabel('Dimensions').selectOption('3D');
  await expect(charts(page)).toHaveCount(1);
  await page.locator('#count').selectOption('2,000');
  const figure = charts(page).first();
  await expect(figure.getByRole('img')).toHaveAttribute('aria-label', /uniform3d with 2,000 boxes\. The fastest: \S+/);
  await expect(figure).toContainText('980 to 1,020 pairs, 100 frames');
  const { contenders } = scenes.find(({ name }: { name: string }) => name === 'uniform3d');
  await expect(figure.locator('svg rect')).toHaveCount(contenders.length);
  await figure.getByText('Figures, and how').click();
  await expect(figure.locator('code')).toHaveText('npm run bench -- --scenes uniform3d --count 2000');
  await expect(figure.locator('tbody tr').filter({ hasText: 'box-intersect' })).toHaveText(/25$/);
});

test('growth has a line and a power for each contender, the heat map advice', async ({ page }) => {
  await openResults(page);
  await page.locator('#growth-scene').selectOption('mixed2d');
  const powers = page.locator('#growth tbody tr');
  await expect(powers.filter({ hasText: 'strip-sweep' })).toHaveText(/strip-sweep0\.\d\d|strip-sweep1\.\d\d/);
  await expect(page.locator('#growth svg path.piece')).not.toHaveCount(0);
  await page.locator('#count').selectOption('any number');
  await expect(page.locator('#advice tbody tr')).toHaveCount(5);
  await expect(page.locator('#advice')).toContainText('best, or within 10 %');
});

test('no choice leads to nothing: what was not measured cannot be chosen, and says why', async ({ page }) => {
  test.slow();
  await openResults(page);
  const menu = (id: string) => page.locator(`#${id}`);
  const barred = (id: string) => menu(id).locator('option:disabled').allTextContents();
  expect(await barred('dimensions')).toEqual(['3D: not measured with 100,000 boxes']);
  await menu('count').selectOption('any number');
  expect(await barred('dimensions')).toEqual([]);
  await menu('dimensions').selectOption('3D');
  expect(await barred('count')).toEqual(['1,000: not measured in 3D', '100,000: not measured in 3D']);

  await page.reload();
  await expect(page.locator('#growth')).toBeVisible();
  for (const machine of await menu('machine').locator('option').allTextContents()) {
    await menu('machine').selectOption(machine);
    await menu('moves').selectOption('5 % move');
    expect(await barred('things')).toContain('2,000: not measured if one in twenty moves');
    await menu('moves').selectOption('all move');
    await menu('things').selectOption('2000');
    expect(await barred('moves')).toEqual(['one in twenty: not measured with 2,000 things']);
    await menu('things').selectOption('1000');
    const empty = await page.evaluate(() => {
      const empty: string[] = [];
      const of = (id: string) => document.querySelector<HTMLSelectElement>(`#${id}`)!;
      const choices = (id: string) => [...of(id).options].filter(({ disabled }) => !disabled);
      const choose = (id: string, value: string) => {
        of(id).value = value;
        of(id).dispatchEvent(new Event('change'));
      };
      const every = (first: string, second: string, look: () => boolean) => {
        for (const { value } of [...of(first).options]) {
          choose(second, choices(second)[0]!.value);
          if (choices(first).every((each) => each.value !== value)) continue;
          choose(first, value);
          for (const each of choices(second)) {
            choose(second, each.value);
            if (!look()) empty.push(`${first} ${value}, ${second} ${each.value}`);
          }
        }
      };
      const full = (id: string) => document.querySelector(`#${id} svg`) !== null;
      const told = () => /choose .* boxes/i.test(document.querySelector('#advice')!.textContent!);
      every('things', 'moves', () => full('frame-chart'));
      every('dimensions', 'count', () => full('charts') && (full('heat-chart:not([hidden])') || told()));
      for (const { value } of choices('growth-scene')) {
        choose('growth-scene', value);
        if (!full('growth-chart')) empty.push(`growth-scene ${value}`);
      }
      return empty;
    });
    expect(empty).toEqual([]);
    await menu('dimensions').selectOption('');
  }
});

test('results without whole frames or scenes say so', async ({ page }) => {
  await page.goto('/bench/');
  await expect(page.locator('#growth')).toBeVisible();
  const none = JSON.stringify({ date: '2026-01-01', machine: { cpu: 'none' }, rows: [] });
  const buffer = Buffer.from(none);
  await page.getByLabel('Your own results').setInputFiles({ name: 'none.json', mimeType: '', buffer });
  await expect(page.locator('#frame-answer')).toHaveText(/no whole frames\. Choose others at “Measured on”/);
  await expect(page.locator('#charts')).toHaveText(/no scenes\. Choose others at “Measured on”/);
});

test('the newest results are shown first, whichever file comes first', async ({ page }) => {
  for (const late of [/amd-/, /intel-/]) {
    await page.route(
      (url) => late.test(url.pathname) && url.pathname.endsWith('.json'),
      async (route) => {
        await new Promise((resolve) => setTimeout(resolve, 700));
        await route.continue();
      },
    );
    await page.goto('/bench/');
    await expect(page.locator('#growth')).toBeVisible();
    const names = await page.locator('#machine option').allTextContents();
    const dates = names.map((name) => name.slice(-10));
    expect(dates).toEqual(dates.toSorted().reverse());
    await expect(page.locator('#machine')).toHaveValue(names[0]!);
    await page.unrouteAll();
  }
});

for (const [size, width, most] of [
  ['desktop', 1440, 30],
  ['phone', 390, 6],
] as const) {
  test(`growth: names stand apart, each by its own line, and one can be brought out: ${size}`, async ({ page }) => {
    await page.setViewportSize({ width, height: 900 });
    await page.goto('/bench/');
    const chart = page.locator('#growth svg');
    await expect(chart).toBeVisible();
    for (const machine of await page.locator('#machine option').allTextContents()) {
      await page.locator('#machine').selectOption(machine);
      const { covered, adrift, shown } = await chart.evaluate((svg) => {
        const texts = [...svg.querySelectorAll('text')].filter((text) => text.checkVisibility());
        const boxes = texts.map((text) => ({ text: text.textContent, ...text.getBoundingClientRect().toJSON() }));
        const covered = boxes.flatMap((a, k) =>
          boxes
            .slice(k + 1)
            .filter((b) => a.left < b.right && b.left < a.right && a.top + 2 < b.bottom && b.top + 2 < a.bottom)
            .map((b) => `${a.text} and ${b.text}`),
        );
        // A name with a leader starts where a line ends; one without stands at that height.
        const ends = [...svg.querySelectorAll('path.piece')].map((path) => {
          const [x, y] = path.getAttribute('d')!.split('L').at(-1)!.split(',').map(Number);
          const { left, top } = svg.getBoundingClientRect();
          return [x + left, y + top];
        });
        const names = [...svg.querySelectorAll<SVGGElement>('.name:not(.passing)')];
        const adrift = names.filter((name) => {
          const text = name.querySelector('text')!.getBoundingClientRect();
          const leader = name.querySelector('path')?.getBoundingClientRect();
          return !ends.some(([x, y]) =>
            leader
              ? Math.abs(leader.left - 5 - x) < 1 && leader.top - 1 <= y && y <= leader.bottom + 1
              : Math.abs(text.left - 9 - x) < 2 && Math.abs((text.top + text.bottom) / 2 - y) < 5,
          );
        });
        return { covered, adrift: adrift.map((name) => name.textContent), shown: names.length };
      });
      expect(covered).toEqual([]);
      expect(adrift).toEqual([]);
      expect(shown).toBeLessThanOrEqual(most);
    }
    await page.getByLabel('Highlight').selectOption('planck');
    await expect(page.locator('#growth .name.chosen text')).toHaveText('planck');
    await expect(page.locator('#growth .said')).toContainText(
      /^planck: [\d.]+ ms with 20 boxes, .* the time of set\.$/,
    );
  });
}

test('motions are a table, with the goals', async ({ page }) => {
  await openResults(page);
  const part = page.getByRole('region', { name: 'Motions from games' });
  const motions = part.getByRole('region', { name: 'Figures, motion by motion' }).locator('tbody tr');
  await expect(motions).toHaveCount(4);
  await expect(motions.first()).toContainText(/straight 2D10,000set.*0\.28x/);
  await expect(part.getByRole('region', { name: 'Goals' })).toContainText('1 of 2; the worst: 0.90x (flock 2D');
});

test('charts are pictures with a name, whose parts have none; labels of the run keep their distance', async ({
  page,
}) => {
  await openResults(page);
  await page.locator('#count').selectOption('any number');
  await expect(page.locator('#heat svg')).toBeVisible();
  await expect(page.locator('main svg[role="img"][aria-label]')).not.toHaveCount(0);
  await expect(page.locator('main svg:not([role])')).toHaveCount(0);
  await expect(page.locator('main svg g:is([aria-label], [aria-description])')).toHaveCount(0);
  await expect(page.locator('#run-names label').last()).toBeVisible();
  for (const width of [390, 1000, 1280, 1440]) {
    await page.setViewportSize({ width, height: 900 });
    // The words of a label end before the next label begins.
    const touching = await page.locator('#run-names label').evaluateAll((labels) =>
      labels.flatMap((label, k) => {
        const range = document.createRange();
        range.selectNodeContents(label);
        const [mine, next] = [range.getBoundingClientRect(), labels[k + 1]?.getBoundingClientRect()];
        return next?.top === label.getBoundingClientRect().top && mine.right > next.left - 4 ? [label.textContent] : [];
      }),
    );
    expect(touching).toEqual([]);
  }
});

test('a file that is not a result is refused with a message', async ({ page }) => {
  await page.goto('/bench/');
  await page.getByLabel('Your own results').setInputFiles({ name: 'a.json', mimeType: '', buffer: Buffer.from('{}') });
  await expect(page.locator('#note')).toContainText('a.json was not read: these are no results');
});

test('the race runs in the browser: all find the same pairs, and the result can be saved and shown', async ({
  page,
}) => {
  await page.goto('/bench/');
  await page.locator('#run-count').selectOption('1,000');
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await expect(page.locator('#run-doing')).toContainText(/trying|frame/);
  await expect(page.locator('#run-doing')).toContainText('Done', { timeout: 45_000 });
  const figure = page.locator('#run-result figure');
  await expect(figure.locator('svg rect')).toHaveCount(7);
  await expect(figure.locator('tbody tr').filter({ hasText: 'box-intersect' })).toHaveText(/box-intersect[\d.]+/);
  const saving = page.waitForEvent('download');
  await page.getByRole('button', { name: 'Save the result' }).click();
  const saved = await (await saving).path();
  await page.getByLabel('Your own results').setInputFiles(saved);
  await expect(charts(page)).toHaveCount(1);

  await page.locator('#run-scene').selectOption('uniform3d');
  await expect(page.getByLabel('flatbush')).toBeDisabled();
  await page.getByRole('button', { name: 'Run', exact: true }).click();
  await page.getByRole('button', { name: 'Stop' }).click();
  await expect(page.locator('#run-doing')).toHaveText('Stopped.');
});

for (const [name, width, colorScheme] of [
  ['phone-light', 390, 'light'],
  ['phone-dark', 390, 'dark'],
  ['desktop-light', 1280, 'light'],
  ['desktop-dark', 1280, 'dark'],
] as const) {
  test(`looks right: ${name}`, async ({ page }) => {
    await page.setViewportSize({ width, height: 900 });
    await page.emulateMedia({ colorScheme });
    await openResults(page);
    await expect(page.locator('#motions')).toBeVisible();
    const overflow = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    expect(overflow).toBeLessThanOrEqual(0);
    await page.screenshot({ path: `test-results/screens/bench-${name}.png`, fullPage: true });
  });
}
