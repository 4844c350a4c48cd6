// The examples with a page: what each shows is what a look at every box says, by mouse, touch and keyboard.
import { expect, type Page, test } from '@playwright/test';
import { openExample } from './example.ts';

/** Without it Phaser draws on a 2D canvas: WebGL that runs on the processor is too slow for this many sprites. */
const withoutWebgl = (page: Page) =>
  page.addInitScript(() => {
    const { getContext } = HTMLCanvasElement.prototype;
    // biome-ignore lint/suspicious/noExplicitAny: it has a signature for each kind of context
    HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, kind: string, ...options: any[]) {
      return kind.includes('webgl') ? null : getContext.call(this, kind, ...options);
    } as typeof getContext;
  });

/** Where there is no GPU a frame takes long. */
const patient = { timeout: 30_000 };

const numbers = (page: Page) => page.locator('#numbers').innerText();
const count = (text: string, pattern: RegExp) => Number(pattern.exec(text)![1].replaceAll(',', ''));

test('20,000 bullets in Phaser: the pairs are those of two plain loops, and the shield can be steered', async ({
  page,
}) => {
  test.slow();
  await withoutWebgl(page);
  const faults = await openExample(page, 'bullets-phaser');
  await expect.poll(() => numbers(page), patient).toMatch(/you caught [1-9]/);
  const shield = () => page.evaluate('[game.x[0], game.y[0]]') as Promise<[number, number]>;
  const [x] = await shield();
  await page.locator('#stage').focus();
  await page.keyboard.down('ArrowLeft');
  await expect.poll(async () => (await shield())[0], patient).toBeLessThan(x - 20);
  await page.keyboard.up('ArrowLeft');
  const stage = (await page.locator('#stage').boundingBox())!;
  await page.mouse.move(stage.x + 0.25 * stage.width, stage.y + 0.75 * stage.height);
  const aimed = () => page.evaluate('[game.x[0] / game.width, game.y[0] / game.height].map((n) => n.toFixed(1))');
  await expect.poll(aimed, patient).toEqual([expect.stringMatching(/0\.[23]/), expect.stringMatching(/0\.[78]/)]);

  await page.getByRole('button', { name: 'Pause' }).click();
  await page.getByRole('checkbox', { name: 'two plain loops instead' }).check();
  const plain = count(await numbers(page), /find ([\d,]+) pairs/);
  expect(plain).toBeGreaterThan(200);
  const plainPairs = await page.evaluate('game.pairs.join()');
  await page.getByRole('checkbox').uncheck();
  expect(count(await numbers(page), /find ([\d,]+) pairs/)).toBe(plain);
  const sorted = await page.evaluate(
    'Array.from({ length: game.pairs.length / 2 }, (_, k) => [game.pairs[2 * k], game.pairs[2 * k + 1]]).sort(([a, b], [c, d]) => a - c || b - d).join()',
  );
  expect(sorted).toBe(plainPairs);
  expect(faults).toEqual([]);
});

test('20,000 bullets in Phaser stand still for those who ask for less motion', async ({ page }) => {
  test.slow();
  await withoutWebgl(page);
  await page.emulateMedia({ reducedMotion: 'reduce' });
  const faults = await openExample(page, 'bullets-phaser');
  const places = () => page.evaluate('game.x.slice(0, 400).join()');
  const before = await places();
  await page.waitForTimeout(500);
  expect(await places()).toBe(before);
  await page.getByRole('button', { name: 'Play' }).click();
  await expect.poll(places, patient).not.toBe(before);
  expect(faults).toEqual([]);
});

/** The ids of the boxes that overlap a box: one look at each. */
const overlapping = (boxes: number[][], [minX, minY, maxX, maxY]: number[]) =>
  boxes.flatMap((box, id) => (box[0] <= maxX && box[2] >= minX && box[1] <= maxY && box[3] >= minY ? [id] : []));

