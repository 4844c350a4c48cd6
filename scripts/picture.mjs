// Makes docs/picture-light.gif and docs/picture-dark.gif, the animation in the README, from the first page: stepped
// frame by frame in Chromium, forward and back, so that the loop has no seam. Run `npm run build:site` first.
import { writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { chromium } from '@playwright/test';
import gifenc from 'gifenc';
import { preview } from 'vite';

const { applyPalette, GIFEncoder, quantize } = gifenc;
const path = (file) => fileURLToPath(new URL(`../${file}`, import.meta.url));
const [width, height] = [720, 400];
const frames = 32;
const delay = 50; // milliseconds
const colours = 63; // and one for unchanged pixels
const address = '?boxes=700&scene=uniform2d&renderer=canvas-2d';

const server = await preview({ root: path('site'), configFile: path('site/vite.config.ts'), logLevel: 'error' });
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium' });

for (const colorScheme of ['light', 'dark']) {
  const page = await browser.newPage({ viewport: { width: 1400, height: 700 }, colorScheme, reducedMotion: 'reduce' });
  await page.goto(server.resolvedUrls.local[0] + address);
  // Only the view, at the size of the picture: the page adapts its layout.
  await page.addStyleTag({
    content: `.stage { position: fixed; z-index: 9; top: 0; left: 0; width: ${width}px; height: ${height}px; border: 0 !important; background: var(--page) }
      .view { width: 100%; height: 100%; } .tools { display: none !important; }`,
  });
  for (let times = 0; times < 2; times++) await page.locator('#zoom-in').evaluate((button) => button.click());
  const pictures = [];
  for (let frame = 0; frame < frames; frame++) {
    await page.locator('#step').evaluate((button) => button.click());
    await page.waitForTimeout(60);
    const png = await page.screenshot({ clip: { x: 0, y: 0, width, height } });
    pictures.push(await pixelsOf(page, png));
  }
  const sample = [0, frames >> 1, frames - 1].flatMap((k) => [...pictures[k]]);
  const palette = quantize(Uint8ClampedArray.from(sample), colours);
  const gif = GIFEncoder();
  const back = pictures.slice(1, -1).reverse();
  const transparent = palette.push([0, 0, 0]) - 1;
  let before;
  for (const pixels of [...pictures, ...back]) {
    const indices = applyPalette(pixels, palette.slice(0, transparent));
    const changes = indices.map((index, at) => (index === before?.[at] ? transparent : index));
    const options = { palette: before ? undefined : palette, transparent: true, transparentIndex: transparent };
    gif.writeFrame(changes, width, height, { ...options, delay, dispose: 1 });
    before = indices;
  }
  gif.finish();
  const file = `docs/picture-${colorScheme}.gif`;
  writeFileSync(path(file), gif.bytes());
  console.log(`${file}: ${Math.round(gif.bytes().length / 1000)} kB`);
  await page.close();
}
await browser.close();
await server.close();

/** The pixels of a picture as RGBA, decoded by the browser. */
async function pixelsOf(page, png) {
  const base64 = await page.evaluate(async (source) => {
    const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${source}`)).blob());
    const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    let text = '';
    for (let k = 0; k < data.length; k += 4096) text += String.fromCharCode(...data.subarray(k, k + 4096));
    return btoa(text);
  }, png.toString('base64'));
  return new Uint8ClampedArray(Buffer.from(base64, 'base64'));
}
