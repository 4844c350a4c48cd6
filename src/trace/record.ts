// Records a BroadPhase in a running game: after each update the boxes as they stand are compared with those of the
// update before, so that it does not matter by which calls they came to be there. Each frame leaves at once as one
// piece of bytes: whatever happens to the game, what was recorded before is safe.
import type { BroadPhase } from 'broadphase';
import { watch } from '../watch.ts';
import { TraceWriter } from './writer.ts';

/** What a recording asks of a stream of Node. */
export interface NodeSink {
  /** Takes some bytes. */
  write(bytes: Uint8Array): unknown;
  /** Ends the stream, and calls back when all is written. */
  end(done: () => void): unknown;
  /** Listens for errors. */
  on(event: 'error', listener: (error: Error) => void): unknown;
}

/** Options of {@link record}. */
export interface RecordOptions {
  /** Where the bytes go, frame by frame: a WritableStream or a stream of Node. Left out: they are kept in memory. */
  to?: WritableStream<Uint8Array> | NodeSink;
}

/**
 * A recording that is going on, or was stopped: what {@link record} gives.
 *
 * @example
 * const space = new BroadPhase();
 * const recording = record(space);
 * for (let x = 0; x < 3; x++) space.set(7, x, 0, x + 4, 4).set(9, 5, 0, 9, 4).update();
 * await recording.stop();
 * recording.frames; // → 3
 */
export class Recording {
  /** What has stopped the recording before `stop()` was called: an error of the stream. */
  fault: unknown;
  #space: BroadPhase | undefined;
  readonly #writer: TraceWriter;
  readonly #sink: Sink;
  #byteLength = 0;
  #stopped: Promise<void> | undefined;

  /** Begins at once: see {@link record}. */
  constructor(space: BroadPhase, options: RecordOptions = {}) {
    this.#writer = new TraceWriter(space.dimensions);
    space[watch]((...frame) => this.#write(this.#writer.frame(...frame)));
    this.#space = space;
    this.#sink = openSink(options.to, (error) => {
      this.fault ??= error;
      this.#detach();
    });
    this.#write(this.#writer.header());
  }

  /**
   * How many updates have been recorded.
   *
   * @example
   * record(new BroadPhase()).frames; // → 0
   */
  get frames(): number {
    return this.#writer.frames;
  }

  /**
   * How many bytes that made.
   *
   * @example
   * record(new BroadPhase()).byteLength; // → 16
   */
  get byteLength(): number {
    return this.#byteLength;
  }

  /**
   * The trace so far, complete with its end; the recording goes on.
   * @throws Error where the bytes went to a stream
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
    const pieces = this.#stopped ? kept : [...kept, this.#writer.end()];
    const all = new Uint8Array(pieces.reduce((sum, piece) => sum + piece.length, 0));
    let at = 0;
    for (const piece of pieces) {
      all.set(piece, at);
      at += piece.length;
    }
    return all;
  }

  /**
   * Ends the recording, and its stream.
   * @throws what the stream failed with: the frames before that may have been written
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
   * In a browser: offers the trace so far as a file to save. Elsewhere there is no page to do so in.
   *
   * @example
   * record(new BroadPhase()).download(); // throws ReferenceError
   */
  download(name = 'broadphase.trace'): void {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([this.bytes()], { type: 'application/octet-stream' }));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60_000); // some browsers read it only after the click is over
  }

  async #end(): Promise<void> {
    if (this.fault === undefined) this.#write(this.#writer.end());
    this.#detach();
    await this.#sink.close();
    if (this.fault !== undefined) throw this.fault;
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
 * @throws Error where the space is being recorded already
 *
 * @example
 * const space = new BroadPhase();
 * const recording = record(space);
 * for (let x = 0; x < 60; x++) space.set(7, x, 0, x + 4, 4).update(); // the game runs
 * await recording.stop();
 * openTrace(recording.bytes()).frames; // → 60
 */
export function record(space: BroadPhase, options?: RecordOptions): Recording {
  return new Recording(space, options);
}

interface Sink {
  write(bytes: Uint8Array): void;
  close(): Promise<void>;
  /** What was written, where it is kept in memory. */
  kept?: Uint8Array[];
}

function openSink(to: RecordOptions['to'], failed: (error: unknown) => void): Sink {
  if (to === undefined) {
    const kept: Uint8Array[] = [];
    return { write: (bytes) => kept.push(bytes), close: async () => {}, kept };
  }
  if ('getWriter' in to) {
    const writer = to.getWriter();
    writer.closed.catch(failed);
    return {
      write: (bytes) => void writer.write(bytes).catch(failed),
      close: () => writer.close().catch(failed),
    };
  }
  let over = () => {};
  const failure = new Promise<void>((resolve) => {
    over = resolve;
  });
  to.on('error', (error) => {
    failed(error);
    over();
  });
  return {
    write: (bytes) => void to.write(bytes),
    close: () => Promise.race([failure, new Promise<void>((resolve) => to.end(resolve))]),
  };
}
