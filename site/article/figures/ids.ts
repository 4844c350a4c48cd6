// Fig. 13: adding an entity to a world, one operation at a time. Entities come and go; numbers are never reused.
import { Entity, World } from 'broadphase/ro';
import worldSource from '../../../src/ro/world.ts?raw';
import { prefersStill } from '../kit/attend.ts';
import { button, columns, counters, createStepper, element, excerpt, listing, row, sayer } from '../kit/index.ts';
import { type AddingOperation, recordAdding } from '../record.ts';

/** What is told: of adding an entity, or that it was taken out. */
type Step = AddingOperation | 'out';

const most = 8;
const pace = 450;
const lights: Readonly<Record<Step, string | null>> = {
  asked: 'if (entity.world !== null)',
  aabb: 'entity.updateAABB()',
  id: 'entity._roId = this.uniq',
  technique: 'this.#broadPhase.addEntity',
  uniq: 'this.uniq++',
  world: 'entity.world = this',
  done: 'this.#entities.add(',
  out: null,
};

const words: Readonly<Record<Step, (id: number, next: number) => string>> = {
  asked: () => 'Is it in a world already? No: it may be added.',
  aabb: () => 'Its AABB is updated.',
  id: (id) => `It gets the next number: ${id}.`,
  technique: (id) => `The technique is notified of entity ${id}.`,
  uniq: (id) => `The next number is raised to ${id + 1}.`,
  world: (id) => `Entity ${id} remembers which world it is in.`,
  done: (id) => `Entity ${id} is in the list. That is all.`,
  out: (id, next) => `Entity ${id} is gone. Its number is not reused; the next entity gets ${next}.`,
};

export function mount(root: HTMLElement): () => void {
  const world = new World(null);
  const [left, right] = columns(root);
  const source = listing(left, 'ro/world.ts', excerpt(worldSource, 'addEntity(entity: E): void {'));

  const chips = element('ul', { class: 'chips', 'aria-label': 'The entities of the world' });
  right.append(chips);
  const say = sayer(right);
  const count = counters(right, { entities: 'Entities', uniq: 'The next number (uniq)' });
  const tools = row(right);

  /** @param numbered whether the entity being added already has its number */
  const show = (adding?: Entity, numbered = true) => {
    const entities = world.entities.map((entity) => {
      const unnumbered = entity === adding && !numbered;
      const name = unnumbered ? '–' : String(entity._roId);
      const chip = element('button', { type: 'button', 'aria-label': `Take out entity ${name}` }, name);
      chip.disabled = entity === adding;
      chip.addEventListener('click', () => takeOut(entity));
      return element('li', entity === adding ? { 'data-now': true } : {}, chip);
    });
    chips.replaceChildren(...entities);
    count({ entities: world.entities.length, uniq: world.uniq });
    add.disabled = world.entities.length >= most;
  };

  const takeOut = (entity: Entity) => {
    world.removeEntity(entity);
    current = { entity, steps: ['out'] }; // no way back into adding an entity that may be gone
    stepper.load(current.steps);
    add.focus();
  };

  const begin = (): { entity: Entity; steps: Step[] } => {
    const entity = new Entity(0, 0, 10, 10);
    return { entity, steps: recordAdding(world, entity) };
  };

  let current = begin();

  const add = button(tools, 'Add an entity', () => {
    current = begin();
    stepper.load(current.steps);
    if (!prefersStill()) stepper.play();
  });
  add.classList.add('main');

  const stepper = createStepper(root, {
    steps: current.steps,
    pace,
    show(operation, index) {
      const { entity, steps } = current;
      source.light(lights[operation]);
      say(words[operation](entity._roId, world.uniq));
      if (operation === 'out') return show();
      const isLast = index === steps.length - 1;
      show(isLast ? undefined : entity, index >= steps.indexOf('id'));
      count({
        entities: world.entities.length - (isLast ? 0 : 1),
        uniq: index >= steps.indexOf('uniq') ? entity._roId + 1 : entity._roId,
      });
    },
  });
  return () => stepper.stop();
}
