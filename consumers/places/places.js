// Every place in a page that runs scripts: an iframe's values, a page without TextEncoder, shared and service workers,
// an audio worklet, and a second copy of the package. What each says is shown.
import * as library from './library.js';
import './foreign.js';

const { everyForeign, expectedOfForeign } = globalThis.foreign;
const said = {};

const frame = document.body.appendChild(document.createElement('iframe'));
said.iframe = everyForeign(library, frame.contentWindow) === expectedOfForeign;

const own = globalThis.TextEncoder;
globalThis.TextEncoder = undefined;
const again = await import('./library.js?again');
said['no TextEncoder'] = again.findPairs([0, 0, 9, 9, 5, 5, 8, 8]).join();
globalThis.TextEncoder = own;
said['two copies'] =
  again.BroadPhase !== library.BroadPhase && new again.BroadPhase().restore(new library.BroadPhase().snapshot()).size;

const asked = (port) =>
  new Promise((heard) => {
    port.onmessage = ({ data }) => heard(data);
    port.postMessage('');
  });
said['shared worker'] = await asked(new SharedWorker('place.js', { type: 'module' }).port);

const audio = new AudioContext();
await audio.audioWorklet.addModule('place.js');
said['audio worklet'] = await asked(new AudioWorkletNode(audio, 'broadphase').port);

const { port1, port2 } = new MessageChannel();
await navigator.serviceWorker.register('place.js', { type: 'module' });
(await navigator.serviceWorker.ready).active.postMessage('', [port2]);
said['service worker'] = await new Promise((heard) => {
  port1.onmessage = ({ data }) => heard(data);
});

document.querySelector('#page').textContent = JSON.stringify(said);
document.querySelector('#worker').textContent = 'none';
