// Figures and rows as text.

export const short = (value) => (value === 0 ? '0' : value < 10 ? value.toPrecision(3) : value.toFixed(1));

export const whole = (value) => Math.round(value).toLocaleString('en');

export const times = (ratio) => (Number.isNaN(ratio) ? '–' : `${ratio.toFixed(2)}x`);

export const percent = (share) => `${Math.round(100 * share)} %`;

/** A table in Markdown; columns that begin with a number are aligned right. */
export function markdownTable(titles, rows) {
  const right = titles.map((_, column) => column > 0 && rows.every((cells) => !/^[^\d–-]/.test(cells[column] ?? '')));
  const line = (cells) => `| ${cells.join(' | ')} |`;
  return [line(titles), line(right.map((is) => (is ? '---:' : '---'))), ...rows.map(line)].join('\n');
}

/** A line of a table for the terminal, under its titles, to be printed before the others are known. */
export const textLine = (titles, cells) =>
  titles
    .map((title, column) => {
      const width = Math.max(title.length, 9);
      return column === 0 ? cells[column].padEnd(16) : cells[column].padStart(width);
    })
    .join('  ')
    .trimEnd();
