// A worker of the lab: reports that it runs, then answers requests one after the other, with a value or an error.
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

/** The buffers of a picture, which are transferred, not copied. */
function buffersOf({ drawn, slots, lines }: Picture): Transferable[] {
  const buffers: Transferable[] = [drawn.buffer, slots.buffer];
  if (lines) buffers.push(lines.buffer);
  return buffers;
}

postMessage('started');
