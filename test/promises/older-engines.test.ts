// What tools that build for engines without private names (Vite 6 and earlier, esbuild for ES2020, Babel) make of the
// classes that a program calls for each box: they turn each private name into a weak map, and reading one takes 15 ns.
import { readFileSync } from 'node:fs';
import ts from 'typescript';
import { expect, test } from 'vitest';

/** The private names that become weak maps or, for methods, weak sets. */
function weakOnesOf(file: string): string[] {
  const source = readFileSync(new URL(`../../src/${file}`, import.meta.url), 'utf8');
  const { outputText } = ts.transpileModule(source, { compilerOptions: { target: ts.ScriptTarget.ES2020 } });
  return [...outputText.matchAll(/\b_[A-Z]\w+?_(\w+) = new Weak(?:Map|Set)\(\)/g)].map(([, name]) => name!).sort();
}

test.each(['broad-phase.ts', 'kernel/ring.ts', 'kernel/instance.ts'])('%s has none', (file) => {
  expect(weakOnesOf(file)).toEqual([]);
});
