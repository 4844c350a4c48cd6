// The benchmark in the reader's own browser: selects contenders and scenes, shows the worker's progress and results,
// and saves them as a file that this page can show again.
import { type SceneName, sceneNames } from '../../src/scenes/index.ts';
import { fillMenu, find, make } from './elements.ts';
import { raceFigure } from './race-figure.ts';
import type { Race, Results } from './records.ts';
import type { Answer, Order } from './worker.ts';

/** The contenders until the reader chooses others. */
const usual = ['auto', 'strip-sweep', 'aabb-tree', 'flatbush', 'rbush (load)', 'box-intersect', 'tutorial-grid'];

/** Of the chart, in pixels. */
const mostWidth = 704;

/** A contender that can be chosen, with the dimensions it can do: some are 2D only. */
interface Choice {
  box: HTMLInputElement;
  dimensions: readonly number[];
}

const choiceOf = ({ name, dimensions }: { name: string; dimensions: readonly number[] }): Choice => ({
  box: make('input', { type: 'checkbox', value: name, checked: usual.includes(name) }),
  dimensions,
});

const figureOf = (race: Race) => {
  const command = `npm run bench -- --scenes ${race.name} --count ${race.count}`;
  return raceFigure(race, Math.min(mostWidth, find('run').clientWidth), command);
};

/** Saves races as a file of results. */
function save(rows: Race[]): void {
  const record: Results = {
    date: new Date().toISOString(),
    machine: { cpu: 'a browser', cores: navigator.hardwareConcurrency, system: navigator.userAgent },
    rows,
  };
  const link = make('a', {
    href: URL.createObjectURL(new Blob([JSON.stringify(record, undefined, 1)], { type: 'application/json' })),
    download: 'broadphase-benchmark.json',
  });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000); // some browsers read it only after the click
}

/** Starts a worker. It first sends the list of contenders, since the page itself does not load the library. */
function startWorker(take: (answer: Answer) => void): Worker | undefined {
  try {
    const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module' });
    worker.onmessage = ({ data }: MessageEvent<Answer>) => take(data);
    worker.onerror = ({ message }) => take({ failed: message || 'its script could not be run' });
    return worker;
  } catch (error) {
    take({ failed: (error as Error).message }); // where workers are forbidden, the rest of the page still works
    return undefined;
  }
}

export function setUpRun(): void {
  const [scene, count] = [find<HTMLSelectElement>('run-scene'), find<HTMLSelectElement>('run-count')];
  const [start, saver] = [find<HTMLButtonElement>('run-start'), find<HTMLButtonElement>('run-save')];
  const [progress, doing, result] = [find<HTMLProgressElement>('run-progress'), find('run-doing'), find('run-result')];
  const races: Race[] = [];
  let choices: Choice[] = [];
  let running = false;
  let worker = startWorker(take);

  fillMenu(
    scene,
    sceneNames.map((name) => [name, name]),
    'uniform2d',
  );
  scene.addEventListener('change', enable);
  enable(); // a race needs the list of contenders first

  function take(answer: Answer): void {
    if ('contenders' in answer) {
      if (choices.length > 0) return;
      choices = answer.contenders.map(choiceOf);
      find('run-names').replaceChildren(...choices.map(({ box }) => make('label', {}, box, box.value)));
      enable();
    } else if ('progress' in answer) {
      progress.value = answer.progress;
      doing.textContent = answer.doing;
    } else if ('failed' in answer) {
      end(`It failed: ${answer.failed}`);
    } else {
      races.push(answer.race);
      result.replaceChildren(figureOf(answer.race));
      saver.hidden = false;
      end('Done. Run other scenes too, and save all together.');
    }
  }

  function enable(): void {
    const dimensions = scene.value.endsWith('3d') ? 3 : 2;
    for (const each of choices) each.box.disabled = !each.dimensions.includes(dimensions);
    start.disabled = choices.length === 0;
  }

  function end(message: string): void {
    running = false;
    progress.hidden = true;
    start.textContent = 'Run';
    doing.textContent = message;
  }

  find('run').addEventListener('submit', (event) => {
    event.preventDefault();
    if (running) {
      worker?.terminate();
      worker = startWorker(take);
      return end('Stopped.');
    }
    const names = choices.filter(({ box }) => box.checked && !box.disabled).map(({ box }) => box.value);
    if (names.length === 0) return end('Choose who takes part.');
    running = true;
    worker?.postMessage({ scene: scene.value as SceneName, count: Number(count.value), names } satisfies Order);
    progress.hidden = false;
    progress.value = 0;
    start.textContent = 'Stop';
  });

  saver.addEventListener('click', () => save(races));
}
