// The types of frameworks that list the members of what they hold leave a space a space.
import { BroadPhase } from 'broadphase';
import { produce } from 'immer';
import { observable } from 'mobx';
import { createStore } from 'solid-js/store';
import { proxy } from 'valtio';
import { type Ref, reactive, ref, shallowRef } from 'vue';

const fresh = () => ({ space: new BroadPhase(), solid: new BroadPhase({ dimensions: 3 }) });
const [store] = createStore(fresh());
const states = [ref(fresh()).value, shallowRef(fresh()).value, reactive(fresh()), observable(fresh()), proxy(fresh())];
for (const { space, solid } of [...states, store]) play(space, solid);
produce(fresh(), ({ space, solid }) => play(space, solid));
const solid: Ref<BroadPhase<3>> = ref(new BroadPhase({ dimensions: 3 }));
play(ref(new BroadPhase()).value, solid.value);

function play(space: BroadPhase, solid: BroadPhase<3>): void {
  space.set(7, 0, 0, 10, 10).update();
  solid.set(7, 0, 0, 0, 10, 10, 10).update();
}
