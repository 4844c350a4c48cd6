// A map with a label at each of its points: drawn to their points, kept apart by forceBoxes.
import { forceSimulation, forceX, forceY } from 'd3-force';
import { forceBoxes } from './force-boxes.mjs';

const letter = 6.2;
const line = 13;
const [width, height] = [1200, 800];

const syllables = ['ka', 'lo', 'mi', 'ren', 'ta', 'bor', 'se', 'ul', 'ha', 'dri', 'no', 'vel'];

/** The same points each time, in clusters, so that there is something to part. */
export function points(count) {
  return Array.from({ length: count }, (_, k) => {
    const [cluster, turn] = [k % 9, k * 2.39996];
    const reach = 6 * Math.sqrt(k);
    const text = syllables[k % 12] + syllables[(k * 7) % 11] + (k % 3 ? syllables[(k * 5) % 12] : '');
    return {
      text: text[0].toUpperCase() + text.slice(1),
      pointX: 200 + 400 * (cluster % 3) + Math.cos(turn) * reach * 0.8,
      pointY: 130 + 270 * Math.floor(cluster / 3) + Math.sin(turn) * reach * 0.6,
    };
  });
}

export const sizeOf = ({ text }) => [letter * text.length, line];

/** Places the labels: each ends with its x and y, the middle of its box. */
export function placeLabels(count, ticks = 300) {
  const labels = points(count).map((point) => ({ ...point, x: point.pointX, y: point.pointY - line }));
  forceSimulation(labels)
    .force('x', forceX(({ pointX }) => pointX).strength(0.1))
    .force('y', forceY(({ pointY }) => pointY - line).strength(0.1))
    .force('boxes', forceBoxes(sizeOf).padding(1))
    .stop()
    .tick(ticks);
  return labels;
}

export function toSvg(labels) {
  const parts = labels.map(({ text, x, y, pointX, pointY }) =>
    [
      `<path d="M${pointX.toFixed(1)} ${pointY.toFixed(1)}L${x.toFixed(1)} ${y.toFixed(1)}"/>`,
      `<circle cx="${pointX.toFixed(1)}" cy="${pointY.toFixed(1)}" r="2"/>`,
      `<text x="${x.toFixed(1)}" y="${(y + 4).toFixed(1)}">${text}</text>`,
    ].join(''),
  );
  const style = 'text{font:11px sans-serif;text-anchor:middle}path{stroke:#bbb;fill:none}circle{fill:#3f5bd9}';
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}"><style>${style}</style>${parts.join('\n')}</svg>\n`;
}
