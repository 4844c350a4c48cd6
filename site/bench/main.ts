// The page of the benchmark: what bench/ has measured, drawn, and the same in the reader's own browser.
import { figuresOf } from '../../bench/report/page.mjs';
import { formatCount, formatMilliseconds } from '../shared/format.ts';
import { asPicture, heat, times } from './charts.ts';
import { allow, fillMenu, find, make, scrolling, table } from './elements.ts';
import { growth } from './growth.ts';
import { raceFigure } from './race-figure.ts';
import { advice, curves, ofKind, type Race, type Results, readResults, timed } from './records.ts';
import { setUpRun } from './run.ts';

/** Charts are no narrower, in pixels. */
const leastWidth = 280;
/** The number of boxes until the reader chooses another. */
const usualThings = '1000';

/** The results that are in the repository, by file. */
const files = import.meta.glob<string>('../../bench/results/*.json', { query: '?url', import: 'default', eager: true });

const menus = ['machine', 'things', 'moves', 'dimensions', 'count', 'growth-scene'] as const;
const [machine, things, moves, dimensions, count, scene] = menus.map((id) => find<HTMLSelectElement>(id));
const note = find('note');
/** By the machine's name. */
const known = new Map<string, Results>();

const nameOf = ({ machine, date }: Results) => `${machine.cpu}, ${date.slice(0, 10)}`;

/** The newest is shown first. */
function learn(results: Results, name = nameOf(results)): void {
  known.set(name, results);
  const sorted = [...known].sort(([, a], [, b]) => (a.date < b.date ? 1 : -1));
  fillMenu(
    machine,
    sorted.map(([each]) => [each, each]),
    sorted[0][0],
  );
}

const commandOf = ({ kind, name, count, dimensions }: Race) => {
  const size = kind === 'motions' ? ` --count ${count} --dimensions ${dimensions}` : count ? ` --count ${count}` : '';
  return `npm run bench -- --${kind} ${/\s/.test(name) ? `"${name}"` : name}${size}`;
};

const withTimes = (races: readonly Race[]) => races.filter((race) => timed(race).length > 0);

const numbersOf = (races: readonly Race[]) =>
  [...new Set(races.map((race) => race.count))]
    .sort((a, b) => a - b)
    .map((each) => [`${each}`, formatCount(each)] as const);

/** The races that the menus select, or would with another choice. */
const filtered = (races: readonly Race[], inDimensions = dimensions.value, number = count.value) =>
  races.filter(
    (race) =>
      (inDimensions === '' || race.dimensions === Number(inDimensions)) &&
      (number === '' || race.count === Number(number)),
  );

const isFrame = (number: string, what: string) => (race: Race) => race.name === what && `${race.count}` === number;

function show(): void {
  const results = known.get(machine.value);
  note.textContent = '';
  for (const id of ['scenes', 'growth', 'heat', 'motions', 'legend']) find(id).hidden = !results;
  if (!results) return;
  const objects = withTimes(ofKind(results, 'objects'));
  const scenes = withTimes(ofKind(results, 'scenes'));
  fillMenu(things, numbersOf(objects), usualThings);
  fillMenu(count, [['', 'any number'], ...numbersOf(scenes)], '100000');
  // Other results may lack what was chosen before; with one of the other menu they have it.
  if (!objects.some(isFrame(things.value, moves.value))) {
    moves.value = objects.find((race) => `${race.count}` === things.value)?.name ?? moves.value;
  }
  if (filtered(scenes).length === 0) dimensions.value = '';
  showFrame(objects);
  showScenes(scenes);
  const several = [...seriesOf(results)].filter(([, races]) => linesOf(races).length > 0).map(([name]) => name);
  find('growth').hidden = several.length === 0;
  fillMenu(
    scene,
    several.map((name) => [name, name]),
    several[0] ?? '',
  );
  showGrowth(results);
  showHeat(scenes);
  showMotions(results);
}

const textOf = ({ selectedOptions: [chosen] }: HTMLSelectElement) => chosen?.text ?? '';

/** Answers the reader's first question: how long does a frame of my game take? */
function showFrame(objects: readonly Race[]): void {
  const race = objects.find(isFrame(things.value, moves.value));
  const place = find('frame-chart');
  place.replaceChildren();
  const many = moves.value === '5 % move' ? ' if one in twenty moves' : ' if all move';
  const those = things.value ? ` with ${textOf(things)} things` : '';
  allow(things, (number) => objects.some(isFrame(number, moves.value)), `not measured${many}`);
  allow(moves, (what) => objects.some(isFrame(things.value, what)), `not measured${those}`);
  find('frame-answer').textContent = race
    ? answerOf(race)
    : 'These results have no whole frames. Choose others at “Measured on”.';
  if (race) place.append(raceFigure(race, Math.max(leastWidth, place.clientWidth), commandOf(race)));
}

function answerOf(race: Race): string {
  const ms = (found: { total: { median: number } }) => `${formatMilliseconds(found.total.median)} ms`;
  const of = (which: (peer: string) => boolean) => timed(race).find(({ peer, wrong }) => which(peer) && !wrong);
  const set = timed(race).find(({ name }) => name === 'set');
  const [hand, pack] = [of((peer) => peer === 'by hand'), of((peer) => !['by hand', 'broadphase'].includes(peer))];
  const parts = [
    set && `${ms(set)} with this library, each box given by set`,
    hand && `${ms(hand)} with the fastest code of your own, ${hand.name}`,
    pack && `${ms(pack)} with the fastest package, ${pack.name}`,
  ];
  return `${formatCount(race.count)} things: a whole frame takes ${parts.filter(Boolean).join('; ')}.`;
}

