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

export function setUpRun(): void {
  const [scene, count] = [find<HTMLSelectElement>('run-scene'), find<HTMLSelectElement>('run-count')];
  const [start, save] = [find<HTMLButtonElement>('run-start'), find<HTMLButtonElement>('run-save')];
  const [progress, doing, result] = [find<HTMLProgressElement>('run-progress'), find('run-doing'), find('run-result')];
  const races: Race[] = [];
  let able: { box: HTMLInputElement; dimensions: readonly number[] }[] = [];
  let running = false;
  let worker = open();

  fillMenu(
    scene,
    sceneNames.map((name) => [name, name]),
    'uniform2d',
  );
  scene.addEventListener('change', enable);
  enable(); // a race needs the list of contenders first

  /** The worker first sends the list of contenders, since the page itself does not load the library. */
  function open(): Worker {
    const made = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module' });
    made.onmessage = ({ data }: MessageEvent<Answer>) => take(data);
    made.onerror = ({ message }) => end(`It failed: ${message}`);
    return made;
  }

  function take(answer: Answer): void {
    if ('contenders' in answer) {
      if (able.length > 0) return;
      able = answer.contenders.map(({ name, dimensions }) => ({
        box: make('input', { type: 'checkbox', value: name, checked: usual.includes(name) }),
        dimensions,
      }));
      find('run-names').replaceChildren(...able.map(({ box }) => make('label', {}, box, box.value)));
      enable();
    } else if ('progress' in answer) {
      progress.value = answer.progress;
      doing.textContent = answer.doing;
    } else if ('failed' in answer) {
      end(`It failed: ${answer.failed}`);
    } else {
      const { race } = answer;
      races.push(race);
      const command = `npm run bench -- --scenes ${race.name} --count ${race.count}`;
      result.replaceChildren(raceFigure(race, Math.min(mostWidth, find('run').clientWidth), command));
      save.hidden = false;
      end('Done. Run other scenes too, and save all together.');
    }
  }

  /** Some contenders are 2D only. */
  function enable(): void {
    const dimensions = scene.value.endsWith('3d') ? 3 : 2;
    for (const each of able) each.box.disabled = !each.dimensions.includes(dimensions);
    start.disabled = able.length === 0;
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
      worker.terminate();
      worker = open();
      return end('Stopped.');
    }
    const names = able.filter(({ box }) => box.checked && !box.disabled).map(({ box }) => box.value);
    if (names.length === 0) return end('Choose who takes part.');
    running = true;
    worker.postMessage({ scene: scene.value as SceneName, count: Number(count.value), names } satisfies Order);
    progress.hidden = false;
    progress.value = 0;
    start.textContent = 'Stop';
  });

  save.addEventListener('click', () => {
    const record: Results = {
      date: new Date().toISOString(),
      machine: { cpu: 'a browser', cores: navigator.hardwareConcurrency, system: navigator.userAgent },
      rows: races,
    };
    const link = make('a', {
      href: URL.createObjectURL(new Blob([JSON.stringify(record, undefined, 1)], { type: 'application/json' })),
      download: 'broadphase-benchmark.json',
    });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60_000); // some browsers read it only after the click
  });
}
