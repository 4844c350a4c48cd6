// A space and a world of broadphase/ro held in the state of frameworks that wrap what they hold in proxies.
import { writeFileSync } from 'node:fs';
import { BroadPhase } from 'broadphase';
import { Entity, World } from 'broadphase/ro';
import { produce } from 'immer';
import * as mobx from 'mobx';
import { createElement, StrictMode, useRef, useState } from 'react';
import { renderToString } from 'react-dom/server';
import { createStore, produce as solidProduce } from 'solid-js/store/dist/store.js';
import { compileModule } from 'svelte/compiler';
import { ref as keep, proxy } from 'valtio/vanilla';
import { reactive, readonly, ref, shallowRef } from 'vue';

/** What a game does with what it keeps: by the state, never by a reference of its own. */
function play(name, state) {
  state.boxes = [0, 0, 10, 10, 5, 5, 15, 15];
  state.space.setAll(state.boxes).update();
  state.world.addEntity(new Entity(0, 0, 10, 10));
  state.world.addEntity(state.entity);
  state.world.step();
  for (const entity of state.world.entities) entity.getAABB();
  state.world.removeEntity(state.entity);
  const answers = [state.space.pairs, state.space.size, state.space.stats.pairs, state.world.entities.length];
  if (`${answers}` !== '0,1,2,1,1') throw new Error(`${name}: ${answers}`);
}
const fresh = () => ({ space: new BroadPhase(), world: new World(null), entity: new Entity(5, 5, 10, 10), boxes: [] });

const cases = {
  'Vue reactive': () => reactive(fresh()),
  'Vue ref': () => ref(fresh()).value,
  'Vue ref of a space': () => Object.assign(fresh(), { space: ref(new BroadPhase()).value }),
  'Vue shallowRef': () => shallowRef(fresh()).value,
  MobX: () => mobx.observable(fresh()),
  'MobX class': () => {
    class Store {
      constructor() {
        Object.assign(this, fresh());
        mobx.makeAutoObservable(this);
      }
    }
    return new Store();
  },
  Immer: () => {
    let made;
    const next = produce(fresh(), (draft) => {
      draft.space.set(0, 0, 0, 1, 1);
      made = true;
    });
    return { ...next, made };
  },
  'valtio, worlds with ref': () => {
    const { space, world, entity } = fresh();
    return proxy({ space, world: keep(world), entity: keep(entity), boxes: [] });
  },
  'valtio, of a space': () => Object.assign(fresh(), { space: proxy(new BroadPhase()) }),
};
// Svelte's runes are compiled.
const { js } = compileModule('export const hold = (value) => { const state = $state(value); return state; };', {
  generate: 'client',
});
writeFileSync('hold.mjs', js.code);
const { hold } = await import('./hold.mjs');
cases.Svelte = () => hold(fresh());
cases['Svelte, of a space'] = () => Object.assign(fresh(), { space: hold(new BroadPhase()) });

for (const [name, make] of Object.entries(cases)) mobx.runInAction(() => play(name, make()));
readonly(reactive(fresh())).space.set(0, 0, 0, 1, 1);

// Solid's store is written by a function.
const [store, setStore] = createStore(fresh());
setStore(solidProduce((state) => play('Solid', state)));
store.space.update();

// React, on the server and with everything run twice.
function Game() {
  const [space] = useState(() => new BroadPhase());
  const again = useRef(null);
  again.current ??= new BroadPhase();
  space.set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
  return createElement('p', null, String(space.pairs));
}
const page = renderToString(createElement(StrictMode, null, createElement(Game)));
if (page !== '<p>7,9</p>') throw new Error(`React: ${page}`);
console.log([...Object.keys(cases), 'Solid', 'React'].join(', '));
