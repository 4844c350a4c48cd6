// The lab's controls: their options, the choices in them, and which of them are shown.
import { BroadPhase, type TechniqueName } from 'broadphase';
import { find } from '../../shared/elements.ts';
import { sceneGroups } from '../catalog.ts';
import type { LabState, Layer } from '../state.ts';

export const sceneMenu = find<HTMLSelectElement>('scene');
export const techniqueMenu = find<HTMLSelectElement>('technique');
export const rateMenu = find<HTMLSelectElement>('rate');

/** Fills the menus and lists, and chooses what the state says. */
export function fillControls(state: LabState): void {
  for (const { title, scenes } of sceneGroups) {
    const group = document.createElement('optgroup');
    group.label = title;
    for (const [name, label] of scenes) group.append(new Option(label, name));
    sceneMenu.append(group);
  }
  const racers = state.race ?? BroadPhase.techniques;
  for (const name of BroadPhase.techniques) {
    techniqueMenu.add(new Option(name, name));
    const label = document.createElement('label');
    const box = Object.assign(document.createElement('input'), {
      type: 'checkbox',
      value: name,
      checked: racers.includes(name),
    });
    label.append(box, ` ${name}`);
    find('racer-list').append(label);
  }
  sceneMenu.value = state.scene;
  techniqueMenu.value = state.technique;
  for (const box of document.querySelectorAll<HTMLInputElement>('#layers input')) {
    box.checked = state.show.includes(box.value as Layer);
  }
}

const checkedIn = (list: string) =>
  Array.from(document.querySelectorAll<HTMLInputElement>(`#${list} input:checked`), ({ value }) => value);

export const racersChosen = () => checkedIn('racer-list') as TechniqueName[];
export const layersChosen = () => checkedIn('layers') as Layer[];

/** Shows the controls for watching, or for a race of that many, and the view with this id. */
export function arrange(racers: number | undefined, view: string): void {
  const racing = racers !== undefined;
  for (const id of ['flat', 'solid']) find(id).hidden = racing || view !== id;
  for (const id of ['race', 'racers', 'bars', 'race-note']) find(id).hidden = !racing;
  for (const id of ['technique-field', 'layers', 'charts', 'numbers']) find(id).hidden = racing;
  for (const button of document.querySelectorAll<HTMLElement>('.looking')) button.hidden = racing;
  find<HTMLButtonElement>('record').disabled = racing;
  for (const id of ['play', 'step']) find<HTMLButtonElement>(id).disabled = racers === 0;
  if (racing) find('cells').hidden = find('chosen').hidden = true;
  document.body.classList.toggle('racing', racing);
  find('race-mode').setAttribute('aria-pressed', String(racing));
}
