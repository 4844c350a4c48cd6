// Serves the page with a policy that allows its own files and nothing else:
//   npm i && npm start, then open the address it prints
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { fileURLToPath } from 'node:url';

export const policy = [
  "default-src 'none'",
  "script-src 'self' 'wasm-unsafe-eval'", // allows compiling WebAssembly; eval() of text stays forbidden
  "style-src 'self'",
  "connect-src 'self'", // for fetch of kernel.wasm
  "base-uri 'none'",
  "form-action 'none'",
  "frame-ancestors 'none'",
  "require-trusted-types-for 'script'",
].join('; ');

const library = fileURLToPath(new URL('./dist/', import.meta.resolve('broadphase/package.json')));
const here = (name) => fileURLToPath(new URL(name, import.meta.url));
const files = {
  '/': ['text/html', here('index.html')],
  '/main.js': ['text/javascript', here('main.js')],
  '/style.css': ['text/css', here('style.css')],
  '/broadphase/index.js': ['text/javascript', `${library}index.js`],
  '/broadphase/kernel.wasm': ['application/wasm', `${library}kernel.wasm`],
};

const server = createServer(async ({ url }, answer) => {
  const [type, path] = files[url] ?? [];
  if (!path) return answer.writeHead(404, { 'Content-Security-Policy': policy }).end();
  const headers = { 'Content-Type': type, 'Content-Security-Policy': policy, 'X-Content-Type-Options': 'nosniff' };
  answer.writeHead(200, headers).end(await readFile(path));
});
server.listen(Number(process.env.PORT ?? 0), '127.0.0.1', () =>
  console.log(`http://127.0.0.1:${server.address().port}/`),
);
