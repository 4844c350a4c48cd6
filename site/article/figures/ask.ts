// Fig. 16: two questions about the player, among many other collisions.
import { ro } from 'broadphase/ro';
import { demoColumns } from '../demo.ts';
import { player } from '../demos/player.ts';
import source from '../demos/player.ts?raw';
import { excerpt, listing } from '../kit/index.ts';
import { createStage } from '../stage.ts';

export function mount(root: HTMLElement): () => void {
  const [left, right] = demoColumns(root);

  const stage = createStage(left, {
    width: 480,
    height: 360,
    build: (canvas, colors) => player(ro, canvas, new ro.coltech.BroadPhase(), colors),
    counters: { pairs: 'Pairs in all', touched: 'Touched now', collected: 'Collected', caught: 'Caught' },
    count: ({ pairCount, touched, collected, caught }) => ({
      pairs: pairCount,
      touched,
      collected,
      caught: caught ? 'yes' : 'no',
    }),
    inWords: ({ pairCount, collected, caught }) =>
      `A player among power-ups and a drifting crowd. ${pairCount} pairs collide; ${collected} power-ups collected; ` +
      `the guard ${caught ? 'touches' : 'does not touch'} the player. Arrow keys move the player.`,
  });
  // The arrow keys steer, so they must not scroll the page.
  stage.canvas.addEventListener('keydown', (event) => {
    if (event.key.startsWith('Arrow')) event.preventDefault();
  });

  listing(right, 'site/article/demos/player.ts', excerpt(source, 'handleCollisions(_dt, pairs) {'));
  return stage.rest;
}
