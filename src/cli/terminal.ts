// Terminal output: numbers, tables, histograms, and a progress bar if a person is watching.
import type { Bin } from '../trace/statistics.ts';
import type { Terminal } from './arguments.ts';
import { mostOf } from './extremes.ts';

/** Three or four digits, with thousands separators. */
export function number(value: number): string {
  const size = Math.abs(value);
  if (size >= 1e15 || (size > 0 && size < 1e-4)) return value.toExponential(2);
  const digits = size >= 100 || Number.isInteger(value) ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 4;
  return value.toLocaleString('en', { maximumFractionDigits: digits, minimumFractionDigits: size < 1 ? 0 : digits });
}

/** Milliseconds. */
export const time = (ms: number): string => ms.toFixed(ms < 1 ? 4 : ms < 100 ? 3 : 1);

export const percent = (share: number): string => `${(100 * share).toFixed(share > 0 && share < 0.01 ? 2 : 1)} %`;

export function bytes(count: number): string {
  const [unit, size] = count < 2 ** 20 ? ['kB', 1e3] : ['MB', 1e6];
  return `${number(count / size)} ${unit}`;
}

/** A count with its noun: 1 frame, 2 frames, 2 boxes. */
export const counted = (count: number, thing: string): string =>
  `${number(count)} ${thing}${count === 1 ? '' : thing.endsWith('x') ? 'es' : 's'}`;

/** With fewer columns than this, text is not wrapped. */
export const leastText = 24;

/** Terms and their meanings side by side, in lines of at most `columns` columns. */
export function list(entries: readonly (readonly [term: string, meaning: string])[], columns: number): string {
  const column = Math.max(...entries.map(([term]) => term.length)) + 4;
  const room = Math.max(leastText, columns - column);
  return entries
    .map(([term, meaning]) => `  ${term}`.padEnd(column) + wrap(meaning, room).join(`\n${' '.repeat(column)}`))
    .join('\n');
}

/** Wraps text between words, into lines of at most `columns` columns. */
export function wrap(text: string, columns: number): string[] {
  const lines: string[] = [];
  let line = '';
  for (const word of text.split(' ')) {
    if (line && line.length + 1 + word.length > columns) {
      lines.push(line);
      line = word;
    } else line = line ? `${line} ${word}` : word;
  }
  return [...lines, line];
}

const styles = { bold: [1, 22], red: [31, 39], green: [32, 39] } as const;

/** Text with colour on a terminal that has colours, and plain elsewhere. */
export function paint({ colour }: Pick<Terminal, 'colour'>, style: keyof typeof styles, text: string): string {
  const [on, off] = styles[style];
  return colour ? `\x1b[${on}m${text}\x1b[${off}m` : text;
}

/** An error message, in the form of all others. */
export function complain(terminal: Terminal, message: string): void {
  terminal.err(`broadphase: ${message}\n`);
}

const gap = 2;

/**
 * Rows under a head: the first column aligned left, the others right, the least important last. Columns that do not fit
 * the terminal are left out, and named. The best row, if any, has a colour.
 */
export function table(
  terminal: Terminal,
  head: readonly string[],
  rows: readonly (readonly string[])[],
  best?: number,
): string {
  const widths = head.map((title, k) => Math.max(title.length, mostOf(rows.map((row) => row[k].length))));
  let shown = 1;
  for (let wide = widths[0]; shown < head.length; shown++) {
    wide += gap + widths[shown];
    if (wide > terminal.tableColumns) break;
  }
  const line = (cells: readonly string[]) =>
    cells
      .slice(0, shown)
      .map((cell, k) => (k === 0 ? cell.padEnd(widths[k]) : cell.padStart(widths[k])))
      .join(' '.repeat(gap));
  const left = head.slice(shown);
  const note = left.length > 0 ? `not shown, as the terminal is too narrow: ${left.join(', ')}; --json has all\n` : '';
  return [
    paint(terminal, 'bold', line(head)),
    line(widths.map((width) => '─'.repeat(width))),
    ...rows.map((row, k) => (k === best ? paint(terminal, 'green', line(row)) : line(row))),
    note,
  ].join('\n');
}

const eighths = ['', '▏', '▎', '▍', '▌', '▋', '▊', '▉'];

/** A bar of whole and part blocks. */
function bar(share: number, width: number): string {
  const parts = Math.round(Math.min(1, share) * width * 8);
  return '█'.repeat(parts >> 3) + eighths[parts & 7];
}

export function histogram(bins: readonly Bin[], columns: number): string {
  const most = Math.max(1, ...bins.map(({ count }) => count));
  const labels = bins.map(({ from, to }) => (to === 0 ? '0' : `${number(from)} … ${number(to)}`));
  const left = Math.max(0, ...labels.map((label) => label.length));
  const right = number(most).length;
  const room = Math.max(10, Math.min(60, columns - left - right - 4));
  return bins
    .map(({ count }, k) => {
      const drawn = bar(count / most, room) || (count > 0 ? eighths[1] : '');
      return `  ${labels[k].padStart(left)}  ${number(count).padStart(right)} ${drawn}\n`;
    })
    .join('');
}

/** The shortest time between two drawings. */
const redrawEvery = 100;

/** The width of the progress bar, in columns. */
const barWidth = { least: 4, most: 30 };

/** A line on `err` that shows the progress, and is removed at the end. Shown only on a terminal. */
export function progressBar(terminal: Pick<Terminal, 'err' | 'interactive' | 'columns'>): {
  show(what: string, done: number, total: number): void;
  end(): void;
} {
  let drawn = -Infinity;
  return {
    show(what, done, total) {
      if (!terminal.interactive || performance.now() - drawn < redrawEvery) return;
      drawn = performance.now();
      const share = total > 0 ? done / total : 0;
      const text = ` ${percent(share)} ${what}`;
      // A line that is too long would be wrapped, and could then not be rewritten.
      const width = Math.min(barWidth.most, terminal.columns - 1 - text.length);
      const drawing = width < barWidth.least ? '' : bar(share, width).padEnd(width, '░');
      terminal.err(`\r\x1b[K${(drawing + text).slice(0, Math.max(0, terminal.columns - 1))}`);
    },
    end() {
      if (drawn > 0) terminal.err('\r\x1b[K');
    },
  };
}
