// The reference of the library's API, made by typedoc from the doc comments, as pages under api/. A public name
// without a comment, or a broken link, is an error. In development it is made at the first visit.
import { existsSync } from 'node:fs';
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import { extname } from 'node:path';
import { fileURLToPath } from 'node:url';
import {
  Application,
  Converter,
  type DeclarationReflection,
  JSX,
  PageEvent,
  type ProjectReflection,
  ReflectionKind,
  type TranslatedString,
} from 'typedoc';
import type { Plugin } from 'vite';
import { navigation } from './frame.ts';
import { writeTexts } from './llms.ts';
import { groups } from './names.ts';
import { groupMembers, orderMembers, tellOptions, writeLanding } from './reference.ts';

const path = (file: string) => fileURLToPath(new URL(file, import.meta.url));
const kinds: Record<string, string> = {
  '.html': 'text/html',
  '.css': 'text/css',
  '.js': 'text/javascript',
  '.svg': 'image/svg+xml',
  '.txt': 'text/plain; charset=utf-8',
};

/** Functions, methods and classes without an example. Those documented elsewhere need none. */
const withoutExample = (project: ProjectReflection): string[] =>
  project
    .getReflectionsByKind(ReflectionKind.Class | ReflectionKind.Function | ReflectionKind.Method)
    .filter(
      (each): each is DeclarationReflection => each.isDeclaration() && !each.parent?.kindOf(ReflectionKind.Interface),
    )
    .filter(
      (each) =>
        !each.inheritedFrom && !each.overwrites && !each.implementationOf?.reflection && !each.name.startsWith('['),
    )
    .filter((each) => !(each.signatures ?? [each]).some(({ comment }) => comment?.getTag('@example')))
    .map((each) => each.getFullName());

/** Writes the reference into the folder api/ in this one, and beside it the texts for programs. */
async function writeReference(folder: string): Promise<void> {
  const customCss = path('../../build/api.css');
  const styles = [path('../shared/frame.css'), path('api.css')];
  await writeFile(customCss, (await Promise.all(styles.map((file) => readFile(file, 'utf8')))).join('\n'));
  const app = await Application.bootstrapWithPlugins({
    options: path('../../typedoc.json'),
    tsconfig: path('../../tsconfig.json'),
    customCss,
    customJs: path('api-keys.js'),
    categoryOrder: groups.map(({ title }) => title),
    favicon: path('../public/logo.svg'),
  });
  app.renderer.hooks.on('body.begin', ({ page }) =>
    JSX.createElement(JSX.Raw, { html: navigation(`api/${page.url}`) }),
  );
  app.renderer.hooks.on('content.begin', () => JSX.createElement(JSX.Raw, { html: '<main>' }));
  app.renderer.hooks.on('content.end', () => JSX.createElement(JSX.Raw, { html: '</main>' }));
  app.renderer.on(PageEvent.END, (page) => {
    page.contents = page
      .contents!.replace('</title>', ' · broadphase</title>')
      .replace('"Documentation for API"', '"The API of broadphase, which finds the boxes that overlap."');
  });
  let ungrouped: string[] = [];
  app.converter.on(Converter.EVENT_RESOLVE_BEGIN, ({ project }) => {
    ungrouped = groupMembers(project);
  });
  const project = await app.convert();
  if (project) {
    app.validate(project);
    for (const name of ungrouped)
      app.logger.validationWarning(
        `README.md: its table of the API and BroadPhase differ in ${name}` as TranslatedString,
      );
    for (const name of withoutExample(project))
      app.logger.validationWarning(`${name} has no example` as TranslatedString);
  }
  if (!project || app.logger.hasErrors() || app.logger.hasWarnings()) {
    throw new Error('the API reference is not complete: see the warnings above');
  }
  await mkdir(folder, { recursive: true });
  await writeTexts(project, folder);
  orderMembers(project);
  tellOptions(project);
  writeLanding(project);
  await app.generateDocs(project, `${folder}/api`);
}

/** Two plugins, since Vite calls `closeBundle` in development too, when the server closes. */
const built: Plugin = {
  name: 'api',
  apply: 'build',
  async closeBundle() {
    await writeReference(path('../dist'));
  },
};

const served: Plugin = {
  name: 'api-in-development',
  apply: 'serve',
  configureServer(server) {
    const folder = path('../../build/reference');
    let written: Promise<void> | undefined;
    server.middlewares.use(async (request, response, next) => {
      const { pathname } = new URL(request.url!, 'http://site');
      if (!/^\/(api\/|llms(-full)?\.txt$)/.test(pathname)) return next();
      try {
        written ??= writeReference(folder);
        await written;
        const file = folder + (pathname.endsWith('/') ? `${pathname}index.html` : pathname);
        if (!existsSync(file)) return next();
        response.setHeader('Content-Type', kinds[extname(file)] ?? 'application/octet-stream');
        response.end(await readFile(file));
      } catch (error) {
        next(error);
      }
    });
  },
};

export const api = [built, served];
