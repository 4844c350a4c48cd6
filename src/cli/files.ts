// Reading and writing files: reads any kind of trace, and writes the format that the file name asks for.
import { open, readFile, stat, unlink, writeFile } from 'node:fs/promises';
import { gzipSync } from 'node:zlib';
import { exportRecording, type Frame, type FrameSource, openAny, TraceError, TraceWriter } from 'broadphase/trace';
import { type Input, named, type Option, type Terminal, UsageError } from './arguments.ts';
import { complain, counted } from './terminal.ts';

/** A file that cannot be read or written. */
export class FileError extends Error {}

/** The operand that {@link openSource} takes. */
export const sourceOperand = { trace: 'a file written by record(space), or a raw recording; either may be gzipped' };

/** The options of commands that read a trace, to select a part of it. */
export const sourceOptions: Record<string, Option> = {
  frames: { value: 'a..b', help: 'only frames a to b, counted from 0' },
  salvage: { help: 'read the intact frames of a trace that was cut off, instead of refusing it' },
};

/** Frames to play. Sources count from 0, so results add `first` to name frames by their numbers in the recording. */
export interface Selected {
  source: FrameSource;
  first: number;
}

/**
 * Opens the trace or recording that the first operand names.
 * @throws FileError, TraceError or UsageError
 */
export async function openSource(input: Input, terminal: Terminal): Promise<Selected> {
  const [path] = input.operands;
  const bytes = await readFile(path).catch((error: Error) => {
    throw new FileError(`cannot read ${path}: ${error.message}`);
  });
  const salvage = input.has('salvage');
  const source = await openAny(bytes, { salvage }).catch(async (error: unknown) => {
    if (error instanceof TraceError) error.message = `${path}: ${error.message}${salvage ? '' : await hintAt(bytes)}`;
    throw error;
  });
  const { fault } = source;
  if (fault) complain(terminal, `${path}: ${counted(source.frames, 'frame')} salvaged; ${fault.message}`);
  const range = input.text('frames');
  return range === undefined ? { source, first: 0 } : slice(source, range);
}

/** What `--salvage` would read of a trace that is broken, if anything. */
async function hintAt(bytes: Uint8Array): Promise<string> {
  const intact = await openAny(bytes, { salvage: true }).catch(() => undefined);
  return intact?.frames ? `; --salvage reads ${counted(intact.frames, 'intact frame')}` : '';
}

export async function write(path: string, data: Uint8Array | string): Promise<void> {
  await writeFile(path, data).catch((error: Error) => {
    throw new FileError(`cannot write ${path}: ${error.message}`);
  });
}

/**
 * Checks, before much work is done, whether its result can be written.
 * @param read the files that are read: the result is none of them, by any name or link
 * @param what they are, in words
 * @throws FileError where it cannot; UsageError where the file is one that is read
 */
export async function checkWritable(
  option: string,
  path: string,
  read: readonly string[],
  what = 'the trace itself',
): Promise<void> {
  const [there, ...sources] = await Promise.all([path, ...read].map((each) => stat(each).catch(() => undefined)));
  if (there && sources.some((source) => source && there.dev === source.dev && there.ino === source.ino)) {
    throw new UsageError(`${option} is ${path}, which is ${what}; expected another file`);
  }
  if (there?.isFIFO()) return; // whoever reads it would take this for the end
  try {
    await (await open(path, 'a')).close();
    if (!there) await unlink(path);
  } catch (error) {
    throw new FileError(`cannot write ${path}: ${(error as Error).message}`);
  }
}

/** Writes frames in the format of the file name: `.bin` is the raw layout, any other a trace; with `.gz`, gzipped. */
export async function writeFrames(path: string, { source, first }: Selected): Promise<number> {
  const zipped = path.endsWith('.gz');
  const plain = /\.bin(\.gz)?$/.test(path) ? exportRaw(source, first) : exportTrace(source);
  const data = zipped ? gzipSync(plain, { level: 9 }) : plain;
  await write(path, data);
  return data.length;
}

function exportRaw(source: FrameSource, first: number): Uint8Array {
  try {
    return exportRecording(source);
  } catch (error) {
    if (!(error instanceof RangeError)) throw error;
    throw new UsageError(error.message.replace(/^frame (\d+)/, (_, index) => `frame ${Number(index) + first}`));
  }
}

function exportTrace(source: FrameSource): Uint8Array {
  const writer = new TraceWriter(source.dimensions, source.wrap, source.touching);
  const pieces: Uint8Array[] = [writer.header()];
  for (const frame of source) pieces.push(writer.frame(frame.boxes, frame.ids, frame.rules, frame));
  pieces.push(writer.end());
  return Buffer.concat(pieces);
}

function slice(source: FrameSource, range: string): Selected {
  const [, first, until] = /^(\d+)\.\.(\d+)$/.exec(range) ?? [];
  const from = Number(first);
  const to = Number(until);
  if (!(from <= to && to < source.frames)) {
    const last = source.frames - 1;
    const expected = `expected two numbers from 0 to ${last}, such as 0..${Math.min(9, last)}`;
    throw new UsageError(`--frames is ${named(range)}, ${last < 0 ? 'but the trace has no frames' : expected}`);
  }
  const chosen: FrameSource = {
    dimensions: source.dimensions,
    wrap: source.wrap,
    touching: source.touching,
    frames: to - from + 1,
    *[Symbol.iterator](): Generator<Frame> {
      for (const frame of source) {
        if (frame.index > to) return;
        if (frame.index < from) continue;
        const changed = frame.index === from ? frame.count : frame.changed;
        yield { ...frame, index: frame.index - from, changed };
      }
    },
  };
  return { source: chosen, first: from };
}
