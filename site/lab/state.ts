// The state of the lab in the URL: what a link to it shows. Every value is checked before it is used; an invalid one is
// reported and keeps its default. So no URL can ask for more than the controls of the page can.
import { BroadPhase, type TechniqueName } from 'broadphase';
import { fewestBoxes, isScene, isTrace, mostBoxes } from './catalog.ts';

export const layers = ['structure', 'pairs', 'heat'] as const;
export type Layer = (typeof layers)[number];

/** Frames per second: as many as the display shows, or fewer. */
export const rates = ['60', '10', '2'] as const;
export type Rate = (typeof rates)[number];

export interface LabState {
  scene: string;
  boxes: number;
  technique: TechniqueName;
  /** The side of a cell; undefined: the library chooses. */
  cell: number | undefined;
  show: readonly Layer[];
  rate: Rate;
  /** The frame at which it is paused; undefined while it plays. */
  frame: number | undefined;
  /** 2D: the centre of the view in shares of the world, and the zoom. 3D: where the eye is, and what it looks at. */
  view: readonly number[] | undefined;
  /** The id of the box that was clicked. */
  box: number | undefined;
  /** The techniques that race, perhaps none; undefined: no race. */
  race: readonly TechniqueName[] | undefined;
}

export const defaults: LabState = {
  scene: 'uniform2d',
  boxes: 5000,
  technique: 'auto',
  cell: undefined,
  show: ['structure'],
  rate: '60',
  frame: undefined,
  view: undefined,
  box: undefined,
  race: undefined,
};

/** To reach a frame of the URL, all frames before it are made: at most this many moves of boxes. */
const mostMoves = 1e8;
const mostId = 2 ** 24 - 1;
const farthestView = 1000;
/** A longer value in the URL is not a state of the lab. */
const longestValue = 400;

export const latestFrame = (boxes: number): number => Math.floor(mostMoves / boxes);

export interface ReadState {
  state: LabState;
  /** Messages about invalid values in the URL. */
  faults: string[];
}

/** Reads the query string of a URL. */
export function readState(query: string): ReadState {
  const given = new URLSearchParams(query);
  const faults: string[] = [];
  /** The value of a name, if there is one and `read` accepts it. */
  const take = <T>(name: string, expected: string, read: (text: string) => T | undefined): T | undefined => {
    const text = given.get(name);
    if (text === null) return undefined;
    const value = text.length > longestValue ? undefined : read(text);
    if (value === undefined) {
      const shown = text.length > 30 ? `${text.slice(0, 30)}…` : text;
      faults.push(`${name} is ‘${shown}’, expected ${expected}`);
    }
    return value;
  };
  const wholeNumber = (name: string, least: number, most: number) =>
    take(name, `a whole number from ${least} to ${most}`, (text) => {
      const value = /^\d{1,9}$/.test(text) ? Number(text) : Number.NaN;
      return value >= least && value <= most ? value : undefined;
    });
  const oneOf = <T extends string>(name: string, known: readonly T[]) =>
    take(name, `one of ${known.join(', ')}`, (text) => known.find((each) => each === text));
  const someOf = <T extends string>(name: string, known: readonly T[]) =>
    take(name, `some of ${known.join(', ')}`, (text) => {
      const names = text === '' ? [] : text.split(',');
      return names.every((each) => known.includes(each as T))
        ? known.filter((each) => names.includes(each))
        : undefined;
    });

  const scene = take('scene', 'a scene of the menu', (text) => (isScene(text) ? text : undefined)) ?? defaults.scene;
  const boxes = wholeNumber('boxes', fewestBoxes, mostBoxes) ?? defaults.boxes;
  const cell = take('cell', 'a number above 0', (text) => {
    const value = /^[\d.e+-]{1,24}$/.test(text) ? Number(text) : Number.NaN;
    return value > 0 && value < Infinity ? value : undefined;
  });
  const view = take('view', '3 numbers (2D) or 6 (3D)', (text) => {
    const numbers = text.split(',').map((part) => (/^-?[\d.]{1,20}$/.test(part) ? Number(part) : Number.NaN));
    const good = numbers.every((value) => Math.abs(value) <= farthestView);
    return good && (numbers.length === 3 || numbers.length === 6) ? numbers : undefined;
  });
  const state: LabState = {
    scene,
    boxes,
    cell,
    view,
    technique: oneOf('technique', BroadPhase.techniques) ?? defaults.technique,
    show: someOf('show', layers) ?? defaults.show,
    rate: oneOf('rate', rates) ?? (isTrace(scene) ? '10' : defaults.rate),
    frame: wholeNumber('frame', 0, latestFrame(boxes)),
    box: wholeNumber('box', 0, mostId),
    race: someOf('race', BroadPhase.techniques),
  };
  return { state, faults };
}

/** A number, as short as possible for the same picture. */
const short = (value: number) => String(Number(value.toPrecision(5)));

/** The query string of a URL that shows this state. Defaults are left out. */
export function writeState(state: LabState): string {
  const given = new URLSearchParams();
  if (isScene(state.scene)) given.set('scene', state.scene); // a file of the user's cannot be in a link
  if (!isTrace(state.scene)) given.set('boxes', String(state.boxes));
  given.set('technique', state.technique);
  if (state.cell !== undefined) given.set('cell', String(state.cell));
  if (state.show.join() !== defaults.show.join()) given.set('show', state.show.join());
  if (state.rate !== (isTrace(state.scene) ? '10' : defaults.rate)) given.set('rate', state.rate);
  if (state.frame !== undefined && state.frame <= latestFrame(state.boxes)) given.set('frame', String(state.frame));
  if (state.view) given.set('view', state.view.map(short).join());
  if (state.box !== undefined) given.set('box', String(state.box));
  if (state.race) given.set('race', state.race.join());
  return String(given).replaceAll('%2C', ',');
}
