// The chart of how times grow with the number of boxes: a line for each contender, with its name at its end. On a narrow
// page only ours and the best of the others are named. One line at a time is brought out, by pointing, or by the menu.
import * as Plot from '@observablehq/plot';
import { formatCount, formatMilliseconds } from '../shared/format.ts';
import { asPicture, marks, ms, others, ours, style, times } from './charts.ts';
import { fillMenu, make } from './elements.ts';
import { type Line, type Place, placeNames, roomFor, thin } from './names.ts';
import type { Curve } from './records.ts';

/** Narrower charts name few lines. */
const roomy = 560;
/** How many of the other contenders they name. */
const best = 2;
/** Names are cut to this length, so that lines keep most of the width. */
const longest = 19;
const [left, above, below] = [44, 26, 38];
/** Of the plot, without the names above it. */
const [least, most] = [230, 380];
/** The pointer is at a line if it is no further, in pixels. */
const reach = 28;
const hint = 'Point at a line, or choose it in the menu: then its times are here.';
const boldest = ['auto', 'set'];

const shortName = (name: string) => (name.length > longest ? `${name.slice(0, longest - 1)}…` : name);
const lastOf = ({ points }: Curve) => points[points.length - 1];

interface Layout {
  room: number;
  headroom: number;
  height: number;
  lines: Line[];
  places: Place[];
  ticks: number[];
  domain: { count: [number, number]; ms: [number, number] };
}

/** Ours, and on a narrow page only the best of the others: those that got furthest, then the fastest. */
function namedOf(curves: readonly Curve[], width: number): Set<string> {
  const rest = curves.filter(({ ours }) => !ours);
  if (width < roomy) {
    const further = (a: Curve, b: Curve) => lastOf(b).count - lastOf(a).count || lastOf(a).ms - lastOf(b).ms;
    rest.sort(further).splice(best);
  }
  return new Set([...curves.filter(({ ours }) => ours), ...rest].map(({ name }) => name));
}

function layOut(curves: readonly Curve[], width: number): Layout {
  const counts = [...new Set(curves.flatMap(({ points }) => points.map(({ count }) => count)))].sort((a, b) => a - b);
  const all = curves.flatMap(({ points }) => points.map((point) => point.ms));
  const domain: Layout['domain'] = {
    count: [counts[0], counts[counts.length - 1]],
    ms: [Math.min(...all), Math.max(...all)],
  };
  const share = (value: number, [from, to]: [number, number]) => Math.log(value / from) / Math.log(to / from);
  const named = namedOf(curves, width);
  const ends = curves
    .filter(({ name }) => named.has(name))
    .map((curve) => ({ name: shortName(curve.name), share: share(lastOf(curve).count, domain.count) }));
  const room = Math.ceil(roomFor(ends, width - left));
  const height = Math.max(least, Math.min(most, 0.5 * width));
  const x = (count: number) => left + (width - left - room) * share(count, domain.count);
  const y = (time: number) => height * (1 - share(time, domain.ms));
  const lines = curves.map(({ name, points }) => ({
    name: shortName(name),
    points: points.map((point) => [x(point.count), y(point.ms)] as const),
  }));
  const places = placeNames(lines, new Set([...named].map(shortName)), height);
  const headroom = Math.max(0, ...places.map((place) => 7 - place.y));
  const ticks = thin(counts.map((value) => ({ value, label: formatCount(value), x: x(value) })));
  return { room, headroom, height, lines, places, ticks, domain };
}

function draw(curves: readonly Curve[], width: number, layout: Layout): SVGSVGElement {
  const points = curves.flatMap(({ name, ours, points }) => points.map((point) => ({ name, ours, ...point })));
  const colour = (point: { ours: boolean }) => (point.ours ? ours : others);
  const { headroom, height, room, ticks, domain } = layout;
  const chart = Plot.plot({
    width,
    height: above + headroom + height + below,
    marginTop: above + headroom,
    marginLeft: left,
    marginRight: room,
    marginBottom: below,
    style,
    x: { type: 'log', axis: null, domain: domain.count },
    y: { type: 'log', axis: null, domain: domain.ms },
    marks: [
      Plot.gridX(ticks),
      Plot.gridY(marks(...domain.ms)),
      Plot.axisY(marks(...domain.ms), { text: ms, tickSize: 0, label: null }),
      // With a text of their own all marks are named: an axis on its own leaves out those between powers of ten.
      Plot.axisX(ticks, {
        text: formatCount,
        label: 'boxes',
        labelAnchor: 'center',
        labelArrow: 'none',
      }),
      Plot.line(points, {
        x: 'count',
        y: 'ms',
        z: 'name',
        stroke: colour,
        strokeWidth: (point) => (boldest.includes(point.name) ? 3 : 1.4),
      }),
      Plot.dot(points, {
        x: 'count',
        y: 'ms',
        r: 2.5,
        fill: colour,
        title: ({ name, ms, count }) => `${name}: ${formatMilliseconds(ms)} ms with ${formatCount(count)} boxes`,
      }),
    ],
  });
  return chart as SVGSVGElement; // without a title or legends, Plot returns nothing around it
}

const svg = (name: string, attributes: Record<string, string | number>, text = '') => {
  const made = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, `${value}`);
  made.textContent = text;
  return made;
};

