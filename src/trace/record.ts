// Records a BroadPhase in a running game. After each update, the boxes are compared with those of the previous one, so
// it does not matter by which calls they changed. Each frame is written at once as one chunk of bytes: whatever happens
// to the game, earlier frames are safe.
import type { BroadPhase } from 'broadphase';
import { badValue, checkOptions } from '../errors.ts';
import { checkSpace, type Watcher, watch } from '../watch.ts';
import { joined } from './bytes.ts';
import { TraceWriter } from './writer.ts';

/** The parts of a Node stream that a recording uses. */
export interface NodeSink {
  /** Takes some bytes, and calls back when they are written or lost. */
  write(bytes: Uint8Array, done: (error?: Error | null) => void): unknown;
  /** Ends the stream, and calls back when all is written. */
  end(done: () => void): unknown;
  /** Listens for errors, and for the end. */
  on(event: 'error' | 'close', listener: (error?: Error) => void): unknown;
  /** Whether it accepts no more bytes, if it has this property. */
  readonly writableEnded?: boolean;
  /** Whether it was destroyed, if it has this property. */
  readonly destroyed?: boolean;
}

/** Options of {@link record}. */
export interface RecordOptions {
  /** Where the bytes go, frame by frame: a WritableStream or a Node stream. Default: they are kept in memory. */
  to?: WritableStream<Uint8Array> | NodeSink | undefined;
}

/**
 * A recording in progress or stopped: the result of {@link record}.
 *
 * @example
 * const space = new BroadPhase();
 * const recording = record(space);
 * for (let x = 0; x < 3; x++) space.set(7, x, 0, x + 4, 4).set(9, 5, 0, 9, 4).update();
 * await recording.stop();
 * recording.frames; // → 3
 */
export class Recording {
  /**
   * What ended the recording before `stop()` was called: an error of the stream, or one in writing a frame. The game
   * continues, and later frames are not recorded.
   */
  fault: unknown;
  #space: BroadPhase<2 | 3> | undefined;
  readonly #writer: TraceWriter;
  readonly #sink: Sink;
  #byteLength = 0;
  #stopped: Promise<void> | undefined;

  /** Starts at once: see {@link record}. */
  constructor(space: BroadPhase<2 | 3>, options: RecordOptions = {}) {
    checkSpace('record', space);
    checkOptions('record', options, ['to']);
    this.#sink = openSink(options.to, (error) => this.#fail(error));
    // Attached last, so that the space is unchanged if anything fails.
    try {
      const { wrap, touching } = space[watch]((...frame) => this.#record(frame));
      this.#space = space;
      this.#writer = new TraceWriter(space.dimensions, wrap, touching);
      this.#write(this.#writer.header());
    } catch (error) {
      this.#detach();
      this.#sink.drop();
      throw error;
    }
  }

  /** Frameworks that wrap objects in proxies, such as Vue, leave objects alone whose name here is not `Object`. */
  get [Symbol.toStringTag](): string {
    return 'Recording';
  }

  /**
   * The number of updates recorded.
   *
   * @example
   * record(new BroadPhase()).frames; // → 0
   */
  get frames(): number {
    return this.#writer.frames;
  }

  /**
   * The number of bytes recorded.
   *
   * @example
   * record(new BroadPhase()).byteLength; // → 16
   */
  get byteLength(): number {
    return this.#byteLength;
  }

  /**
   * The trace so far, complete with its end; the recording continues.
   * @throws Error if the bytes went to a stream
   *
   * @example
   * const space = new BroadPhase();
   * const recording = record(space);
   * space.update();
   * openTrace(recording.bytes()).frames; // → 1
   */
  bytes(): Uint8Array<ArrayBuffer> {
    const { kept } = this.#sink;
    if (!kept) throw new Error('bytes: this recording went to its stream and was not kept');
    return joined(this.#stopped ? kept : [...kept, this.#writer.end()]);
  }

  /**
   * Ends the recording, and its stream.
   * @throws the stream's error, if it failed: earlier frames may have been written
   *
   * @example
   * const recording = record(new BroadPhase());
   * await recording.stop(); // → undefined
   */
  stop(): Promise<void> {
    this.#stopped ??= this.#end();
    return this.#stopped;
  }

  /**
   * In a browser: offers the trace so far as a file to save.
   * @throws Error where there is no page, such as in Node or a worker: there, write `bytes()` to a file
   *
   * @example
   * record(new BroadPhase()).download(); // throws Error: download: there is no page here
   */
  download(name = 'broadphase.trace'): void {
    if (typeof document === 'undefined')
      throw new Error('download: there is no page here, write bytes() to a file instead');
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([this.bytes()], { type: 'application/octet-stream' }));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60_000); // some browsers read it only after the click is over
  }