test('PixiJS: what is drawn is what overlaps the view, and what is picked lies under the pointer', async ({ page }) => {
  test.slow();
  const faults = await openExample(page, 'culling-pixi');
  await expect.poll(() => numbers(page), patient).toContain('of 100,000 drawn');
  const boxes = (await page.evaluate(
    'Array.from({ length: example.space.size }, (_, id) => [...example.space.get(id)])',
  )) as number[][];
  /** Draws, and compares with the boxes that overlap what the window shows of the world. */
  const look = async () => {
    await page.evaluate('new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))');
    const [view, seen] = (await page.evaluate(`(() => {
      const { world, app, sprites } = example;
      const [width, height] = [app.screen.width, app.screen.height];
      const corner = (x, y) => { const { x: a, y: b } = world.toLocal({ x, y }); return [a, b]; };
      return [[...corner(0, 0), ...corner(width, height)], sprites.flatMap(({ visible }, id) => (visible ? [id] : []))];
    })()`)) as [number[], number[]];
    expect(seen).toEqual(overlapping(boxes, view));
    expect(count(await numbers(page), /^([\d,]+) of/)).toBe(seen.length);
    return { view, seen };
  };
  const first = await look();
  expect(first.seen.length).toBeGreaterThan(100);

  const stage = page.locator('#stage');
  await stage.press('ArrowRight');
  await stage.press('-');
  const second = await look();
  expect(second.view[0]).not.toBe(first.view[0]);
  expect(second.seen.length).toBeGreaterThan(first.seen.length);
  const { x, y, width, height } = (await stage.boundingBox())!;
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.wheel(0, -300);
  await page.mouse.down();
  await page.mouse.move(x + width / 2 + 150, y + height / 2 + 40, { steps: 3 });
  await page.mouse.up();
  const third = await look();
  expect(third.seen.length).toBeLessThan(second.seen.length);

  // Over the middle of a tile, and in the middle of the view by the Enter key.
  const [minX, minY, maxX, maxY] = boxes[third.seen[7]];
  const scale = width / (third.view[2] - third.view[0]);
  const [atX, atY] = [(minX + maxX) / 2, (minY + maxY) / 2];
  await page.mouse.move(x + scale * (atX - third.view[0]), y + scale * (atY - third.view[1]));
  const top = Math.max(...overlapping(boxes, [atX, atY, atX, atY]));
  await expect(page.getByRole('status')).toHaveText(`Tile ${top.toLocaleString('en')}`);
  await stage.press('Enter');
  const [midX, midY] = [(third.view[0] + third.view[2]) / 2, (third.view[1] + third.view[3]) / 2];
  const middle = Math.max(-1, ...overlapping(boxes, [midX, midY, midX, midY]));
  await expect(page.getByRole('status')).toHaveText(
    middle < 0 ? 'No tile is here.' : `Tile ${middle.toLocaleString('en')}`,
  );
  expect(faults).toEqual([]);
});

test('three.js: the pairs of the cloud are those of a test of every pair of boxes, and what overlaps is hot', async ({
  page,
}) => {
  test.slow();
  await page.emulateMedia({ reducedMotion: 'reduce' });
  const faults = await openExample(page, 'instancing-three', '?boxes=1500');
  const look = async () => {
    const { pairs, middles, halves, heat } = (await page.evaluate(
      '(({ space, middles, halves, heat }) => ({ pairs: [...space.pairs], middles: [...middles], halves: [...halves], heat: [...heat] }))(example.cloud)',
    )) as Record<string, number[]>;
    const near = (a: number, b: number) =>
      [0, 1, 2].every(
        (axis) =>
          Math.abs(middles[3 * a + axis] - middles[3 * b + axis]) <= halves[3 * a + axis] + halves[3 * b + axis],
      );
    const expected: string[] = [];
    for (let a = 0; a < 1500; a++) for (let b = a + 1; b < 1500; b++) if (near(a, b)) expected.push(`${a} ${b}`);
    const found = Array.from({ length: pairs.length / 2 }, (_, k) => `${pairs[2 * k]} ${pairs[2 * k + 1]}`);
    expect(found.sort()).toEqual(expected.sort());
    expect(found.length).toBeGreaterThan(50);
    expect(heat.filter((value) => value === 1)).toHaveLength(new Set(pairs).size);
    return found.join();
  };
  const still = await look();
  expect(await look()).toBe(still);
  expect(count(await numbers(page), /find ([\d,]+) pairs/)).toBe(still.split(',').length);
  await page.getByRole('button', { name: 'Play' }).click();
  await expect.poll(() => page.evaluate('example.cloud.heat.some((heat) => heat > 0 && heat < 1)'), patient).toBe(true);
  await page.keyboard.press('p');
  await expect(page.getByRole('button', { name: 'Play' })).toBeVisible();
  expect(await look()).not.toBe(still);
  const place = () => page.evaluate('example.camera.position.toArray().join()');
  for (const key of ['ArrowLeft', 'ArrowUp', '-']) {
    const before = await place();
    await page.locator('#stage').press(key);
    expect(await place()).not.toBe(before);
  }
  expect(faults).toEqual([]);
});

