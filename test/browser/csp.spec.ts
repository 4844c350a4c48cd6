// The example of a page with a strict content security policy works, without a violation; and where the policy forbids
// WebAssembly the library says what to allow.
import { spawn } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect, test } from '@playwright/test';
import { needExamples } from './example.ts';

const path = (file: string) => fileURLToPath(new URL(`../../${file}`, import.meta.url));

test('a page with a strict policy finds its pairs', async ({ page }) => {
  needExamples();
  const server = spawn(process.execPath, [path('examples/csp/serve.mjs')], { stdio: ['ignore', 'pipe', 'inherit'] });
  try {
    const address = await new Promise<string>((resolve, reject) => {
      server.stdout.on('data', (text) => resolve(String(text).trim()));
      server.on('exit', () => reject(new Error('the server of the example did not start: npm run build first')));
    });
    const faults: string[] = [];
    page.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
    page.on('pageerror', (error) => faults.push(String(error)));
    const answer = await page.goto(address);
    expect(answer!.headers()['content-security-policy']).toContain("default-src 'none'");
    await expect(page.locator('#pairs')).toHaveText('7, 9, 9, 11');
    expect(faults.filter((fault) => !fault.includes('favicon'))).toEqual([]);
    await page.screenshot({ path: 'test-results/screens/csp.png' });
  } finally {
    server.kill();
  }
});

test('where the policy forbids WebAssembly the error says what to allow', async ({ page }) => {
  await page.route('http://strict.test/**', (route) => {
    const { pathname } = new URL(route.request().url());
    const body =
      pathname === '/index.js' ? readFileSync(path('dist/index.js'), 'utf8') : '<!doctype html><title>strict</title>';
    return route.fulfill({
      body,
      contentType: pathname === '/index.js' ? 'text/javascript' : 'text/html',
      headers: { 'Content-Security-Policy': "default-src 'none'; script-src 'self'" },
    });
  });
  await page.goto('http://strict.test/');
  const message = await page.evaluate(async () => {
    const address = '/index.js';
    const { BroadPhase } = await import(address);
    try {
      new BroadPhase();
      return '';
    } catch (error) {
      return String(error);
    }
  });
  expect(message).toContain("allow 'wasm-unsafe-eval' or call init() with a compiled module");
});