  async #end(): Promise<void> {
    this.#detach();
    try {
      if (this.fault === undefined) this.#write(this.#writer.end());
      const closed = this.#sink.close();
      if (this.fault === undefined) await closed; // a broken stream may never answer
    } catch (error) {
      this.#fail(error);
    }
    if (this.fault !== undefined) throw this.fault;
  }

  /** An error in a frame ends the recording, not the game. */
  #record(frame: Parameters<Watcher>): void {
    try {
      this.#write(this.#writer.frame(...frame));
    } catch (error) {
      this.#fail(error);
    }
  }

  #fail(error: unknown): void {
    this.fault ??= error ?? new Error('record: the stream failed');
    this.#detach();
  }

  #write(bytes: Uint8Array): void {
    this.#byteLength += bytes.length;
    this.#sink.write(bytes);
  }

  #detach(): void {
    this.#space?.[watch]();
    this.#space = undefined;
  }
}

/**
 * Records every `update()` of a space from now on, the first as a snapshot.
 *
 * @throws Error if the space is being recorded already; TypeError if it is not a space, or if `to` is not a stream or
 * is locked; whatever the stream throws. The space is as before.
 *
 * @example
 * const space = new BroadPhase();
 * const recording = record(space);
 * for (let x = 0; x < 60; x++) space.set(7, x, 0, x + 4, 4).update(); // the game runs
 * await recording.stop();
 * openTrace(recording.bytes()).frames; // → 60
 */
export function record(space: BroadPhase<2 | 3>, options?: RecordOptions): Recording {
  return new Recording(space, options);
}

interface Sink {
  write(bytes: Uint8Array): void;
  close(): Promise<void>;
  /** Releases the stream if recording has not begun. */
  drop(): void;
  /** The bytes written, if they are kept in memory. */
  kept?: Uint8Array[];
}

function openSink(to: RecordOptions['to'], failed: (error: unknown) => void): Sink {
  if (to === undefined) {
    const kept: Uint8Array[] = [];
    return { write: (bytes) => kept.push(bytes), close: async () => {}, drop: () => {}, kept };
  }
  const has = (name: string) => typeof (to as unknown as Record<string, unknown> | null)?.[name] === 'function';
  if (has('getWriter')) return openStream(to as WritableStream<Uint8Array>, failed);
  if (has('write') && has('end') && has('on')) return openNodeStream(to as NodeSink, failed);
  badValue('record: to', to, 'a WritableStream or a Node stream', true);
}

function openStream(to: WritableStream<Uint8Array>, failed: (error: unknown) => void): Sink {
  if (to.locked) badValue('record: to', to, 'an unlocked stream', true);
  const writer = to.getWriter();
  writer.closed.catch(failed);
  return {
    write: (bytes) => void writer.write(bytes).catch(failed),
    close: () => writer.close().catch(failed),
    drop: () => writer.releaseLock(),
  };
}

function openNodeStream(to: NodeSink, failed: (error: unknown) => void): Sink {
  const checkOpen = () => {
    if (to.writableEnded || to.destroyed) throw new Error('record: the stream has ended, expected one that is open');
  };
  checkOpen();
  let ending = false;
  let over = () => {};
  const failure = new Promise<void>((resolve) => {
    over = resolve;
  });
  const fail = (error?: unknown) => {
    failed(error);
    over();
  };
  to.on('error', fail);
  to.on('close', () => {
    if (!ending) fail(new Error('record: the stream was closed before the recording was stopped'));
  });
  return {
    write: (bytes) => {
      checkOpen();
      to.write(bytes, (error) => {
        if (error) fail(error);
      });
    },
    close: () => {
      ending = true;
      return Promise.race([failure, new Promise<void>((resolve) => to.end(resolve))]);
    },
    drop: () => {},
  };
}