/** How many pairs of boxes of the space overlap, by a test of every pair. */
const plainPairCount = `(() => {
  const boxes = [...example.space].map(([, box]) => [...box]);
  const half = boxes[0].length / 2;
  const meet = (a, b) => a.slice(0, half).every((low, k) => low <= b[k + half] && b[k] <= a[k + half]);
  return boxes.reduce((sum, a, k) => sum + boxes.slice(k + 1).filter((b) => meet(a, b)).length, 0);
})()`;

test('three.js: the helper has 12 edges for each box, and a line for each pair', async ({ page }) => {
  test.slow();
  await page.emulateMedia({ reducedMotion: 'reduce' });
  const faults = await openExample(page, 'draw-three');
  const pairs = (await page.evaluate(plainPairCount)) as number;
  expect(pairs).toBeGreaterThan(5);
  await expect(page.locator('#numbers')).toHaveText(`${pairs} pairs of 150 boxes`);
  const points = (name: string) => page.evaluate(`example.helper.getObjectByName('${name}').geometry.drawRange.count`);
  expect(await points('boxes')).toBe(2 * 12 * 150);
  expect(await points('pairs')).toBe(2 * pairs);
  await page.getByRole('checkbox', { name: 'cells' }).check();
  expect(await points('cells')).toBe((await page.evaluate('2 * 12 * example.space.structure().length / 6')) as number);
  await page.screenshot({ path: 'test-results/screens/draw-three.png' });
  await page.getByRole('button', { name: 'Play' }).click();
  await expect.poll(() => page.evaluate(plainPairCount), patient).not.toBe(pairs);
  expect(faults).toEqual([]);
});

test('PixiJS: the overlay draws boxes, pairs and a ray, and cells where they are wanted', async ({ page }) => {
  test.slow();
  await page.emulateMedia({ reducedMotion: 'reduce' });
  const faults = await openExample(page, 'draw-pixi');
  await expect(page.locator('#numbers')).toContainText('pairs of 120 boxes', patient);
  const pairs = (await page.evaluate(plainPairCount)) as number;
  await expect(page.locator('#numbers')).toHaveText(`${pairs} pairs of 120 boxes`);
  const strokes = () => page.evaluate('example.overlay.context.instructions.length');
  expect(await strokes()).toBe(4);
  const { x, y, width, height } = (await page.locator('#stage').boundingBox())!;
  await page.mouse.move(x + width / 4, y + height / 4);
  const [, , dx, dy] = (await page.evaluate('example.overlay.rays[0]')) as number[];
  expect([dx! / width, dy! / height].map((share) => share.toFixed(1))).toEqual(['-0.3', '-0.3']);
  await page.screenshot({ path: 'test-results/screens/draw-pixi.png' });
  await page.getByRole('checkbox', { name: 'cells' }).uncheck();
  expect(await strokes()).toBe(3);
  expect(faults).toEqual([]);
});

