// An example with a page, built and opened as its reader would have it. Skipped where the packages of the examples are
// not installed.
import { execFile } from 'node:child_process';
import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { type Page, test } from '@playwright/test';

const path = (file: string) => fileURLToPath(new URL(`../../${file}`, import.meta.url));

/** Builds examples/<folder> and opens it; gives the list that errors and failed requests will be in. */
export async function openExample(page: Page, folder: string, search = ''): Promise<string[]> {
  const installed = Boolean(process.env.CI) || existsSync(path('examples/node_modules/phaser'));
  test.skip(!installed, 'npm ci --prefix examples brings what it needs');
  const faults: string[] = [];
  page.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
  page.on('pageerror', (error) => faults.push(String(error)));
  page.on('requestfailed', (request) => faults.push(`${request.failure()?.errorText} ${request.url()}`));

  const outDir = path(`build/${folder}`);
  const vite = path('node_modules/vite/bin/vite.js');
  const given = ['--config', path('examples/vite.config.mjs'), '--outDir', outDir, '--emptyOutDir'];
  await promisify(execFile)(process.execPath, [vite, 'build', path(`examples/${folder}`), ...given]);
  await page.route('http://example.test/**', async (route) => {
    const { pathname } = new URL(route.request().url());
    await route.fulfill({ path: outDir + (pathname === '/' ? '/index.html' : pathname) });
  });
  await page.goto(`http://example.test/${search}`);
  return faults;
}
