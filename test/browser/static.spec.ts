// The built site from a plain static file server, under any path: every page loads all it asks for, asks nobody else,
// and writes no error. The server knows nothing of the site: no headers of its own, no fallback.
import { createReadStream, existsSync, readdirSync, statSync } from 'node:fs';
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { expect, test } from '@playwright/test';

const site = fileURLToPath(new URL('../../site/dist', import.meta.url));
const types: Record<string, string> = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.svg': 'image/svg+xml',
  '.wasm': 'application/wasm',
  '.json': 'application/json',
};

/** Serves a folder under a path, as any file server does. */
async function serve(folder: string, base: string): Promise<Server> {
  const server = createServer((request, answer) => {
    const { pathname } = new URL(request.url!, 'http://localhost');
    const file = join(folder, decodeURIComponent(pathname.slice(base.length)));
    if (!pathname.startsWith(base) || !file.startsWith(folder) || !existsSync(file)) return answer.writeHead(404).end();
    if (!statSync(file).isDirectory()) {
      answer.writeHead(200, { 'Content-Type': types[extname(file)] ?? 'application/octet-stream' });
      return createReadStream(file).pipe(answer);
    }
    if (!pathname.endsWith('/')) return answer.writeHead(301, { Location: `${pathname}/` }).end();
    const index = join(file, 'index.html');
    if (!existsSync(index)) return answer.writeHead(404).end();
    answer.writeHead(200, { 'Content-Type': 'text/html' });
    return createReadStream(index).pipe(answer);
  });
  await new Promise<void>((listening) => server.listen(0, '127.0.0.1', listening));
  return server;
}

/**
 * Under the root, which most servers have, the reference is left out: it takes as long as all else. Under another path,
 * 404.html: its links start at the path of `homepage` in package.json.
 */
const isPage = (name: string, base: string) =>
  name.endsWith('.html') && !(base === '/' ? name.startsWith('api/') : name === '404.html');

for (const base of ['/', '/x/y/']) {
  test(`every page works from a static file server under ${base}, and every link leads somewhere`, async ({ page }) => {
    test.setTimeout(900_000); // a hundred pages, a dozen of which draw by WebGL in software
    const server = await serve(site, base);
    const origin = `http://127.0.0.1:${(server.address() as AddressInfo).port}`;
    const faults: string[] = [];
    page.on('console', (message) => message.type() === 'error' && faults.push(`${page.url()}: ${message.text()}`));
    page.on('pageerror', (error) => faults.push(`${page.url()}: ${error}`));
    page.on('requestfailed', (request) => {
      // What a page was still fetching when it was left.
      if (request.failure()?.errorText !== 'net::ERR_ABORTED') faults.push(`${page.url()}: ${request.url()} failed`);
    });
    page.on(
      'response',
      (response) => response.status() >= 400 && faults.push(`${response.status()} ${response.url()}`),
    );
    page.on('request', (request) => {
      const url = request.url();
      if (!/^(data|blob):/.test(url) && !url.startsWith(origin + base)) faults.push(`a request to ${url}`);
    });
    try {
      const pages = readdirSync(site, { recursive: true, encoding: 'utf8' }).filter((name) => isPage(name, base));
      expect(pages.length).toBeGreaterThan(30);
      const links = new Set<string>();
      await page.emulateMedia({ reducedMotion: 'reduce' });
      for (const file of pages) {
        const waitUntil = file.startsWith('api/') ? 'load' : 'networkidle'; // the reference only searches, when asked
        await page.goto(origin + base + file.replace(/(^|\/)index\.html$/, '$1'), { waitUntil });
        // What runs above the code of an example stands in a frame of a page that has a heading.
        if (!file.startsWith('live/')) await expect(page.locator('h1').first(), file).toBeVisible();
        const hrefs = await page
          .locator('a[href]')
          .evaluateAll((all) => (all as HTMLAnchorElement[]).map(({ href }) => href));
        for (const href of hrefs) if (href.startsWith(origin)) links.add(href.split(/[?#]/)[0]);
      }
      for (const link of links) {
        const { status } = await fetch(link);
        if (status !== 200) faults.push(`a link to ${link}: ${status}`);
      }
      expect(faults).toEqual([]);
    } finally {
      server.closeAllConnections();
      server.close();
    }
  });
}
