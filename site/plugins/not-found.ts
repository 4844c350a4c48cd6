// The page for an address that has none, 404.html, which static hosts show under any address. So it is the one page
// whose links start at the root of the site, which is the path of `homepage` in package.json. Vite's own servers answer
// with it too.
import { existsSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import type { IncomingMessage, ServerResponse } from 'node:http';
import type { Plugin } from 'vite';
import manifest from '../../package.json' with { type: 'json' };

const page = '/404.html';

/** Answers browsers that ask for a page which is not there; it runs after all that finds pages. */
const answer =
  (root: string, read: () => Promise<string>) =>
  async (request: IncomingMessage, response: ServerResponse, next: (error?: unknown) => void) => {
    const { pathname } = new URL(request.url!, 'http://site');
    const isThere = pathname.endsWith('.html') && existsSync(root + pathname);
    if (isThere || !request.headers.accept?.includes('text/html')) return next();
    try {
      const text = await read();
      response.writeHead(404, { 'Content-Type': 'text/html' }).end(text);
    } catch (error) {
      next(error);
    }
  };

export const notFound: Plugin = {
  name: 'not-found',
  transformIndexHtml: {
    order: 'post', // Vite resolves the relative links before
    handler: (_, { path, server }) => {
      const href = server ? '/' : new URL(manifest.homepage).pathname;
      return path === page ? [{ tag: 'base', attrs: { href }, injectTo: 'head-prepend' }] : [];
    },
  },
  configureServer: ({ config: { root }, middlewares, transformIndexHtml }) => {
    const read = async () => transformIndexHtml(page, await readFile(root + page, 'utf8'));
    return () => void middlewares.use(answer(root, read));
  },
  configurePreviewServer: ({ config: { build }, middlewares }) => {
    const read = () => readFile(build.outDir + page, 'utf8');
    return () => void middlewares.use(answer(build.outDir, read));
  },
};
