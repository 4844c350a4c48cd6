// A listing of real source, imported with `?raw`: the code shown is the code that runs. Lines are lit by their text.
import { element } from './dom.ts';

export interface Listing {
  /** Lights the first line that contains `text` (after `after`, when given), or no line for null. */
  light(text: string | null, after?: string): void;
}

/**
 * The part of a source from the first line that contains `start` to where its braces close again, without the
 * indentation they share.
 */
export function excerpt(source: string, start: string): string {
  const lines = source.split('\n');
  const first = lines.findIndex((line) => line.includes(start));
  if (first < 0) throw new Error(`the source has no line with ${start}`);
  let depth = 0;
  let last = first;
  for (; last < lines.length; last++) {
    for (const character of lines[last]) depth += character === '{' ? 1 : character === '}' ? -1 : 0;
    if (depth <= 0 && lines[last].includes('}')) break;
  }
  return dedent(lines.slice(first, last + 1));
}

/** The lines of a source from the first that contains `first` to the next that contains `last`. */
export function passage(source: string, first: string, last: string): string {
  const lines = source.split('\n');
  const from = lines.findIndex((line) => line.includes(first));
  const to = lines.findIndex((line, i) => i >= from && line.includes(last));
  if (from < 0 || to < 0) throw new Error(`the source has no lines from ${first} to ${last}`);
  return dedent(lines.slice(from, to + 1));
}

function dedent(lines: string[]): string {
  const indent = lines[0].search(/\S/);
  return lines.map((line) => line.slice(Math.min(indent, Math.max(0, line.search(/\S/))))).join('\n');
}

const tokens =
  /(\/\/.*|\/\*[\s\S]*?\*\/)|('(?:[^'\\]|\\.)*'|`(?:[^`\\]|\\.)*`)|\b(abstract|break|class|const|continue|else|export|extends|for|function|if|import|in|let|new|null|of|override|private|readonly|return|static|super|this|throw|true|false|type|undefined|while|yield|set|get|number|string|boolean|void)\b|\b(\d[\d_.e]*)\b/g;
const classes = ['comment', 'text', 'word', 'figure'];

/** The parts of a line of code, coloured. */
function paint(line: string): (Node | string)[] {
  const parts: (Node | string)[] = [];
  let at = 0;
  for (const match of line.matchAll(tokens)) {
    const kind = match.slice(1).findIndex((group) => group !== undefined);
    parts.push(line.slice(at, match.index), element('span', { class: `code-${classes[kind]}` }, match[0]));
    at = match.index + match[0].length;
  }
  parts.push(line.slice(at));
  return parts;
}

/** Shows code, with its origin as the title. */
export function listing(root: HTMLElement, title: string, code: string): Listing {
  const lines = code.split('\n');
  const shown = lines.map((line) => element('span', { class: 'code-line' }, ...paint(line), '\n'));
  const pre = element('pre', { tabindex: 0, 'aria-label': title }, element('code', {}, ...shown));
  root.append(element('div', { class: 'listing' }, element('p', { class: 'listing-title' }, title), pre));
  let lit: HTMLElement | undefined;

  return {
    light(text, after) {
      lit?.removeAttribute('data-lit');
      lit = undefined;
      if (text === null) return;
      const from = after === undefined ? 0 : lines.findIndex((line) => line.includes(after)) + 1;
      const index = lines.findIndex((line, i) => i >= from && line.includes(text));
      if (index < 0) throw new Error(`the listing has no line with ${text}`);
      lit = shown[index];
      lit.setAttribute('data-lit', '');
      // Only the listing scrolls, never the page.
      const top = lit.offsetTop;
      if (top < pre.scrollTop || top + 2 * lit.offsetHeight > pre.scrollTop + pre.clientHeight) {
        pre.scrollTop = top - pre.clientHeight / 2;
      }
    },
  };
}
