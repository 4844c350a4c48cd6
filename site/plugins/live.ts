// Examples with a page run on the site, above their code, as they are in their folders. A build puts them into live/;
// in development they are served from there. If the packages of the examples are not installed, there is only the
// code.
import { existsSync, readdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { build, createServer, type HttpServer, type Plugin, type ViteDevServer } from 'vite';
import manifest from '../../package.json' with { type: 'json' };
import { rootFrom } from './frame.ts';

const path = (file: string) => fileURLToPath(new URL(file, import.meta.url));
const examples = path('../../examples/');
const configFile = `${examples}vite.config.mjs`;

/** Has its own server, since it demonstrates a policy. */
const apart = ['csp'];
export const names = existsSync(`${examples}node_modules/vite`)
  ? readdirSync(examples).filter((name) => !apart.includes(name) && existsSync(`${examples}${name}/index.html`))
  : [];

/** How to get an example: its folder, and an editor that opens it, if the repository has a URL. */
export function waysTo(
  folder: string,
  { repository, version }: { repository: { url: string }; version: string },
): string {
  const address = repository.url.replace(/^git\+/, '').replace(/\.git$/, '');
  if (new URL(address).hostname.endsWith('.invalid')) return `Take the folder <code>${folder}</code>.`;
  const [, project] = /^https:\/\/github\.com\/(.*)$/.exec(address) ?? [];
  const tree = `tree/v${version}/${folder}`;
  const editor = project
    ? `, or <a href="https://stackblitz.com/github/${project}/${tree}">open it in an online editor</a>`
    : '';
  return `Take the folder <a href="${address}/${tree}"><code>${folder}</code></a>${editor}.`;
}

const frameOf = (name: string, page: string) => `
  <figure class="live">
    <iframe src="${rootFrom(page)}live/${name}/" title="The example ${name}, running"></iframe>
    <figcaption><a href="${rootFrom(page)}live/${name}/">Alone in the window</a>. ${waysTo(`examples/${name}`, manifest)}</figcaption>
  </figure>`;

/**
 * Within a page, an example leaves the visitor the page's scrolling: a finger that moves up or down, and the wheel until
 * the example has been clicked. A finger sideways, and two fingers, are the example's. Libraries set touch-action on
 * their canvas, hence the !important; what is dragged, as a note is, keeps its own.
 */
const framed: Plugin = {
  name: 'framed',
  transformIndexHtml: () => [
    {
      tag: 'style',
      children: `
        .framed .stage { touch-action: pan-y }
        .framed .stage canvas { touch-action: pan-y !important }`,
    },
    {
      tag: 'script',
      children: `
        if (parent !== window) {
          document.documentElement.classList.add('framed');
          const leave = (event) => event.ctrlKey || document.hasFocus() || event.stopImmediatePropagation();
          addEventListener('wheel', leave, { capture: true, passive: true });
        }`,
    },
  ],
};

let served: Promise<ViteDevServer> | undefined;

/** A second server, started with the first request for an example. It reports changes through the site's own server. */
const serve = (site: HttpServer) =>
  createServer({
    configFile,
    plugins: [framed],
    base: '/live/',
    cacheDir: path('../../build/live'),
    logLevel: 'warn',
    server: { middlewareMode: true, ws: { server: site } },
  });

export const live: Plugin = {
  name: 'live',
  transformIndexHtml: {
    order: 'pre',
    handler(html, { path }) {
      const page = path.replace(/^\//, '');
      const name = /^examples\/([^/]+)\/index\.html$/.exec(page)?.[1];
      if (!name || !names.includes(name)) return;
      // Below the name, and the description from package.json.
      return html.replace(/<\/h1>(<p>.*?<\/p>)?/, (above) => above + frameOf(name, page));
    },
  },
  configureServer({ middlewares, httpServer }) {
    if (names.length === 0 || !httpServer) return;
    middlewares.use((request, response, next) => {
      if (!request.url!.startsWith('/live/')) return next();
      served ??= serve(httpServer);
      served.then((server) => server.middlewares(request, response, next), next);
    });
    httpServer.on('close', () => void served?.then((server) => server.close()));
  },
  async writeBundle() {
    if (names.length === 0) return;
    const input = Object.fromEntries(names.map((name) => [name, `${examples}${name}/index.html`]));
    await build({
      configFile,
      plugins: [framed],
      base: './',
      logLevel: 'warn',
      build: {
        target: 'es2022',
        outDir: path('../dist/live'),
        emptyOutDir: true,
        chunkSizeWarningLimit: 1500, // Phaser
        rolldownOptions: { input },
      },
    });
  },
};
