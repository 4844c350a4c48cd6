// How many bytes of JavaScript heap a frame allocates, collected later or not: V8's sampling heap profiler counts them.
// It sees nothing of the memory behind large typed arrays and WebAssembly, which is not on that heap.
import { Session } from 'node:inspector/promises';

/** One allocation in so many bytes is seen, and counted as that many. */
const samplingInterval = 512;

/** Runs `step` and `frame` in turns for a while. Of what both allocate, that of `frame` counts. */
export async function allocatedBy(frame, step, milliseconds) {
  const session = new Session();
  session.connect();
  let bytes = 0;
  let frames = 0;
  const end = performance.now() + milliseconds;
  const options = { samplingInterval, includeObjectsCollectedByMajorGC: true, includeObjectsCollectedByMinorGC: true };
  await session.post('HeapProfiler.startSampling', options);
  do {
    step();
    frame();
    frames++;
  } while (performance.now() < end && frames < 200);
  const { profile } = await session.post('HeapProfiler.stopSampling');
  session.disconnect();
  count(profile.head, false);
  return bytes / frames;

  /** Adds up what was allocated below the calls of `frame`, told by its name and place. */
  function count(node, within) {
    within ||= node.callFrame.functionName === 'update';
    if (within) bytes += node.selfSize;
    for (const child of node.children) count(child, within);
  }
}
