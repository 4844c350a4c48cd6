// Fig. 17: three groups, and the questions between them that are asked.
import { ro } from 'broadphase/ro';
import { groups, type Question } from '../../demos/groups.ts';
import source from '../../demos/groups.ts?raw';
import { demoColumns } from '../demo.ts';
import { element, excerpt, listing } from '../kit/index.ts';
import { createStage } from '../stage.ts';

const questions: readonly (readonly [Question, label: string, asked: boolean])[] = [
  [['players', 'powerUps'], 'Players, power-ups', true],
  [['players', 'enemies'], 'Players, enemies', true],
  [['enemies', 'enemies'], 'Enemies, enemies', false],
  [['powerUps', 'enemies'], 'Power-ups, enemies', false],
];

export function mount(root: HTMLElement): () => void {
  const [left, right] = demoColumns(root);

  const stage = createStage(left, {
    width: 480,
    height: 360,
    build: (canvas, colors) => groups(ro, canvas, new ro.coltech.BroadPhase(), colors),
    counters: { found: 'Pairs asked for', all: 'Pairs in all' },
    count: ({ found, pairCount }) => ({ found: found.length, all: pairCount }),
    inWords: ({ found, pairCount, questions }) =>
      `Players in blue, power-ups in orange, enemies in grey. ${questions.size} questions are asked, and ` +
      `${found.length} pairs found, marked by lines, of ${pairCount} that overlap.`,
  });
  const choices = element('fieldset', { class: 'choice' }, element('legend', {}, 'Who cares about whom'));
  for (const [question, label, asked] of questions) {
    const input = element('input', { type: 'checkbox', checked: asked });
    input.addEventListener('change', () => {
      set(question, input.checked);
      stage.refresh();
    });
    set(question, asked);
    choices.append(element('label', {}, input, element('span', {}, label)));
  }
  stage.controls.before(choices);
  stage.refresh();

  listing(right, 'site/demos/groups.ts', excerpt(source, 'export function ask'));
  listing(right, 'site/demos/groups.ts', excerpt(source, 'handleCollisions(_dt, pairs)'));
  return stage.rest;

  function set(question: Question, asked: boolean): void {
    if (asked) stage.demo.questions.add(question);
    else stage.demo.questions.delete(question);
  }
}