test('React: a band selects what it touches, and keys do what they do in a list', async ({ page }) => {
  const faults = await openExample(page, 'react');
  const board = page.getByRole('listbox');
  await expect.poll(() => page.getByRole('option').count()).toBeGreaterThan(100);
  const frame = (await board.boundingBox())!;
  const boxes = await page.getByRole('option').evaluateAll((tiles) =>
    (tiles as HTMLElement[]).map(({ style }) => {
      const [left, top, width, height] = [style.left, style.top, style.width, style.height].map(Number.parseFloat);
      return [left, top, left + width, top + height];
    }),
  );
  const selected = () =>
    page.getByRole('option', { selected: true }).evaluateAll((tiles) => tiles.map(({ id }) => Number(id.slice(5))));
  const drag = async (from: number[], to: number[]) => {
    await page.mouse.move(frame.x + from[0], frame.y + from[1]);
    await page.mouse.down();
    await page.mouse.move(frame.x + to[0], frame.y + to[1], { steps: 4 });
    await page.mouse.up();
  };
  await drag([401.5, 300.5], [120.5, 90.5]);
  const first = overlapping(boxes, [120.5, 90.5, 401.5, 300.5]);
  expect(first.length).toBeGreaterThan(15);
  expect(await selected()).toEqual(first);
  await expect(page.getByRole('status')).toContainText(`${first.length} of ${boxes.length} tiles selected`);

  await page.keyboard.down('Shift');
  await drag([500.5, 400.5], [610.5, 470.5]);
  await page.keyboard.up('Shift');
  const more = overlapping(boxes, [500.5, 400.5, 610.5, 470.5]);
  expect(await selected()).toEqual([...new Set([...first, ...more])].sort((a, b) => a - b));
  await page.mouse.click(frame.x + boxes[3][0] + 5, frame.y + boxes[3][1] + 5);
  expect(await selected()).toEqual([3]);

  await board.press('Escape');
  expect(await selected()).toEqual([]);
  await board.press('ArrowRight');
  await board.press(' ');
  expect(await selected()).toEqual([4]);
  await board.press('Shift+ArrowDown');
  const active = Number((await board.getAttribute('aria-activedescendant'))!.slice(5));
  expect(boxes[active][1]).toBeGreaterThan(boxes[4][3]);
  const [a, b] = [boxes[4], boxes[active]];
  const union = [Math.min(a[0], b[0]), a[1], Math.max(a[2], b[2]), b[3]];
  expect(await selected()).toEqual(overlapping(boxes, union));
  await board.press('Control+a');
  expect(await selected()).toHaveLength(boxes.length);
  expect(faults).toEqual([]);
});

test('React: a finger draws the band too', async ({ browser }) => {
  const page = await browser.newPage({ viewport: { width: 390, height: 780 }, hasTouch: true, isMobile: true });
  const faults = await openExample(page, 'react');
  await expect.poll(() => page.getByRole('option').count()).toBeGreaterThan(50);
  const touch = await page.context().newCDPSession(page);
  for (const [type, x, y] of [
    ['touchStart', 40, 60],
    ['touchMove', 120, 200],
    ['touchMove', 250, 420],
  ] as const) {
    await touch.send('Input.dispatchTouchEvent', { type, touchPoints: [{ x, y, id: 0 }] });
  }
  const selected = page.getByRole('option', { selected: true });
  await expect.poll(() => selected.count()).toBeGreaterThan(20);
  const count = await selected.count();
  // A second finger does nothing.
  const touchPoints = [
    { x: 250, y: 420, id: 0 },
    { x: 60, y: 500, id: 1 },
  ];
  for (const type of ['touchStart', 'touchMove'] as const) {
    await touch.send('Input.dispatchTouchEvent', { type, touchPoints });
    touchPoints[1].x += 9;
  }
  await touch.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  await expect(selected).toHaveCount(count);
  expect(await page.evaluate(() => [scrollX, scrollY, document.documentElement.scrollWidth])).toEqual([0, 0, 390]);
  expect(faults).toEqual([]);
  await page.close();
});

