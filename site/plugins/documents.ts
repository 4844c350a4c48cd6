// Pages made from the repository's Markdown, so that each text has one source and reads well in both places: the guides
// and the other documents under guides/, and the examples with their source under examples/. A broken link is an error.
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { basename, posix } from 'node:path';
import { fileURLToPath } from 'node:url';
import highlight from 'highlight.js';
import MarkdownIt from 'markdown-it';
import type { Plugin } from 'vite';
import manifest from '../../package.json' with { type: 'json' };
import { rootFrom } from './frame.ts';
import { names as live, waysTo } from './live.ts';
import { addressOf } from './names.ts';

/** The text of an example, if it has one. */
const readme = 'README.md';
const repository = fileURLToPath(new URL('../..', import.meta.url));
const site = fileURLToPath(new URL('..', import.meta.url));

const guides = [
  'getting-started',
  'worth-it',
  'ids-and-ecs',
  'who-meets-whom',
  'moving-here',
  'choosing-a-technique',
  'static-worlds',
  'events',
  'queries',
  'drawing',
  'fixed-time-steps',
  'rollback',
  'shards',
  'performance',
  'troubleshooting',
];
const others = [
  'docs/command.md',
  'docs/trace-format.md',
  'docs/promises.md',
  'docs/figures.md',
  'docs/versioning.md',
  'ARCHITECTURE.md',
  'CHANGELOG.md',
];

/** The page of each Markdown file, by its path in the repository, in the order in which they are listed. */
const pages = new Map([
  ['docs/guides/README.md', 'guides/index.html'],
  ...[...guides.map((name) => `docs/guides/${name}.md`), ...others].map((file): [string, string] => [
    file,
    `guides/${basename(file, '.md').toLowerCase()}/index.html`,
  ]),
  ['examples/README.md', 'examples/index.html'],
]);

/** The folders of examples, each a page with its source. */
const folders = new Map(
  ['examples', 'examples/apart']
    .flatMap((at) => readdirSync(repository + at, { withFileTypes: true }).map((entry) => ({ at, entry })))
    .filter(({ entry }) => entry.isDirectory() && !['apart', 'node_modules', 'test'].includes(entry.name))
    .map(({ at, entry: { name } }) => [`${at}/${name}`, `examples/${name}/index.html`]),
);

const paragraph = new MarkdownIt();
const read = (file: string) => readFileSync(repository + file, 'utf8');
const titleOf = (markdown: string) => /^# (.*)$/m.exec(markdown)![1].replaceAll('`', '');
const slugOf = (heading: string) =>
  heading
    .toLowerCase()
    .replace(/[^\p{L}\p{N} _-]/gu, '')
    .replaceAll(' ', '-');

/** The sentences of the first paragraph of a text, without marks. */
function opening(markdown: string): string {
  const tokens = paragraph.parse(markdown, {});
  const { children } = tokens[tokens.findIndex(({ type, level }) => type === 'paragraph_open' && level === 0) + 1];
  const text = children!.map(({ type, content }) => (type === 'softbreak' ? ' ' : content)).join('');
  return text.slice(0, text.lastIndexOf('.') + 1);
}

/** What each guide is about, by its file: as the list of guides says it. */
const about = new Map(
  [...read('docs/guides/README.md').matchAll(/^- \[(.*)\]\((.*)\): (.*)$/gm)].map(
    ([, title, file, text]): [string, string] => [
      `docs/guides/${file}`,
      `${title}${title.endsWith('?') ? '' : '.'} ${text[0].toUpperCase()}${text.slice(1).replaceAll('`', '')}.`,
    ],
  ),
);

/** A page in a sentence or two, for those who meet it as a link. */
function descriptionOf(file: string): string {
  const manifestOf = `${file}/package.json`;
  if (existsSync(repository + manifestOf)) return JSON.parse(read(manifestOf)).description;
  if (!folders.has(file)) return about.get(file) ?? opening(read(file));
  const text = `${file}/${readme}`;
  return existsSync(repository + text) ? opening(read(text)) : `The code of ${file}, file by file.`;
}

