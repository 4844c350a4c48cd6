// The page of the benchmark: what bench/ has measured, drawn, and the same in the reader's own browser.
import { coherenceCells, coherenceVerdicts, type PlayedRow } from '../../bench/coherence-table.mjs';
import { formatCount } from '../shared/format.ts';
import { growth, heat, times } from './charts.ts';
import { fillMenu, find, make, table } from './elements.ts';
import { raceFigure } from './race-figure.ts';
import { advice, curves, type Race, type Results, readResults, timed } from './records.ts';
import { setUpRun } from './run.ts';

/** Charts are no narrower, in pixels. */
const leastWidth = 280;

/** The results that are in the repository, by file. */
const files = import.meta.glob<string>('../../bench/results/*.json', { query: '?url', import: 'default', eager: true });

const [machine, dimensions, count] = ['machine', 'dimensions', 'count'].map((id) => find<HTMLSelectElement>(id));
const [scene, note] = [find<HTMLSelectElement>('growth-scene'), find('note')];
/** By the machine's name: against others, and our techniques among themselves. */
const known = new Map<string, { all?: Results; techniques?: Results }>();

function learn(results: Results, name = nameOf(results)): void {
  if (results.coherence) {
    showCoherence(results, results.coherence);
    return;
  }
  const mine = known.get(name) ?? {};
  mine[results.everyTechnique ? 'techniques' : 'all'] = results;
  known.set(name, mine);
  fillMenu(
    machine,
    [...known.keys()].map((each) => [each, each]),
    name,
  );
}

const nameOf = ({ machine, date }: Results) => `${machine.cpu}, ${date.slice(0, 10)}`;

const commandOf = (race: Race, results: Results) =>
  `npm run bench -- --scenes ${race.scene}${race.count ? ` --n ${race.count}` : ''}${results.everyTechnique ? ' --techniques all' : ''}`;

/** Those that the menus let through. */
const filtered = (races: readonly Race[]) =>
  races.filter(
    (race) =>
      timed(race).length > 0 &&
      (dimensions.value === '' || race.dimensions === Number(dimensions.value)) &&
      (count.value === '' || race.count === Number(count.value)),
  );

function show(): void {
  const mine = known.get(machine.value);
  const shown = mine?.all ?? mine?.techniques;
  for (const id of ['growth', 'heat', 'legend']) find(id).hidden = !shown;
  if (!mine || !shown) return;
  const counts = [...new Set(shown.races.map((race) => race.count))].sort((a, b) => a - b);
  const usual = counts.includes(10_000) ? '10000' : '';
  fillMenu(count, [['', 'any number'], ...counts.map((each) => [`${each}`, formatCount(each)] as const)], usual);
  showRaces(filtered(shown.races), shown);

  const races = [...(mine.all?.races ?? []), ...(mine.techniques?.races ?? [])];
  const several = [...new Set(races.map((race) => race.scene))].filter((name) =>
    curves(races, name).some(({ points }) => points.length > 1),
  );
  find('growth').hidden = several.length === 0;
  fillMenu(
    scene,
    several.map((name) => [name, name]),
    'uniform2d',
  );
  showGrowth(shown.races);
  showHeat(filtered((mine.techniques ?? shown).races));
}

function showRaces(races: readonly Race[], results: Results): void {
  const charts = find('charts');
  const columns = Math.max(1, Math.floor((charts.clientWidth + 24) / (480 + 24)));
  const width = Math.max(leastWidth, (charts.clientWidth - 24 * (columns - 1)) / columns);
  charts.replaceChildren(...races.map((race) => raceFigure(race, width, commandOf(race, results))));
  note.textContent = races.length === 0 ? 'No scene of these results is of that kind.' : '';
}

function showGrowth(races: readonly Race[]): void {
  const lines = curves(races, scene.value).filter(({ points }) => points.length > 1);
  const place = find('growth-chart');
  place.replaceChildren();
  if (lines.length === 0) return;
  const chart = growth(lines, Math.max(leastWidth, place.clientWidth));
  chart.setAttribute('role', 'img');
  chart.setAttribute('aria-label', `Lines: the time of each contender on ${scene.value} against the number of boxes.`);
  const sorted = [...lines].sort((a, b) => a.exponent! - b.exponent!);
  place.append(
    chart,
    make('p', { className: 'aside' }, 'Time grows as the number of boxes to the power of:'),
    table(
      ['', 'power', 'from', 'to boxes'],
      sorted.map(({ name, exponent, points }) => [
        name,
        exponent!.toFixed(2),
        formatCount(points[0].count),
        formatCount(points.at(-1)!.count),
      ]),
    ),
  );
}

function showHeat(races: readonly Race[]): void {
  find('heat').hidden = races.length === 0;
  if (races.length === 0) return;
  const place = find('heat-chart');
  const chart = heat(races, Math.min(place.clientWidth, 900));
  chart.setAttribute('role', 'img');
  chart.setAttribute('aria-label', 'A heat map; the table below says the same in words.');
  place.replaceChildren(chart);
  const rows = advice(races).map(({ technique, good, races, worst, where, scenes }) => [
    technique,
    `${good} of ${races}`,
    times(worst),
    where,
    scenes.slice(0, 4).join(', ') + (scenes.length > 4 ? ` and ${scenes.length - 4} more` : ''),
  ]);
  find('advice').replaceChildren(
    make('p', { className: 'aside' }, 'What that supports, for the scenes and numbers of boxes shown:'),
    table(['technique', 'best, or within 10 %', 'at worst', 'on', 'take it for scenes like'], rows),
  );
}

/** The table and the goals that the command prints. */
function showCoherence(results: Results, rows: readonly PlayedRow[]): void {
  find('coherence').hidden = false;
  find('coherence-machine').textContent = nameOf(results);
  const { titles, rows: cells } = coherenceCells(rows);
  const plain = (text: string) => text.replaceAll('`', '');
  find('coherence-table').replaceChildren(table(titles.map(plain), cells));
  find('coherence-goals').replaceChildren(table(['goal', 'figure', 'met'], coherenceVerdicts(rows)));
}

for (const menu of [machine, dimensions, count]) menu.addEventListener('change', show);
scene.addEventListener('change', () => {
  const mine = known.get(machine.value);
  showGrowth((mine?.all ?? mine?.techniques)?.races ?? []);
});

const loaded = Promise.all(
  Object.values(files).map(async (url) => {
    const response = await fetch(url);
    if (response.ok) learn(readResults(await response.text()));
  }),
);

find<HTMLInputElement>('file').addEventListener('change', async ({ target }) => {
  const [file] = (target as HTMLInputElement).files ?? [];
  if (!file) return;
  await loaded; // what is said of the file must not be overwritten
  try {
    learn(readResults(await file.text()), `${file.name}`);
    if (known.has(file.name)) machine.value = file.name;
    show();
  } catch (error) {
    note.textContent = `${file.name} was not read: ${(error as Error).message}`;
  }
});

let width = innerWidth;
addEventListener('resize', () => {
  if (innerWidth === width) return;
  width = innerWidth;
  show();
});

setUpRun();
await loaded;
show();
if (known.size === 0) note.textContent = 'No results are in the repository yet: npm run bench -- --full makes them.';
