// For the page of showcases: replaces `<!-- source examples/… -->` by the text of that file, coloured.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import highlight from 'highlight.js';
import type { Plugin } from 'vite';

const repository = fileURLToPath(new URL('../..', import.meta.url));

export const sources: Plugin = {
  name: 'sources',
  transformIndexHtml: {
    order: 'pre',
    handler: (html) =>
      html.replace(/<!-- source (\S+) -->/g, (_, file: string) => {
        const code = readFileSync(repository + file, 'utf8').trimEnd();
        return highlight.highlight(code, { language: 'js' }).value;
      }),
  },
};
