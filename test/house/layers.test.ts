// The layers of the kernel, as ARCHITECTURE.md draws them: no include goes up or in a circle, and only the policy
// names a technique.
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { expect, test } from 'vitest';

const kernel = fileURLToPath(new URL('../../kernel', import.meta.url));
const floors = ['base', 'boxes', 'pairs', 'rules', 'search', 'techniques', 'coherence', 'questions', 'space'];

const files = floors.flatMap((floor) => readdirSync(join(kernel, floor)).map((name) => `${floor}/${name}`));
const floorOf = (file: string) => floors.indexOf(file.split('/')[0]!);

interface Arrow {
  from: string;
  line: number;
  to: string;
}

const arrows: Arrow[] = files.flatMap((from) =>
  readFileSync(join(kernel, from), 'utf8')
    .split('\n')
    .flatMap((text, k) => {
      const to = /^#include "(.*)"$/.exec(text)?.[1];
      return to ? [{ from, line: k + 1, to }] : [];
    }),
);

const places = (of: Arrow[]) => of.map(({ from, line, to }) => `kernel/${from}:${line} includes ${to}`);

test('the kernel has only these layers', () => {
  const rooms = readdirSync(kernel, { withFileTypes: true })
    .filter((entry) => entry.isDirectory() && entry.name !== 'test')
    .map((entry) => entry.name);
  expect(rooms.sort()).toEqual([...floors].sort());
  const loose = readdirSync(kernel).filter((name) => name.endsWith('.hpp'));
  expect(loose, 'headers that stand on no floor').toEqual([]);
  expect(arrows.length).toBeGreaterThan(80);
});

test('includes name a file by its layer', () => {
  expect(places(arrows.filter(({ to }) => !files.includes(to)))).toEqual([]);
});

test('no include goes up', () => {
  expect(places(arrows.filter(({ from, to }) => floorOf(to) > floorOf(from)))).toEqual([]);
});

test('no include is circular', () => {
  const left = new Map(files.map((file) => [file, arrows.filter(({ from }) => from === file)]));
  for (let gone = -1; gone !== 0; ) {
    const before = left.size;
    for (const [file, its] of left) if (!its.some(({ to }) => left.has(to))) left.delete(file);
    gone = before - left.size;
  }
  expect(places([...left.values()].flat())).toEqual([]);
});

test('layers depend on few others', () => {
  const between = new Set(
    arrows
      .filter(({ from, to }) => floorOf(from) !== floorOf(to))
      .map(({ from, to }) => floorOf(from) * 100 + floorOf(to)),
  );
  expect(between.size, 'arrows from floor to floor').toBeLessThanOrEqual(35);
});

test('only the policy names a technique, and coherence names strip sweep', () => {
  const list = readFileSync(join(kernel, 'space/techniques.hpp'), 'utf8');
  const known = [...list.matchAll(/IfBuilt<Technique::(\w+), (\w+)<D>>/g)];
  expect(known.length).toBeGreaterThan(10);
  const names = [...known.map(([, , kind]) => `\\b${kind}\\b`), 'Technique::\\w+'];
  const may = ['space/techniques.hpp', 'space/auto.hpp'];
  const named = [...files, 'abi.cpp']
    .filter((file) => !may.includes(file) && !file.startsWith('techniques/') && !file.endsWith('incremental.hpp'))
    .flatMap((file) =>
      readFileSync(join(kernel, file), 'utf8')
        .split('\n')
        .map((text) => text.replace(/\/\/.*/, ''))
        .filter((text) => new RegExp(names.join('|')).test(text))
        .map((text) => `kernel/${file}: ${text.trim()}`),
    );
  expect(named.filter((place) => !/^kernel\/coherence\/.*\bStripSweep\b/.test(place))).toEqual([]);
  const others = arrows.filter(({ from, to }) => to.startsWith('techniques/') && !from.startsWith('space/'));
  expect(places(others).map((place) => place.replace(/:\d+/, ''))).toEqual([
    'kernel/coherence/candidate_list.hpp includes techniques/strip_sweep.hpp',
  ]);
});
