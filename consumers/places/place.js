// Runs as a shared worker, a service worker and an audio worklet: finds a pair, and says so to who asks.
import { BroadPhase } from './library.js';

const find = () => {
  const space = new BroadPhase().set(7, 0, 0, 10, 10).set(9, 5, 5, 15, 15).update();
  return `${space.pairs}`;
};

if (globalThis.AudioWorkletProcessor) {
  registerProcessor(
    'broadphase',
    class extends AudioWorkletProcessor {
      constructor() {
        super();
        this.port.onmessage = () =>
          this.port.postMessage(`${find()}${typeof TextEncoder === 'undefined' ? ', no TextEncoder' : ''}`);
      }
      process() {
        return true;
      }
    },
  );
} else {
  globalThis.onconnect = ({ ports: [port] }) => {
    port.onmessage = () => port.postMessage(find());
  };
  globalThis.onmessage = ({ ports: [port] }) => port?.postMessage(find());
}
