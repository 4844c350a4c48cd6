// The page of showcases as a visitor meets it: each runs by who is chosen, the milliseconds of all are told, nothing
// overlaps in the end, and code is copied in one piece.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect, type Locator, type Page, test } from '@playwright/test';

let faults: string[] = [];

test.beforeEach(({ page, baseURL }) => {
  test.slow();
  faults = [];
  page.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
  page.on('pageerror', (error) => faults.push(String(error)));
  page.on('request', (request) => {
    const url = request.url();
    if (!/^(data|blob):/.test(url) && !url.startsWith(baseURL!)) faults.push(`a request to ${url}`);
  });
});

test.afterEach(() => expect(faults).toEqual([]));

/** Where there is no GPU, and others work too, this takes long. */
const patient = { timeout: 40_000 };

/** Opens one showcase and waits until its contenders have been timed. */
async function open(page: Page, id: string, reducedMotion: 'reduce' | 'no-preference' = 'reduce') {
  await page.emulateMedia({ reducedMotion });
  await page.goto(`/showcases/#${id}`);
  const section = page.locator(`#${id}`);
  await section.scrollIntoViewIfNeeded();
  await expect(section).toHaveAttribute('data-ready', 'true', patient);
  await expect
    .poll(async () => (await section.locator('output').allTextContents()).every((text) => / ms$/.test(text)), patient)
    .toBe(true);
  return section;
}

/** The boxes of the nodes of the canvas, in its own pixels. */
const nodeBoxes = (page: Page) =>
  page.locator('#nodes .react-flow__node').evaluateAll((nodes) =>
    (nodes as HTMLElement[]).map((node) => {
      const { m41: x, m42: y } = new DOMMatrix(getComputedStyle(node).transform);
      return [x, y, x + node.offsetWidth, y + node.offsetHeight];
    }),
  );

/** How many pairs overlap by more than half a pixel: a test of every pair. */
const overlaps = (boxes: number[][]) =>
  boxes.reduce((sum, a, k) => {
    const over = (b: number[], axis: number) => Math.min(a[axis + 2], b[axis + 2]) - Math.max(a[axis], b[axis]);
    return sum + boxes.slice(k + 1).filter((b) => Math.min(over(b, 0), over(b, 1)) > 0.51).length;
  }, 0);

test('nodes: untangled, by everyone, none overlaps another; a node that is moved by keys has others give way', async ({
  page,
}) => {
  const section = await open(page, 'nodes');
  for (const name of ['broadphase', 'rbush', 'all pairs']) {
    await section.getByRole('button', { name: 'Start over' }).click();
    await expect(section.locator('p[role=status]')).toHaveText('40 nodes');
    await section.getByRole('radio', { name }).check();
    expect(overlaps(await nodeBoxes(page))).toBeGreaterThan(20);
    await section.getByRole('button', { name: 'Untangle' }).click();
    await expect.poll(async () => overlaps(await nodeBoxes(page)), patient).toBe(0);
  }
  await section.getByRole('radio', { name: 'broadphase' }).check();
  const before = await nodeBoxes(page);
  const node = section.locator('.react-flow__node').nth(20);
  await node.focus();
  await page.keyboard.press('Enter');
  for (let press = 0; press < 8; press++) await page.keyboard.press('Shift+ArrowDown');
  await expect.poll(async () => overlaps(await nodeBoxes(page)), patient).toBe(0);
  const after = await nodeBoxes(page);
  expect(after.filter(([, y], k) => y !== before[k][1]).length).toBeGreaterThan(1);
});

test('nodes: one application, which says how keys move in it, and edges that name what they join', async ({ page }) => {
  const section = await open(page, 'nodes');
  const application = section.getByRole('application');
  await expect(application).toHaveCount(1);
  await expect(application).toHaveAccessibleName(/^A canvas of nodes\. Tab goes from node to node/);
  await expect(section.getByRole('img', { name: 'From Fetch 1 to Parse 2', exact: true })).toHaveCount(1);
});

test('nodes: 500 are pasted, and come apart frame by frame', async ({ page }) => {
  const section = await open(page, 'nodes', 'no-preference');
  await section.getByRole('button', { name: 'Paste 500' }).click();
  await expect(section.locator('.react-flow__node')).toHaveCount(540);
  const heap = overlaps(await nodeBoxes(page));
  expect(heap).toBeGreaterThan(100);
  await section.getByRole('button', { name: 'Untangle' }).click();
  await expect(section.locator('p[role=status]')).toContainText('none overlap', { timeout: 90_000 });
  expect(overlaps(await nodeBoxes(page))).toBe(0);
  await expectAllInSight(section);
});

