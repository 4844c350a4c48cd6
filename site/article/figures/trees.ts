// Fig. 22: the boxes of a tree, live, and those of every other technique the library has.
import { BroadPhase } from 'broadphase';
import { structureFigure } from '../structure-figure.ts';

export function mount(root: HTMLElement): () => void {
  const isTree = (name: string) => name.includes('tree');
  const named = BroadPhase.techniques.filter((name) => name !== 'auto').toReversed();
  const techniques = [...named.filter(isTree), ...named.filter((name) => !isTree(name))];
  return structureFigure(root, {
    techniques,
    unit: 'Nodes or cells',
    count: 300,
    most: 2000,
    sides: [4, 30],
    speed: 0.8,
  });
}
