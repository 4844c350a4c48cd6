// npm run server: the page as HTML, boxes and pairs included, before any script runs in the browser. Node has no window
// size, but it has the whole library. PORT is 5174 unless the environment sets it.
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { createElement } from 'react';
import { renderToString } from 'react-dom/server';
import { createServer as createVite } from 'vite';

const server = createServer();
const vite = await createVite({ appType: 'custom', server: { middlewareMode: true, ws: { server } } });

async function page(url) {
  const template = await vite.transformIndexHtml(url, await readFile('index.html', 'utf8'));
  const { App } = await vite.ssrLoadModule('/app.jsx');
  const { search } = new URL(url, 'http://server');
  return template.replace('<!-- app -->', () => renderToString(createElement(App, { search })));
}

server.on('request', (request, response) =>
  vite.middlewares(request, response, async () => {
    try {
      const html = await page(request.url);
      response.writeHead(200, { 'Content-Type': 'text/html' }).end(html);
    } catch (error) {
      response.writeHead(500, { 'Content-Type': 'text/plain' }).end(error.stack);
    }
  }),
);
server.listen(Number(process.env.PORT ?? 5174), 'localhost', () =>
  console.log(`http://localhost:${server.address().port}/`),
);