test('nodes: who starts over while they come apart gets the first ones as they were', async ({ page }) => {
  const section = await open(page, 'nodes', 'no-preference');
  const before = await nodeBoxes(page);
  await section.getByRole('button', { name: 'Paste 500' }).click();
  await section.getByRole('button', { name: 'Untangle' }).click();
  await expect(section.locator('p[role=status]')).toContainText('this step took');
  await section.getByRole('button', { name: 'Start over' }).click();
  await page.waitForTimeout(500);
  await expect(section.locator('p[role=status]')).toHaveText('40 nodes');
  expect(await nodeBoxes(page)).toEqual(before);
});

/** Nodes are within the stage, and none is cut off. */
const expectAllInSight = (section: Locator) =>
  expect
    .poll(
      () =>
        section.locator('.stage').evaluate((stage) => {
          const whole = stage.getBoundingClientRect();
          return [...stage.querySelectorAll('.react-flow__node')].filter((node) => {
            const { left, top, right, bottom } = node.getBoundingClientRect();
            return left < whole.left || top < whole.top || right > whole.right || bottom > whole.bottom;
          }).length;
        }),
      patient,
    )
    .toBe(0);

test('nodes: untangled at once, 540 are all in sight; the first Tab is at a node, not at an edge', async ({ page }) => {
  const section = await open(page, 'nodes');
  await section.getByRole('button', { name: 'Paste 500' }).click();
  await section.getByRole('button', { name: 'Untangle' }).click();
  await expect.poll(async () => overlaps(await nodeBoxes(page)), patient).toBe(0);
  await expectAllInSight(section);
  await expect(section.locator('.react-flow__edge[tabindex="0"]')).toHaveCount(0);
  await section.locator('.stage').evaluate((stage) => {
    stage.tabIndex = -1;
    stage.focus();
  });
  await page.keyboard.press('Tab');
  await expect(page.locator(':focus')).toHaveClass(/react-flow__node/);
});

test('nodes: one that is dragged stays with the pointer, and the others make room', async ({ page }) => {
  const section = await open(page, 'nodes');
  await section.getByRole('button', { name: 'Untangle' }).click();
  await expect.poll(async () => overlaps(await nodeBoxes(page)), patient).toBe(0);
  const box = (await section.locator('.react-flow__node').first().boundingBox())!;
  const target = (await section.locator('.react-flow__node').nth(2).boundingBox())!;
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(target.x + 10, target.y + 5, { steps: 8 });
  await page.mouse.up();
  await expect.poll(async () => overlaps(await nodeBoxes(page)), patient).toBe(0);
});

test.describe('by touch', () => {
  test.use({ viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true });

  test('nodes: a finger beside the nodes scrolls the page, one on a node drags it, two zoom', async ({ page }) => {
    const section = await open(page, 'nodes');
    const stage = section.locator('.stage');
    const bringIntoSight = () =>
      stage.evaluate((element) => element.scrollIntoView({ block: 'center', behavior: 'instant' }));
    await bringIntoSight();
    const touch = await page.context().newCDPSession(page);
    /** Moves fingers by so much in each of eight steps. */
    const drag = async (fingers: { x: number; y: number; by: [across: number, down: number] }[]) => {
      for (let step = 0; step <= 8; step++) {
        const touchPoints = fingers.map(({ x, y, by }, id) => ({ id, x: x + by[0] * step, y: y + by[1] * step }));
        await touch.send('Input.dispatchTouchEvent', { type: step === 0 ? 'touchStart' : 'touchMove', touchPoints });
      }
      await touch.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
      // A page that still scrolls from a swipe would take the next finger too. On a busy machine a frame may be late.
      for (let [still, at] = [0, -1]; still < 3; ) {
        await page.waitForTimeout(400);
        const now = await page.evaluate(() => scrollY);
        still = now === at ? still + 1 : 0;
        at = now;
      }
    };
    const look = async () => ({
      scroll: await page.evaluate(() => scrollY),
      view: await stage.locator('.react-flow__viewport').evaluate((view) => (view as HTMLElement).style.transform),
      nodes: await nodeBoxes(page),
    });
    const before = await look();
    const { x, y, width, height } = (await stage.boundingBox())!;
    await drag([{ x: x + width - 12, y: y + height - 60, by: [0, -20] }]);
    const scrolled = await look();
    expect(scrolled.scroll - before.scroll).toBeGreaterThan(100);
    expect(scrolled).toEqual({ ...before, scroll: scrolled.scroll });

    await bringIntoSight(); // how far a swipe goes depends on the speed that a busy browser measures
    const { scroll } = await look();
    const node = (await stage.locator('.react-flow__node').nth(1).boundingBox())!; // near the border, the view would follow
    await drag([{ x: node.x + node.width / 2, y: node.y + node.height / 2, by: [0, -15] }]);
    const dragged = await look();
    expect(dragged.nodes[1]![1]).toBeLessThan(before.nodes[1]![1]! - 100);
    expect([dragged.scroll, dragged.view]).toEqual([scroll, before.view]);

    const top = (await stage.boundingBox())!.y + 60;
    await drag([
      { x: x + 20, y: top, by: [0, -2] },
      { x: x + width - 20, y: top + 20, by: [-5, 20] },
    ]);
    const zoomed = await look();
    expect(zoomed.view).not.toBe(before.view);
    expect(zoomed.scroll).toBe(scroll);
  });
});

