// Every page is a folder, and its links are relative. So the URL of a folder without a trailing slash redirects to the
// one with it, as on any file server. Vite would serve the page itself, and every link on it would be wrong.
import type { IncomingMessage, ServerResponse } from 'node:http';
import type { Plugin } from 'vite';

function toFolder(request: IncomingMessage, response: ServerResponse, next: () => void): void {
  const { pathname, search } = new URL(request.url!, 'http://site');
  const last = pathname.slice(pathname.lastIndexOf('/') + 1);
  const isFolder = last !== '' && !last.includes('.') && !/^\/(live\/)?(@|node_modules\/)/.test(pathname);
  // Two slashes at the start would lead to another host.
  if (isFolder && !pathname.startsWith('//')) response.writeHead(302, { Location: `${pathname}/${search}` }).end();
  else next();
}

export const addresses: Plugin = {
  name: 'addresses',
  configureServer: ({ middlewares }) => void middlewares.use(toFolder),
  configurePreviewServer: ({ middlewares }) => void middlewares.use(toFolder),
};
