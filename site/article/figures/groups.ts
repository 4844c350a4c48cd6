// Fig. 17: three groups in one space, and which of them care about each other.
import { ro } from 'broadphase/ro';
import { demoColumns } from '../demo.ts';
import { groups, type Question } from '../demos/groups.ts';
import source from '../demos/groups.ts?raw';
import { element, excerpt, listing } from '../kit/index.ts';
import { createStage } from '../stage.ts';

const questions: readonly (readonly [Question, label: string])[] = [
  [['players', 'powerUps'], 'Players, power-ups'],
  [['players', 'enemies'], 'Players, enemies'],
  [['enemies', 'enemies'], 'Enemies, enemies'],
  [['powerUps', 'enemies'], 'Power-ups, enemies'],
];

export function mount(root: HTMLElement): () => void {
  const [left, right] = demoColumns(root);
  const coltech = new ro.coltech.BroadPhase();
  const asked = new Set(questions.slice(0, 2).map(([question]) => question));

  const stage = createStage(left, {
    width: 480,
    height: 360,
    build(canvas, colors) {
      const demo = groups(ro, canvas, coltech, colors);
      demo.ask(asked);
      return demo;
    },
    counters: { found: 'Pairs found', all: 'Without filter' },
    count: ({ countAll, pairCount }) => ({ found: pairCount, all: countAll() }),
    inWords: ({ countAll, pairCount }) =>
      `Players in blue, power-ups in orange, enemies in grey. ${asked.size} questions are asked, and ${pairCount} pairs ` +
      `found, marked by lines, of ${countAll()} that overlap.`,
  });
  const choices = element('fieldset', { class: 'choice' }, element('legend', {}, 'Who cares about whom'));
  for (const [question, label] of questions) {
    const input = element('input', { type: 'checkbox', checked: asked.has(question) });
    input.addEventListener('change', () => {
      if (input.checked) asked.add(question);
      else asked.delete(question);
      stage.demo.ask(asked);
      stage.refresh();
    });
    choices.append(element('label', {}, input, element('span', {}, label)));
  }
  stage.controls.before(choices);

  listing(right, 'site/article/demos/groups.ts', excerpt(source, 'function ask(questions'));
  listing(right, 'site/article/demos/groups.ts', excerpt(source, 'handleCollisions(_dt, pairs)'));
  return stage.rest;
}
