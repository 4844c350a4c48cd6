// The report of `broadphase tune`: one self-contained HTML page with plots as inline SVG. It loads nothing, and has a
// content security policy that forbids loading.
import type { Candidate, Parameter, Tuned } from 'broadphase/trace';
import { isLean, timesNoise } from '../trace/tune.ts';
import { mostOf } from './extremes.ts';
import { barPlot, htmlText, linePlot } from './plots.ts';
import { number, percent, time } from './terminal.ts';

const style = `
:root { color-scheme: light dark; --page: #fbfbfa; --text: #17181b; --muted: #5d6067; --line: #e3e3df; --code: #f3f3f0;
  --c0: #3f5bd9; --c1: #b4540a; --c2: #0b7d5c; --c3: #a2379e; --c4: #5d6067; --c5: #b02a37; }
@media (prefers-color-scheme: dark) { :root { --page: #101113; --text: #eeeef0; --muted: #a3a6ae; --line: #2a2c31;
  --code: #191b1e; --c0: #93a6ff; --c1: #f0a35e; --c2: #5cc9a3; --c3: #e38fdf; --c4: #a3a6ae; --c5: #f28b94; } }
body { margin: 0 auto; max-width: 60rem; padding: 2rem 1rem; background: var(--page); color: var(--text);
  font: 1rem/1.55 system-ui, sans-serif; }
h1 { font-size: 1.6rem; line-height: 1.2; overflow-wrap: anywhere; } h2 { font-size: 1.1rem; margin: 2.5rem 0 0.5rem; }
pre { background: var(--code); padding: 1rem; overflow-x: auto; } p { max-width: 44rem; }
.wide { overflow-x: auto; } table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { text-align: right; padding: 0.3rem 0.8rem; border-bottom: 1px solid var(--line); white-space: nowrap; }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
svg { width: 100%; height: auto; min-width: 46rem; font: 12px system-ui, sans-serif; }
svg text { fill: var(--muted); } svg .at { fill: transparent; } svg .at:hover { fill: var(--text); opacity: 0.08; } svg .axis { stroke: var(--line); } svg .line { fill: none; stroke-width: 2; }
.legend { display: flex; flex-wrap: wrap; gap: 0.2rem 1.2rem; padding: 0; list-style: none; color: var(--muted); }
.legend i { display: inline-block; width: 1em; height: 0.2em; margin-right: 0.4em; vertical-align: middle; }
`;

/** The page, for a trace of this name. */
export function reportOf(name: string, dimensions: 2 | 3, tuned: Tuned): string {
  const { finalists, techniques, curves, frames, best, auto } = tuned;
  const rows = finalists.map(
    ({ ms, ...candidate }) =>
      `<tr><td>${htmlText(nameOf(candidate))}</td>${[ms.mean, ms.median, ms.p95, ms.max].map((each) => `<td>${time(each)}</td>`).join('')}</tr>`,
  );
  const boxes = mostOf(frames.map((frame) => frame.boxes));
  const shares = frames.slice(1).map(({ boxes, changed }) => (boxes === 0 ? 0 : changed / boxes));
  const moving = shares.reduce((sum, share) => sum + share, 0) / Math.max(1, shares.length);
  const perFrame = (values: readonly number[]) => values.map((y, k) => ({ x: frames[k].index, y }));
  const shown = best === auto ? [auto, ...finalists.filter((each) => each !== auto).slice(0, 2)] : [best, auto];
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${htmlText(name)} · broadphase tune</title>
<style>${style}</style>
</head>
<body>
<h1>${htmlText(name)}</h1>
<p>${dimensions}D, ${number(boxes)} boxes, ${number(frames.length)} frames measured, ${percent(moving)} of the boxes new or moved per frame.</p>
<p><strong>${htmlText(verdictOf(tuned)).replace(/`(\w+)`/g, '<code>$1</code>')}</strong></p>
<pre><code>${htmlText(tuned.code)}</code></pre>
<h2>The best against each other, on all frames</h2>
<p>Milliseconds of <code>update()</code>; for each frame the fastest of several passes.</p>
<div class="wide"><table><thead><tr><th>setting</th><th>mean</th><th>median</th><th>95 %</th><th>worst</th></tr></thead>
<tbody>${rows.join('\n')}</tbody></table></div>
<h2>Each technique in its best setting, on a few frames</h2>
${barPlot(
  techniques.map((each) => ({ name: nameOf(each), value: each.ms })),
  'milliseconds per update, logarithmic',
)}
${curvesOf(curves, 'cellSize', 'Cell size', 'side of a cell')}
${curvesOf(curves, 'margin', 'Margin', 'margin')}
<h2>Frame by frame</h2>
<p>Point at a place to see its numbers.</p>
${linePlot(
  shown.map((each) => ({ name: nameOf(each), points: perFrame(each.times) })),
  { x: 'frame', y: 'milliseconds' },
)}
${linePlot([{ name: 'pairs', points: perFrame(frames.map(({ pairs }) => pairs)) }], { x: 'frame', y: 'pairs' })}
</body>
</html>
`;
}

/** The cost of each value of a parameter; empty if no technique uses it. */
function curvesOf(curves: Tuned['curves'], parameter: Parameter, title: string, x: string): string {
  const lines = curves
    .filter((curve) => curve.parameter === parameter)
    .map(({ technique, points }) => ({
      name: technique,
      points: points.map(({ value, ms }) => ({ x: value, y: ms })),
    }));
  if (lines.length === 0) return '';
  return `<h2>${title}</h2>\n${linePlot(lines, { x, y: 'milliseconds', logarithmic: true })}`;
}

/** A setting in a few words. */
export const nameOf = ({ technique, cellSize, margin }: Candidate): string =>
  technique +
  (cellSize === undefined ? '' : `, cells of ${cellSize}`) +
  (margin === undefined ? '' : `, margin of ${margin}`);

/** How much larger 'broadphase/all' is than 'broadphase', in kB, gzipped. */
export const moreOfAll = 18;

/** The recommendation, its gain, and its cost in download size. */
export function verdictOf({
  best,
  auto,
  finalists,
  margin,
  noise,
}: Pick<Tuned, 'best' | 'auto' | 'finalists' | 'margin' | 'noise'>): string {
  const [first] = finalists;
  const load = `'broadphase/all', ${moreOfAll} kB more to load`;
  if (best.technique === 'auto') {
    const saved = auto.ms.mean - first.ms.mean;
    const fine = `\`auto\` is fine: it takes ${time(auto.ms.mean)} ms a frame.`;
    if (saved <= 0) return `${fine} Nothing is faster.`;
    const other = `${nameOf(first)} took ${time(saved)} ms less`;
    if (saved <= timesNoise * noise * auto.ms.mean) {
      return `${fine} ${other}, which is noise: two runs of \`auto\` differ by ${percent(noise)}.`;
    }
    return `${fine} ${other}: not enough to justify ${isLean(first.technique) ? 'an option' : load}.`;
  }
  const saved = time(auto.ms.mean - best.ms.mean);
  const gain = `It takes ${time(best.ms.mean)} ms a frame, ${saved} less than \`auto\`: ${margin.toFixed(2)} times as fast.`;
  return `Recommended: ${nameOf(best)}. ${gain}${isLean(best.technique) ? '' : ` It is in ${load}.`}`;
}
