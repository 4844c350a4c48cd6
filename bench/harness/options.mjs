// The command line of the benchmark. A mistake is an error that names it and says what was expected.
import { parseArgs } from 'node:util';

/** In the order of a run. */
export const kinds = ['objects', 'cold', 'once', 'movers', 'motions', 'queries', 'scenes', 'native'];

const flags = [...kinds, 'full', 'compare', 'figures', 'help'];
/** What the value of each option is: a description, and whether a text is one. */
const values = {
  count: ['numbers of boxes, such as 1000,10000', (text) => text.split(',').every(isCount)],
  dimensions: ['2, 3 or 2,3', (text) => text.split(',').every((one) => one === '2' || one === '3')],
  set: ['tune or check', (text) => text === 'tune' || text === 'check'],
  by: ['set, boxes or set,boxes', (text) => text.split(',').every((one) => one === 'set' || one === 'boxes')],
  frames: ['a number of frames', isCount],
  json: ['a file', (text) => text !== ''],
};

function isCount(text) {
  return /^[1-9][0-9]*$/.test(text);
}

/** A mistake of the person who called. */
export class Mistake extends Error {}

/**
 * @param words those after `npm run bench --`
 * @returns `{ options, names }`
 * @throws Mistake for an unknown option, or a value that it cannot have
 */
export function parsed(words) {
  const options = {
    ...Object.fromEntries(flags.map((name) => [name, { type: 'boolean', default: false }])),
    ...Object.fromEntries(Object.keys(values).map((name) => [name, { type: 'string' }])),
  };
  const all = parseArgs({ args: words, options, allowPositionals: true, strict: false });
  for (const [name, value] of Object.entries(all.values)) check(name, value);
  return { options: all.values, names: all.positionals };
}

function check(name, value) {
  if (flags.includes(name)) {
    if (typeof value === 'string') throw new Mistake(`--${name}: got a value, ${value}, expected none`);
    return;
  }
  if (!Object.hasOwn(values, name)) {
    const known = [...flags, ...Object.keys(values)].map((one) => `--${one}`).join(', ');
    throw new Mistake(`--${name}: there is no such option, expected one of ${known}`);
  }
  const [expected, holds] = values[name];
  if (typeof value !== 'string') throw new Mistake(`--${name}: got no value, expected ${expected}`);
  if (!holds(value)) throw new Mistake(`--${name}: got ${value || 'an empty text'}, expected ${expected}`);
}