for (const [framework, folder, search] of [
  ['React, in strict mode', 'react', '?show=notes'],
  ['Vue', 'vue', ''],
] as const) {
  test(`${framework}: notes say which of them overlap, wherever they are moved, and a new one has room`, async ({
    page,
  }) => {
    const faults = await openExample(page, folder, search);
    const notes = page.locator('.note');
    await expect(notes).toHaveCount(5);
    /** What the page says of the notes, and what a test of every pair says. */
    const look = async () => {
      const boxes = await notes.evaluateAll((all) =>
        (all as HTMLElement[]).map(({ style }) => {
          const [x, y, width, height] = [style.left, style.top, style.width, style.height].map(Number.parseFloat);
          return [x, y, x + width, y + height];
        }),
      );
      const partners = boxes.map((box, id) => overlapping(boxes, box).filter((other) => other !== id).length);
      const marked = await notes.evaluateAll((all) => all.map((note) => note.classList.contains('touching')));
      expect(marked).toEqual(partners.map((number) => number > 0));
      const pairs = partners.reduce((sum, number) => sum + number, 0) / 2;
      await expect(page.getByRole('status')).toHaveText(pairs === 1 ? '1 pair overlaps' : `${pairs} pairs overlap`);
      return { boxes, pairs };
    };
    expect((await look()).pairs).toBe(1);

    const [first, third] = [(await notes.nth(0).boundingBox())!, (await notes.nth(2).boundingBox())!];
    await page.mouse.move(third.x + 5, third.y + 5);
    await page.mouse.down();
    await page.mouse.move(first.x + 15, first.y + 25, { steps: 4 });
    await page.mouse.up();
    expect((await look()).pairs).toBe(3);
    for (let press = 0; press < 20; press++) await notes.nth(2).press('ArrowRight');
    expect((await look()).pairs).toBe(1);

    await page.getByRole('button', { name: 'Add a note' }).click();
    await expect(notes).toHaveCount(6);
    const { boxes, pairs } = await look();
    expect(pairs).toBe(1);
    expect(overlapping(boxes, boxes[5])).toEqual([5]);
    await page.screenshot({ path: `test-results/screens/notes-${folder}.png` });
    expect(faults).toEqual([]);
  });
}

for (const [framework, folder, search] of [
  ['React', 'react', '?show=notes'],
  ['Vue', 'vue', ''],
] as const) {
  test(`${framework}: two fingers move two notes`, async ({ browser }) => {
    const page = await browser.newPage({ viewport: { width: 390, height: 780 }, hasTouch: true, isMobile: true });
    const faults = await openExample(page, folder, search);
    const notes = page.locator('.note');
    await expect(notes).toHaveCount(5);
    const places = async () => {
      const boxes = [(await notes.nth(0).boundingBox())!, (await notes.nth(3).boundingBox())!];
      return boxes.map(({ x, y }) => [x, y]);
    };
    const [[x, y], [u, v]] = await places();
    const touch = await page.context().newCDPSession(page);
    const fingers = (type: 'touchStart' | 'touchMove' | 'touchEnd', ...points: number[][]) =>
      touch.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    await fingers('touchStart', [x + 5, y + 5]);
    await fingers('touchStart', [x + 5, y + 5], [u + 5, v + 5]);
    await fingers('touchMove', [x + 15, y + 5], [u + 5, v + 5]);
    await fingers('touchMove', [x + 15, y + 5], [u + 5, v + 35]);
    await fingers('touchEnd');
    await expect.poll(places).toEqual([
      [x + 10, y],
      [u, v + 30],
    ]);
    expect(faults).toEqual([]);
    await page.close();
  });
}

test('React Flow: nodes come apart on the page of the example too', async ({ page }) => {
  test.slow();
  await page.emulateMedia({ reducedMotion: 'reduce' });
  const faults = await openExample(page, 'nodes-xyflow');
  await expect(page.locator('.react-flow__node')).toHaveCount(40);
  await page.getByRole('button', { name: 'Untangle' }).click();
  await expect(page.locator('p[role=status]')).toContainText('40 nodes', patient);
  await page.getByRole('button', { name: 'Untangle' }).click();
  await expect(page.locator('p[role=status]')).toContainText('none overlap', patient);
  expect(faults).toEqual([]);
});

test('d3-force: the chart, the words and the map each have their page', async ({ page }) => {
  test.slow();
  await page.emulateMedia({ reducedMotion: 'reduce' });
  const faults = await openExample(page, 'force-d3');
  await expect(page.locator('p[role=status]')).toContainText('300 rectangles', patient);
  for (const [show, says] of [
    ['cloud', '300 words'],
    ['map', '20,000 labels'],
  ]) {
    await page.goto(new URL(`?show=${show}`, page.url()).href);
    await expect(page.locator('p[role=status]')).toContainText(says, patient);
  }
  expect(faults).toEqual([]);
});