test('belt: everyone sees about as many of the stones, and the one in the middle is picked by keys', async ({
  page,
}) => {
  const section = await open(page, 'belt');
  const status = section.locator('p[role=status]');
  await expect(status).toContainText('of 500,000 stones in view, 5,000 move', patient);
  const inView = async () => Number((await status.textContent())!.split(' ')[0]!.replaceAll(',', ''));
  const ours = await inView();
  expect(ours).toBeGreaterThan(1000);
  for (const name of ['each, as BatchedMesh does', 'a loop over spheres', 'broadphase']) {
    await section.getByRole('radio', { name }).check();
    await expect.poll(async () => Math.abs((await inView()) / ours - 1) < 0.1, patient).toBe(true);
  }
  await section.locator('.stage').focus();
  await page.keyboard.press('Enter');
  await expect(status).toContainText('is under the pointer', patient);
  await page.keyboard.press('ArrowLeft');
  await expect.poll(inView, patient).not.toBe(ours);
});

/** Nothing is drawn at the border of a canvas, so nothing is cut off there. */
const expectWithin = async (canvas: Locator) => {
  const drawn = await canvas.evaluate((element) => {
    const { width, height } = element as HTMLCanvasElement;
    const context = (element as HTMLCanvasElement).getContext('2d')!;
    const sides: [x: number, y: number, width: number, height: number][] = [
      [0, 0, width, 1],
      [0, height - 1, width, 1],
      [0, 0, 1, height],
      [width - 1, 0, 1, height],
    ];
    return sides.map((side) => context.getImageData(...side).data.some((value) => value > 0));
  });
  expect(drawn).toEqual([false, false, false, false]);
};

for (const [id, things] of [
  ['chart', 'rectangles'],
  ['cloud', 'words'],
] as const) {
  test(`${things}: at rest at once for those who ask for less motion, and none overlap`, async ({ page }) => {
    const section = await open(page, id);
    await expect(section.locator('p[role=status]')).toContainText(`300 ${things}`, patient);
    await expect(section.locator('p[role=status]')).toContainText('; 0 overlap', patient);
    await section.getByRole('radio', { name: 'rbush' }).check();
    await section.getByRole('button', { name: 'Shuffle' }).click();
    await expect(section.locator('p[role=status]')).toContainText('; 0 overlap', patient);
    const canvas = section.locator('canvas');
    await expectWithin(canvas);
    const look = () => canvas.evaluate((element) => (element as HTMLCanvasElement).toDataURL());
    const before = await look();
    await section.locator('.stage').focus();
    await page.keyboard.press('ArrowRight');
    await expect.poll(look, patient).not.toBe(before);
    await page.setViewportSize({ width: 600, height: 720 });
    await expect(() => expectWithin(canvas)).toPass(patient);
  });

  for (const width of [1440, 390]) {
    test(`${things}: few and many fit on their stage: ${width}`, async ({ page }) => {
      await page.setViewportSize({ width, height: 900 });
      const section = await open(page, id);
      const [status, canvas] = [section.locator('p[role=status]'), section.locator('canvas')];
      await expect(status).toContainText('; 0 overlap', patient);
      await expectWithin(canvas);
      await section.getByRole('button', { name: `2,000 ${things}` }).click();
      // Between walls, a pair of the smallest may be stuck; words are as wide as the fonts of the machine.
      await expect(status).toHaveText(new RegExp(`2000 ${things}.*; [0-2] overlap`), patient);
      await expectWithin(canvas);
    });
  }
}

test('labels: zooming in shows more, panning changes none, and both finders agree', async ({ page }) => {
  const section = await open(page, 'map');
  const status = section.locator('p[role=status]');
  await expect(status).toContainText(/at 1.0 times/, patient);
  const told = await status.textContent();
  await section.getByRole('radio', { name: 'rbush' }).check();
  await expect(status).toHaveText(told!);
  await section.locator('.stage').focus();
  await page.keyboard.press('+');
  await expect(status).toContainText('at 1.3 times', patient);
  await page.keyboard.press('-');
  await expect(status).toHaveText(told!, patient);
  await section.getByRole('button', { name: 'Zoom in' }).click();
  await expect(status).toContainText('at 1.6 times', patient);
});