/** Where a link of a file leads, as seen from its page; undefined for a file of the repository that has no page. */
function linkFrom(file: string, page: string, href: string): string | undefined {
  if (/^(https?:|#)/.test(href)) return href;
  const [path, anchor] = posix.join(posix.dirname(file), href).split('#');
  const target = path.replace(/\/$/, '');
  const folder = [...folders.keys()].find((name) => target.startsWith(`${name}/`));
  const to = pages.get(target) ?? folders.get(target) ?? (folder && folders.get(folder));
  if (!to && existsSync(repository + target)) return undefined;
  if (!to) throw new Error(`${file} links to ${href}, which is not there`);
  const hash = anchor ?? (to === folders.get(folder ?? '') ? slugOf(basename(target)) : undefined);
  return rootFrom(page) + to.replace('index.html', '') + (hash ? `#${hash}` : '');
}

const paint = (code: string, language: string) =>
  highlight.getLanguage(language) ? highlight.highlight(code, { language }).value : '';

/** Links the first mention of each API name in the text of a page to the reference. */
function linkNames(markdown: MarkdownIt, page: string): void {
  markdown.core.ruler.push('names', ({ tokens }) => {
    const linked = new Set<string>();
    tokens.forEach(({ type, children }, k) => {
      if (type !== 'inline' || tokens[k - 1].type === 'heading_open') return;
      let depth = 0; // inside a link
      for (const child of children!) {
        if (child.type === 'link_open') depth++;
        if (child.type === 'link_close') depth--;
        const address = child.type === 'code_inline' && depth === 0 ? addressOf(child.content) : undefined;
        if (!address || linked.has(address)) continue;
        linked.add(address);
        child.type = 'html_inline';
        child.content = `<a href="${rootFrom(page)}api/${address}"><code>${child.content}</code></a>`;
      }
    });
  });
}

function render(file: string, page: string): string {
  const markdown = new MarkdownIt({ html: true, highlight: (code, language) => paint(code, language) });
  if (file.startsWith('docs/')) linkNames(markdown, page);
  const { rules } = markdown.renderer;
  rules.heading_open = (tokens, k) => {
    const { tag } = tokens[k];
    return tag === 'h1' ? '<h1>' : `<${tag} id="${slugOf(tokens[k + 1].content)}">`;
  };
  // A scrollable element must be reachable by keyboard.
  rules.table_open = () => '<div class="scroll" tabindex="0" role="group" aria-label="A table"><table>';
  rules.table_close = () => '</table></div>';
  rules.image = () => ''; // the showcases page has them live
  const { fence } = rules;
  rules.fence = (...given) => fence!(...given).replace('<pre>', '<pre tabindex="0">');
  rules.link_open = (tokens, k, options, _, self) => {
    const href = linkFrom(file, page, tokens[k].attrGet('href')!);
    if (href) tokens[k].attrSet('href', href);
    else tokens[k].attrs = null;
    return self.renderToken(tokens, k, options);
  };
  return markdown.render(read(file));
}

const isIndex = (name: string) => name.startsWith('index.');

/** The text of an example and its source, file by file: the first is the one to begin with. */
function source(folder: string, page: string): string {
  const files = readdirSync(repository + folder)
    .filter((name) => name !== readme && name !== 'package-lock.json')
    .sort((a, b) => Number(isIndex(b)) - Number(isIndex(a)) || (a < b ? -1 : 1));
  const listings = files.flatMap((name) => {
    const language = name.split('.').pop()!.replace('mjs', 'js').replace('vue', 'xml');
    if (!highlight.getLanguage(language)) return [];
    return `<h2 id="${slugOf(name)}">${name}</h2>
      <pre tabindex="0"><code>${paint(read(`${folder}/${name}`), language)}</code></pre>`;
  });
  const has = (name: string) => existsSync(`${repository}${folder}/${name}`);
  const { description = '' } = has('package.json') ? JSON.parse(read(`${folder}/package.json`)) : {};
  const start = has(readme)
    ? render(`${folder}/${readme}`, page)
    : `<h1>${basename(folder)}</h1><p>${paragraph.renderInline(description)}</p>`;
  // An example that runs on its page says so there.
  const ways = has('package.json') && !live.includes(basename(folder)) ? `${waysTo(folder, manifest)} ` : '';
  return `${start}<p>${ways}<a href="../">All examples</a></p>${listings.join('')}`;
}

/** The documents under guides/: their files, and from a page of them the address and the title of each. */
const listed = [...pages].filter(([, path]) => path.startsWith('guides/'));
const nameOf = (file: string, path: string) => (path === 'guides/index.html' ? 'All guides' : titleOf(read(file)));
const linkTo = (page: string, [file, path]: [string, string], attributes = '') =>
  `<a href="${rootFrom(page)}${path.replace('index.html', '')}"${attributes}>${nameOf(file, path)}</a>`;

/** The list beside a document, or below it where there is no room: it is in both places, and one of them is hidden. */
function listing(page: string, place: 'left' | 'below'): string {
  const links = listed.map((each) => `<li>${linkTo(page, each, each[1] === page ? ' aria-current="page"' : '')}</li>`);
  return `<nav class="documents ${place}" aria-label="Guides"><ul>${links.join('')}</ul></nav>`;
}

/** The links to the previous and next document, below one. */
function beside(page: string): string {
  const at = listed.findIndex(([, path]) => path === page);
  const [before, after] = [listed[at - 1], listed[at + 1]];
  const previous = before ? `<span>Previous ${linkTo(page, before, ' rel="prev"')}</span>` : '';
  const next = after ? `<span class="next">Next ${linkTo(page, after, ' rel="next"')}</span>` : '';
  return `<nav class="beside" aria-label="Previous and next">${previous}${next}</nav>`;
}

/** All texts, in order: the list of guides, the README, the guides, and the documents beside them. */
export const texts = [listed[0][0], 'README.md', ...listed.slice(1).map(([file]) => file)].map((file) => {
  const address = pages.get(file)?.replace('index.html', '') ?? '';
  return { file: basename(file), address, title: titleOf(read(file)), text: read(file) };
});

function documentOf(page: string): string {
  const [file] = [...pages, ...folders].find(([, path]) => path === page)!;
  const isGuide = page.startsWith('guides/');
  const title = folders.has(file) ? `${basename(file)}, an example` : titleOf(read(file));
  const body = folders.has(file) ? source(file, page) : render(file, page);
  return `<!doctype html>
<html lang="en">
  <head>
    <!-- head -->
    <title>${title} · broadphase</title>
    <meta name="description" content="${paragraph.utils.escapeHtml(descriptionOf(file))}" />
    <link rel="stylesheet" href="${rootFrom(page)}shared/documents.css" />
    <script type="module" src="${rootFrom(page)}shared/copy.ts"></script>
  </head>
  <body>
    <!-- navigation -->
    <div class="page">
      ${isGuide ? listing(page, 'left') : ''}
      <main class="document">${body}${isGuide ? beside(page) : ''}</main>
      ${isGuide ? listing(page, 'below') : ''}
    </div>
  </body>
</html>`;
}

const addresses = [...pages.values(), ...folders.values()];

export const documents: Plugin = {
  name: 'documents',
  enforce: 'pre',
  config: () => ({
    build: { rolldownOptions: { input: Object.fromEntries(addresses.map((page) => [page, site + page])) } },
  }),
  resolveId: (id) => (addresses.some((page) => id === site + page) ? id : undefined),
  load: (id) => {
    const page = addresses.find((address) => id === site + address);
    return page && documentOf(page);
  },
  configureServer(server) {
    server.middlewares.use(async (request, response, next) => {
      const page = `${new URL(request.url!, 'http://site').pathname.slice(1)}index.html`;
      if (!addresses.includes(page)) return next();
      try {
        response.setHeader('Content-Type', 'text/html');
        response.end(await server.transformIndexHtml(`/${page}`, documentOf(page)));
      } catch (error) {
        next(error);
      }
    });
  },
};
