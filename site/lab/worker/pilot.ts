// The page's end of a worker: sends requests and waits for the answers, but not for ever. A worker that takes too
// long is stopped, whatever it is doing, and the next request starts a new one. So no scene or file can hang the
// page.
import type { Answer, Ask, Requests } from './messages.ts';

/** Why a worker was stopped. */
export class TooSlow extends Error {}

interface Waiting {
  resolve: (value: never) => void;
  reject: (error: Error) => void;
}

/** Milliseconds that a worker may take to load its script and report that it runs. */
const startLimit = 6000;

export class Pilot {
  /** Undefined until the first request. */
  #worker: Worker | undefined;
  #ended = false;
  /** Whether the worker has reported that it runs. */
  #started = false;
  #asked = 0;
  readonly #waiting = new Map<number, Waiting>();
  #watchdog: ReturnType<typeof setTimeout> | undefined;
  readonly #limit: number;

  /** @param limit milliseconds that one answer may take */
  constructor(limit: number) {
    this.#limit = limit;
  }

  /**
   * @throws TooSlow if the answer does not come in time: the worker then has nothing open any more
   * @throws Error with the message of the worker
   */
  ask<Name extends keyof Requests>(
    name: Name,
    ...args: Parameters<Requests[Name]>
  ): Promise<ReturnType<Requests[Name]>> {
    if (this.#ended) return Promise.reject(new TooSlow('ended'));
    const id = ++this.#asked;
    const spare = name === 'picture' ? (args[0] as Parameters<Requests['picture']>[0]).spare : undefined;
    const transfer = spare ? [spare.drawn.buffer, spare.slots.buffer] : [];
    this.#worker ??= this.#start();
    const worker = this.#worker;
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, { resolve, reject });
      worker.postMessage({ id, name, args } satisfies Ask<Name>, transfer);
      if (this.#waiting.size === 1) this.#watch();
    });
  }

  /** Ends it for good: requests fail from now on. */
  end(): void {
    this.#ended = true;
    this.#stop(new TooSlow('ended'));
  }

  /** Stops the worker: its requests fail, and what it had open is gone. */
  #stop(why: TooSlow): void {
    clearTimeout(this.#watchdog);
    this.#worker?.terminate();
    this.#worker = undefined;
    const given = [...this.#waiting.values()];
    this.#waiting.clear();
    for (const { reject } of given) reject(why);
  }

  #start(): Worker {
    const worker = new Worker(new URL('./worker.ts', import.meta.url), { type: 'module' });
    this.#started = false;
    worker.addEventListener('message', ({ data }: MessageEvent<Answer | 'started'>) => {
      if (worker !== this.#worker) return; // sent before it was stopped
      this.#started = true;
      if (data !== 'started') this.#settle(data);
      this.#watch();
    });
    worker.addEventListener('error', ({ message }) => {
      if (worker === this.#worker) this.#stop(new TooSlow(message || 'its worker could not be loaded, or crashed'));
    });
    return worker;
  }

  #settle(answer: Answer): void {
    const waiting = this.#waiting.get(answer.id);
    this.#waiting.delete(answer.id);
    if ('error' in answer) waiting?.reject(new Error(answer.error));
    else waiting?.resolve(answer.value as never);
  }

  /** Restarts the time limit for the next answer. */
  #watch(): void {
    clearTimeout(this.#watchdog);
    if (this.#waiting.size === 0) return;
    const limit = this.#started ? this.#limit : startLimit;
    const what = this.#started ? 'it took more than' : 'its worker did not start within';
    this.#watchdog = setTimeout(() => this.#stop(new TooSlow(`${what} ${limit / 1000} s`)), limit);
  }
}