/** What the canvases of a stage show, or where its nodes are. */
const picture = (section: Locator) =>
  section
    .locator('.stage')
    .evaluate((stage) =>
      JSON.stringify([
        Array.from(stage.querySelectorAll('canvas'), (canvas) => canvas.toDataURL()),
        Array.from(stage.querySelectorAll<HTMLElement>('.react-flow__node'), (node) => node.style.transform),
      ]),
    );

for (const [id, start] of [
  ['nodes', ['Paste 500', 'Untangle']],
  ['chart', ['2,000 rectangles']],
  ['map', ['Fly']],
  ['belt', ['Fly']],
] as const) {
  test(`${id}: what moves is stopped by a button, and by asking for less motion`, async ({ page }) => {
    const section = await open(page, id, 'no-preference');
    const stop = section.getByRole('button', { name: 'Stop' });
    const go = async () => {
      for (const name of start) await section.getByRole('button', { name, exact: true }).click();
      await expect(stop).toHaveAttribute('aria-disabled', 'false');
    };
    const expectRest = async () => {
      await expect(stop).toHaveAttribute('aria-disabled', 'true');
      await page.waitForTimeout(300); // a frame may be on its way
      const before = await picture(section);
      await page.waitForTimeout(500);
      expect(await picture(section)).toBe(before);
    };
    await expect(stop).toHaveAttribute('aria-disabled', 'true', patient);
    await go();
    const begun = await picture(section);
    await expect.poll(() => picture(section), patient).not.toBe(begun);
    await stop.focus();
    await page.keyboard.press('Enter');
    await expectRest();
    await expect(stop).toBeFocused();
    await go();
    await page.emulateMedia({ reducedMotion: 'reduce' });
    await expectRest();
  });
}

for (const id of ['map', 'belt']) {
  test(`${id}: while its stage is hidden nothing is drawn, and then it shows what it did`, async ({ page }) => {
    const section = await open(page, id);
    const status = section.locator('p[role=status]');
    if (id === 'map') await section.getByRole('button', { name: 'Zoom in' }).click();
    await expect(status).toContainText(id === 'map' ? '1.6 times the size' : 'stones in view', patient);
    const inView = async () => Number(/[\d,]+(?= of )/.exec((await status.textContent())!)![0].replaceAll(',', ''));
    const before = await inView();
    await section.locator('.stage').evaluate(async (stage: HTMLElement) => {
      for (const display of ['none', '']) {
        stage.style.display = display;
        for (let frame = 0; frame < 3; frame++) await new Promise(requestAnimationFrame);
      }
    });
    // The race may have moved some stones since.
    expect(Math.abs((await inView()) / before - 1)).toBeLessThan(0.02);
    if (id === 'map') await expect(status).toContainText('1.6 times the size');
  });
}

test('the code of each is copied in one piece', async ({ page, context }) => {
  await context.grantPermissions(['clipboard-read', 'clipboard-write']);
  await page.goto('/showcases/');
  for (const file of ['nodes-xyflow/separate', 'force-d3/force-collide-rect', 'force-d3/first-scales']) {
    const path = fileURLToPath(new URL(`../../examples/${file}.mjs`, import.meta.url));
    const block = page.locator('.code-block', { hasText: 'one file to copy' }).filter({ hasText: file.split('/')[1] });
    await block.locator('summary').click();
    // Looked for from before the click on: it says so for a moment only.
    const told = block.getByRole('button', { name: 'Copied' }).waitFor({ timeout: 20_000 });
    await Promise.all([told, block.getByRole('button').click()]);
    expect(await page.evaluate(() => navigator.clipboard.readText())).toBe(readFileSync(path, 'utf8').trimEnd());
  }
});

for (const colorScheme of ['light', 'dark'] as const) {
  for (const [device, width, height] of [
    ['phone', 390, 844],
    ['wide', 1440, 900],
  ] as const) {
    test(`fit a ${device} screen, ${colorScheme}`, async ({ page }) => {
      await page.setViewportSize({ width, height });
      await page.emulateMedia({ colorScheme });
      for (const id of ['nodes', 'chart', 'cloud', 'map']) {
        const section = await open(page, id);
        const background = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
        expect(background).toBe(colorScheme === 'light' ? 'rgb(251, 251, 250)' : 'rgb(16, 17, 19)');
        expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(width);
        await section.screenshot({ path: `test-results/screens/showcase-${id}-${device}-${colorScheme}.png` });
      }
    });
  }
}
