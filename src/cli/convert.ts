// `broadphase convert`: from any layout that can be read to one that can be written.
import { type Command, exitCode } from './arguments.ts';
import { checkWritable, openSource, sourceOperand, sourceOptions, writeFrames } from './files.ts';
import { bytes, counted } from './terminal.ts';

export const convertCommand: Command = {
  summary: 'convert to a raw recording (.bin) or a trace (any other name); with .gz at the end, gzipped',
  operands: {
    ...sourceOperand,
    file: 'the file to write: .bin is raw, any other name a trace; with .gz at the end, gzipped',
  },
  options: sourceOptions,
  async run(input, terminal) {
    const selected = await openSource(input, terminal);
    const [from, path] = input.operands;
    await checkWritable('<file>', path, [from]);
    const size = await writeFrames(path, selected);
    const { dimensions, frames } = selected.source;
    if (input.has('json')) terminal.out(`${JSON.stringify({ path, dimensions, frames, bytes: size })}\n`);
    else terminal.out(`${path}: ${counted(frames, 'frame')}, ${bytes(size)}\n`);
    return exitCode.ok;
  },
};