function showScenes(scenes: readonly Race[]): void {
  const races = filtered(scenes);
  const charts = find('charts');
  const columns = Math.max(1, Math.floor((charts.clientWidth + 24) / (480 + 24)));
  const width = Math.max(leastWidth, (charts.clientWidth - 24 * (columns - 1)) / columns);
  const boxes = count.value ? ` with ${textOf(count)} boxes` : '';
  allow(count, (number) => filtered(scenes, undefined, number).length > 0, `not measured in ${dimensions.value}D`);
  allow(dimensions, (each) => filtered(scenes, each).length > 0, `not measured${boxes}`);
  find('legend').hidden = races.length === 0;
  charts.replaceChildren(...races.map((race) => raceFigure(race, width, commandOf(race))));
  if (races.length === 0) charts.append('These results have no scenes. Choose others at “Measured on”.');
}

/** The rows of one name with different numbers of boxes. */
function seriesOf(results: Results): Map<string, Race[]> {
  const found = new Map<string, Race[]>();
  for (const race of [...withTimes(ofKind(results, 'objects')), ...withTimes(ofKind(results, 'scenes'))]) {
    const name = race.kind === 'objects' ? `a whole frame, ${race.name}` : race.name;
    if (race.kind === 'scenes' && race.numbers === 'double') continue;
    found.set(name, [...(found.get(name) ?? []), race]);
  }
  return found;
}

const linesOf = (races: readonly Race[]) => curves(races).filter(({ points }) => points.length > 1);

function showGrowth(results: Results): void {
  const lines = linesOf(seriesOf(results).get(scene.value) ?? []);
  const place = find('growth-chart');
  place.replaceChildren();
  if (lines.length === 0) return;
  const label = `Lines: the time of each contender on ${scene.value} against the number of boxes.`;
  const sorted = [...lines].sort((a, b) => a.exponent! - b.exponent!);
  place.append(
    ...growth(lines, Math.max(leastWidth, place.clientWidth), label, find<HTMLSelectElement>('growth-line')),
    make(
      'p',
      { className: 'aside' },
      'Time grows as the number of boxes to this power; the milliseconds are those with the most boxes.',
    ),
    scrolling(
      'How times grow',
      ['contender', 'power', 'boxes', 'ms'],
      sorted.map(({ name, exponent, points }) => [
        name,
        exponent!.toFixed(2),
        `${formatCount(points[0].count)} to ${formatCount(points.at(-1)!.count)}`,
        formatMilliseconds(points.at(-1)!.ms),
      ]),
    ),
  );
}

/** What to choose where the scenes that are chosen were measured with a few techniques only. */
function adviceToChoose(able: readonly Race[]): string {
  const here = filtered(able, dimensions.value, '');
  const counts = numbersOf(here).map(([, text]) => text);
  const choose = counts.length > 0 ? `${counts.join(' or ')} boxes` : '2D and 3D, and any number of boxes';
  return `The scenes chosen above were measured with a few techniques only. For all techniques, choose ${choose} at “Scene by scene”.`;
}

function showHeat(scenes: readonly Race[]): void {
  const able = scenes.filter((race) => race.numbers === 'float32' && timed(race).length > 4);
  const several = filtered(able);
  const place = find('heat-chart');
  find('heat').hidden = able.length === 0;
  place.hidden = several.length === 0;
  if (several.length === 0) {
    find('advice').textContent = adviceToChoose(able);
    return;
  }
  const chart = heat(several, Math.min(place.clientWidth, 900));
  asPicture(chart, 'A heat map; the table below says the same in words.');
  place.replaceChildren(chart);
  const rows = advice(several).map(({ technique, good, races, worst, where, scenes }) => [
    technique,
    `${good} of ${races}`,
    times(worst),
    where,
    scenes.slice(0, 4).join(', ') + (scenes.length > 4 ? ` and ${scenes.length - 4} more` : ''),
  ]);
  find('advice').replaceChildren(
    make('p', { className: 'aside' }, 'What that supports, for the scenes and numbers of boxes shown:'),
    scrolling('Advice', ['technique', 'best, or within 10 %', 'at worst', 'on', 'take it for scenes like'], rows),
  );
}

/** The tables that docs/figures.md has, and the goals. */
function showMotions(results: Results): void {
  const { titles, motions, goals } = figuresOf(results);
  find('motions').hidden = motions.length === 0;
  find('motions-table').replaceChildren(table(titles, motions));
  find('goals-table').replaceChildren(table(['goal', 'figure', 'met'], goals));
}

for (const menu of [machine, dimensions, count]) menu.addEventListener('change', show);
for (const menu of [things, moves]) {
  menu.addEventListener('change', () => showFrame(withTimes(ofKind(known.get(machine.value)!, 'objects'))));
}
scene.addEventListener('change', () => showGrowth(known.get(machine.value)!));

/** Why files of results could not be read. */
const unread: string[] = [];
const loaded = Promise.all(
  Object.values(files).map(async (url) => {
    try {
      const response = await fetch(url);
      if (!response.ok) throw new Error(`the server answered ${response.status}`);
      learn(readResults(await response.text()));
    } catch (error) {
      unread.push((error as Error).message);
    }
  }),
);

find<HTMLInputElement>('file').addEventListener('change', async ({ target }) => {
  const [file] = (target as HTMLInputElement).files ?? [];
  if (!file) return;
  await loaded; // so that it does not overwrite the message about the file
  try {
    learn(readResults(await file.text()), file.name);
    machine.value = file.name;
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
machine.selectedIndex = 0; // the newest, whichever file came first
show();
find('own').hidden = false; // not before, or it would move down as the charts come
if (unread.length > 0) note.textContent = `Results are missing: ${unread[0]}. Reload the page to try again.`;
else if (known.size === 0) note.textContent = 'No results are in the repository yet: npm run bench makes them.';
