// The page's end of a worker: asks, and waits for the answer, but not for ever. A worker that takes too long is ended,
// whatever it is doing, and a new one takes its place: nothing that a scene or a file asks for can hang the page.
import type { Answer, Ask, Requests } from './messages.ts';

/** What a worker was ended for. */
export class TooSlow extends Error {}

interface Waiting {
  resolve: (value: never) => void;
  reject: (error: Error) => void;
}

export class Pilot {
  #worker = startWorker();
  #asked = 0;
  readonly #waiting = new Map<number, Waiting>();
  #watchdog: ReturnType<typeof setTimeout> | undefined;
  readonly #limit: number;

  /** @param limit milliseconds that one answer may take */
  constructor(limit: number) {
    this.#limit = limit;
    this.#listen();
  }

  /**
   * @throws TooSlow where the answer does not come in time: the worker then has nothing open any more
   * @throws Error with the words of the worker
   */
  ask<Name extends keyof Requests>(
    name: Name,
    ...args: Parameters<Requests[Name]>
  ): Promise<ReturnType<Requests[Name]>> {
    const id = ++this.#asked;
    const spare = name === 'picture' ? (args[0] as Parameters<Requests['picture']>[0]).spare : undefined;
    const transfer = spare ? [spare.drawn.buffer, spare.slots.buffer] : [];
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, { resolve, reject });
      this.#worker.postMessage({ id, name, args } satisfies Ask<Name>, transfer);
      if (this.#waiting.size === 1) this.#watch();
    });
  }

  /** Ends the worker; a new one, which has nothing open, takes its place. */
  restart(why = new TooSlow('stopped')): void {
    this.end(why);
    this.#worker = startWorker();
    this.#listen();
  }

  end(why: Error = new TooSlow('ended')): void {
    clearTimeout(this.#watchdog);
    this.#worker.terminate();
    const given = [...this.#waiting.values()];
    this.#waiting.clear();
    for (const { reject } of given) reject(why);
  }

  #listen(): void {
    this.#worker.addEventListener('message', ({ data }: MessageEvent<Answer>) => {
      const waiting = this.#waiting.get(data.id);
      this.#waiting.delete(data.id);
      this.#watch();
      if ('error' in data) waiting?.reject(new Error(data.error));
      else waiting?.resolve(data.value as never);
    });
    this.#worker.addEventListener('error', (event) =>
      this.restart(new TooSlow(event.message || 'the worker broke down')),
    );
  }

  /** From now on the next answer has all the time there is. */
  #watch(): void {
    clearTimeout(this.#watchdog);
    if (this.#waiting.size === 0) return;
    this.#watchdog = setTimeout(() => {
      this.restart(new TooSlow(`it took more than ${this.#limit / 1000} s`));
    }, this.#limit);
  }
}

const startWorker = () => new Worker(new URL('./worker.ts', import.meta.url), { type: 'module' });
