// A worker of the lab: says that it is there, takes questions one after the other, and answers each with a value or with
// what went wrong.
import { Engine } from './engine.ts';
import type { Answer, Ask, Picture } from './messages.ts';

const engine = new Engine();
let before: Promise<void> = Promise.resolve();

addEventListener('message', ({ data }: MessageEvent<Ask>) => {
  before = before.then(async () => {
    const { id, name, args } = data;
    try {
      const value = await (engine[name] as (...args: unknown[]) => unknown)(...args);
      send({ id, value }, name === 'picture' ? buffersOf(value as Picture) : []);
    } catch (error) {
      send({ id, error: error instanceof Error ? error.message : String(error) });
    }
  });
});

const send = (answer: Answer, transfer: Transferable[] = []) => postMessage(answer, { transfer });

/** Pictures are handed over, not copied. */
function buffersOf({ drawn, slots, lines }: Picture): Transferable[] {
  const buffers: Transferable[] = [drawn.buffer, slots.buffer];
  if (lines) buffers.push(lines.buffer);
  return buffers;
}

postMessage('started');
