// What all pages have in common, in one place: the start of their head, and the navigation. A page says where they go,
// with the comments `<!-- head -->` and `<!-- navigation -->`; `<!-- repository -->` becomes a link to the source.
// Every URL is relative, so that the site works under any path.
import type { Plugin } from 'vite';
import manifest from '../../package.json' with { type: 'json' };

/** The sections of the navigation, by folder, in this order. */
const sections = {
  article: 'Article',
  lab: 'Lab',
  queries: 'Queries',
  showcases: 'Showcases',
  bench: 'Benchmark',
  guides: 'Guides',
  api: 'API',
  examples: 'Examples',
};

/** From a page, given by its path from the root of the site, back to that root. */
export const rootFrom = (path: string) => '../'.repeat(path.split('/').length - 1) || './';

export function head(path: string): string {
  const root = rootFrom(path);
  return `<meta charset="utf-8" />
    <meta name="viewport" content="width=device-width, initial-scale=1" />
    <meta name="color-scheme" content="light dark" />
    <meta name="theme-color" content="#fbfbfa" media="(prefers-color-scheme: light)" />
    <meta name="theme-color" content="#101113" media="(prefers-color-scheme: dark)" />
    <link rel="icon" href="${root}logo.svg" type="image/svg+xml" />
    <link rel="stylesheet" href="${root}shared/theme.css" />`;
}

export function navigation(path: string): string {
  const root = rootFrom(path);
  const [here] = path.split('/');
  const links = Object.entries(sections).map(([folder, name]) => {
    const current =
      path === `${folder}/index.html` ? ' aria-current="page"' : folder === here ? ' aria-current="true"' : '';
    return `<a href="${root}${folder}/"${current}>${name}</a>`;
  });
  return `<nav class="site-nav" aria-label="Site">
      <a class="home" href="${root}"${path === 'index.html' ? ' aria-current="page"' : ''}>
        <svg viewBox="0 0 32 32" width="24" height="24" aria-hidden="true">
          <rect class="back" x="3.5" y="3.5" width="17" height="17" rx="2.5" />
          <rect class="front" x="11.5" y="11.5" width="17" height="17" rx="2.5" />
          <rect class="shared" x="11.5" y="11.5" width="9" height="9" />
        </svg>
        broadphase
      </a>
      ${links.join('\n      ')}
    </nav>`;
}

/** The link to the source. While the URL in package.json is a placeholder, it leads to where the site came from. */
function source(): string {
  const address = manifest.repository.url.replace(/^git\+/, '').replace(/\.git$/, '');
  if (new URL(address).hostname.endsWith('.invalid')) {
    return 'source in <code>src/</code> and <code>kernel/</code> of the clone';
  }
  return `<a href="${address}">source</a>`;
}

export const frame: Plugin = {
  name: 'frame',
  transformIndexHtml: {
    order: 'pre', // so that Vite processes what the head names
    handler: (html, { path }) => {
      const page = path.replace(/^\//, '');
      return html
        .replace('<!-- head -->', head(page))
        .replace('<!-- navigation -->', navigation(page))
        .replace('<!-- repository -->', source());
    },
  },
};