/** The name of a line, with a leader from its end if it stands elsewhere. */
function nameAt({ name, x, y, end, leader }: Place, className: string): SVGElement {
  const made = svg('g', { class: `name ${className}` });
  if (leader) made.append(svg('path', { d: `M${end[0] + 5},${end[1]}L${x - 4},${y}` }));
  made.append(svg('text', { x, y, dy: '0.34em' }, name));
  return made;
}

/** Where a name stands that is shown only while its line is brought out: above its end, inside the chart. */
function passing({ name, points }: Line): Place {
  const end = points[points.length - 1];
  return { name, x: end[0], y: end[1] - 14, end, leader: false };
}

/** The distance of a point from a line, in pixels. */
function distance({ points }: Line, x: number, y: number): number {
  let found = Number.POSITIVE_INFINITY;
  for (let k = 1; k < points.length; k++) {
    const [[x0, y0], [x1, y1]] = [points[k - 1], points[k]];
    const along = ((x - x0) * (x1 - x0) + (y - y0) * (y1 - y0)) / ((x1 - x0) ** 2 + (y1 - y0) ** 2 || 1);
    const t = Math.min(1, Math.max(0, along));
    found = Math.min(found, Math.hypot(x - x0 - t * (x1 - x0), y - y0 - t * (y1 - y0)));
  }
  return found;
}

/** The names and lines of a chart by the contender's place in the list. */
function addNames(chart: Element, curves: readonly Curve[], { lines, places, headroom }: Layout): SVGElement[][] {
  const paths = [...chart.querySelectorAll<SVGElement>('g[aria-label="line"] path')];
  const dots = [...chart.querySelectorAll<SVGElement>('g[aria-label="dot"] circle')];
  const names = svg('g', { class: 'names', transform: `translate(0,${above + headroom})` });
  names.append(svg('text', { x: 0, y: -12, 'text-anchor': 'start' }, 'ms a frame, logarithmic'));
  chart.append(names);
  return curves.map(({ ours, points }, k) => {
    const place = places.find(({ name }) => name === lines[k].name);
    const name = nameAt(place ?? passing(lines[k]), `${ours ? 'ours' : ''} ${place ? '' : 'passing'}`);
    names.append(name);
    const mine = [paths[k], ...dots.splice(0, points.length), name];
    for (const piece of mine) piece.classList.add('piece', ...(ours ? ['ours'] : []));
    return mine;
  });
}

/** What is known of a contender, in a sentence. */
function inWords({ name, points }: Curve, curves: readonly Curve[]): string {
  const [first, last] = [points[0], points[points.length - 1]];
  const us = curves.find((each) => boldest.includes(each.name));
  const ours = us?.points.find(({ count }) => count === last.count);
  const ratio = us && ours && us.name !== name ? `, ${times(last.ms / ours.ms)} the time of ${us.name}` : '';
  const at = ({ ms, count }: { ms: number; count: number }) =>
    `${formatMilliseconds(ms)} ms with ${formatCount(count)}`;
  return `${name}: ${at(first)} boxes, ${at(last)}${ratio}.`;
}

/**
 * The chart, and a sentence about the line that the pointer or the menu brings out.
 * @param label the chart in words
 */
export function growth(
  curves: readonly Curve[],
  width: number,
  label: string,
  menu: HTMLSelectElement,
): readonly HTMLElement[] {
  const layout = layOut(curves, width);
  const chart = draw(curves, width, layout);
  const pieces = addNames(chart, curves, layout);
  asPicture(chart, label);
  const said = make('p', { className: 'aside said', role: 'status' });
  const place = make('div', { className: 'growth' });
  place.append(chart);

  const bringOut = (name: string) => {
    const chosen = curves.findIndex((curve) => curve.name === name);
    place.toggleAttribute('data-chosen', chosen >= 0);
    pieces.forEach((mine, k) => {
      for (const piece of mine) piece.classList.toggle('chosen', k === chosen);
    });
    for (const piece of pieces[chosen] ?? []) piece.parentNode?.append(piece); // above the other lines
    const text = chosen < 0 ? hint : inWords(curves[chosen], curves);
    if (said.textContent !== text) said.textContent = text;
  };
  const under = ({ clientX, clientY }: MouseEvent): string => {
    const box = chart.getBoundingClientRect();
    const [x, y] = [clientX - box.left, clientY - box.top - above - layout.headroom];
    const away = layout.lines.map((line) => distance(line, x, y));
    const nearest = away.indexOf(Math.min(...away));
    return away[nearest] <= reach ? curves[nearest].name : '';
  };
  chart.addEventListener('pointermove', (event) => {
    if (event.pointerType === 'mouse') bringOut(under(event) || menu.value);
  });
  chart.addEventListener('pointerleave', () => bringOut(menu.value));
  chart.addEventListener('click', (event) => {
    const found = under(event);
    menu.value = found === menu.value ? '' : found;
    bringOut(menu.value);
  });
  const names = curves.map(({ name }) => [name, name] as const).sort(([a], [b]) => a.localeCompare(b));
  fillMenu(menu, [['', 'none'], ...names], '');
  menu.onchange = () => bringOut(menu.value);
  bringOut(menu.value);
  return [place, said];
}
