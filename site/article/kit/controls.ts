// The controls of a figure: buttons, a choice of one among several, a slider, and a table of live counters.
import { element, uniqueId } from './dom.ts';

/** A row that wraps, for controls that belong together. */
export function row(root: HTMLElement, className = ''): HTMLElement {
  const made = element('div', { class: `row ${className}`.trim() });
  root.append(made);
  return made;
}

export function button(root: HTMLElement, label: string, pressed: () => void): HTMLButtonElement {
  const made = element('button', { type: 'button', class: 'button' }, label);
  made.addEventListener('click', pressed);
  root.append(made);
  return made;
}

/**
 * One of several, as radio buttons side by side. `chosen` is called when the reader chooses, not at the start.
 * @param options the value and the label of each
 */
export function choice<T extends string | number>(
  root: HTMLElement,
  legend: string,
  options: readonly (readonly [value: T, label: string])[],
  value: T,
  chosen: (value: T) => void,
): void {
  const name = uniqueId('choice');
  const group = element('fieldset', { class: 'choice' }, element('legend', {}, legend));
  for (const [each, label] of options) {
    const input = element('input', { type: 'radio', name, value: each, checked: each === value });
    input.addEventListener('change', () => chosen(each));
    group.append(element('label', {}, input, element('span', {}, label)));
  }
  root.append(group);
}

export interface Slider {
  value: number;
}

export interface SliderOptions {
  label: string;
  min: number;
  max: number;
  step?: number;
  value: number;
  /** The value in words, on the screen and for screen readers; by default the number itself. */
  format?(value: number): string;
  /** Called when the reader moves it, not at the start. */
  moved(value: number): void;
}

export function slider(root: HTMLElement, options: SliderOptions): Slider {
  const { label, min, max, step = 1, format = String, moved } = options;
  const id = uniqueId('slider');
  const input = element('input', { type: 'range', id, min, max, step, value: options.value });
  const shown = element('span', { class: 'aside' });
  const show = () => {
    const text = format(input.valueAsNumber);
    shown.textContent = text;
    input.setAttribute('aria-valuetext', text);
    input.style.setProperty('--filled', `${(100 * (input.valueAsNumber - min)) / (max - min)}%`);
  };
  input.addEventListener('input', () => {
    show();
    moved(input.valueAsNumber);
  });
  root.append(element('div', { class: 'field' }, element('label', { for: id }, label), shown, input));
  show();
  return {
    get value() {
      return input.valueAsNumber;
    },
    set value(value) {
      input.valueAsNumber = value;
      show();
    },
  };
}

/** Sets the counters with these names. It costs nothing if a text is the same. */
export type Counters = (values: Readonly<Record<string, string | number>>) => void;

/**
 * Live numbers with their names, as a description list.
 * @param names the key of each, and its name on the page
 */
export function counters(root: HTMLElement, names: Readonly<Record<string, string>>): Counters {
  const list = element('dl', { class: 'counters' });
  const places = new Map<string, { place: HTMLElement; text: string }>();
  for (const [name, title] of Object.entries(names)) {
    const place = element('dd', { 'data-counter': name }, '–');
    list.append(element('div', {}, element('dt', {}, title), place));
    places.set(name, { place, text: '–' });
  }
  root.append(list);
  return (values) => {
    for (const [name, value] of Object.entries(values)) {
      const at = places.get(name);
      if (!at) throw new Error(`no counter is called ${name}`);
      const text = typeof value === 'number' ? value.toLocaleString('en') : value;
      if (at.text === text) continue;
      at.text = text;
      at.place.textContent = text;
    }
  };
}

/** A line of text that says what is happening, read out when it changes, unless `quiet`. */
export function sayer(root: HTMLElement, quiet = false): (text: string) => void {
  const place = element('p', quiet ? { class: 'said' } : { class: 'said', role: 'status' });
  root.append(place);
  return (text) => {
    if (place.textContent !== text) place.textContent = text;
  };
}
