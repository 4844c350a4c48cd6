// The results of one scene as text, each contender against strip-sweep.

const short = (value) => (value < 10 ? value.toPrecision(3) : value.toFixed(1));

export function table({ scene, count, pairs, results }) {
  const base = results.find(({ name, figures }) => name === 'strip-sweep' && figures)?.figures.median;
  const rows = results.map(({ name, figures, problem }) => {
    if (!figures) return [name, problem];
    const ratio = base ? `${short(figures.median / base)}x` : '';
    const times = [figures.median, figures.mean, figures.p95, figures.worst].map(short);
    return [name, ...times, ratio, problem ?? ''];
  });
  const header = ['ms per frame', 'median', 'mean', 'p95', 'worst', 'ratio', ''];
  const widths = header.map((_, column) =>
    Math.max(...[header, ...rows.filter((row) => row.length > 2)].map((row) => row[column].length)),
  );
  widths[0] = Math.max(...[header, ...rows].map((row) => row[0].length));
  const lines = [header, ...rows].map((row) =>
    row
      .map((cell, column) =>
        column === 0 || row.length === 2 ? cell.padEnd(widths[column]) : cell.padStart(widths[column]),
      )
      .join('  ')
      .trimEnd(),
  );
  return [`${scene}: ${count.toLocaleString('en')} boxes, ${pairs.toLocaleString('en')} pairs`, ...lines].join('\n');
}
