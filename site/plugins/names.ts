// The public names of the library, and where each is in the reference. The README's table of the API is the list: its
// groups are those of the reference, and a name that it leaves out fails the build of the site.
import { readFileSync } from 'node:fs';

export interface Group {
  title: string;
  names: readonly string[];
}

/** The functions and classes of the other entry points. */
const functions = {
  broadphase: ['findPairs', 'findPairsBetween', 'init'],
  'broadphase/draw': ['drawSpace', 'boxesInCells'],
  'broadphase/trace': ['record', 'openTrace', 'replay', 'compare', 'survey', 'tune'],
};
const classes = {
  broadphase: ['BroadPhase'],
  'broadphase/draw': ['Lines'],
  'broadphase/ro': ['World'],
  'broadphase/shard': ['Shard', 'Zones'],
};

const readme = readFileSync(new URL('../../README.md', import.meta.url), 'utf8');

/** The groups of the README's table of the API: for each title in bold, the names at the start of its rows. */
export const groups: readonly Group[] = /## API\n([\s\S]*?)\n## /
  .exec(readme)![1]
  .split(/^\| \*\*/m)
  .slice(1)
  .map((part) => ({
    title: part.slice(0, part.indexOf('**')),
    names: [...new Set(Array.from(part.matchAll(/`(?:BroadPhase\.)?([a-z]\w*)(?:\([^`]*)?`/g), ([, name]) => name))],
  }));

const addresses = new Map<string, string>([
  ...groups.flatMap(({ names }) =>
    names.map((name): [string, string] => [name, `classes/broadphase.BroadPhase.html#${name.toLowerCase()}`]),
  ),
  ...[functions, classes].flatMap((kind) =>
    Object.entries(kind).flatMap(([entry, names]) =>
      names.map((name): [string, string] => [
        name,
        `${kind === functions ? 'functions' : 'classes'}/${entry.replace('/', '_')}.${name}.html`,
      ]),
    ),
  ),
]);

/** Words with other meanings: they count as a name only in a call, or as a member of a space. */
const plain =
  /^(size|keys|get|has|set|delete|clear|boxes|pairs|sweep|nearest|stats|technique|init|record|replay|compare|tune|World)$/;

/** The place in the reference of a name in a piece of code, if it is one, such as `set`, `space.set` or `set(…)`. */
export function addressOf(code: string): string | undefined {
  const [, space, name, call] = /^(space\.|BroadPhase\.)?([a-zA-Z]+)(\([^)]*\))?$/.exec(code) ?? [];
  return name && (space || call || !plain.test(name)) ? addresses.get(name) : undefined;
}
