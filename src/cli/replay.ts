// `broadphase replay`: plays a trace with one technique, and checks the pairs of every frame if asked.
import { BroadPhase, type TechniqueName } from 'broadphase';
import { type ReplayedFrame, replay } from 'broadphase/trace';
import { summarize } from '../trace/statistics.ts';
import { type Command, exitCode, UsageError } from './arguments.ts';
import { openSource, sourceOperand, sourceOptions } from './files.ts';
import { cellSizeOption, readCellSize, techniqueHelp } from './technique.ts';
import { bytes, complain, counted, number, progressBar, table, time } from './terminal.ts';

export const replayCommand: Command = {
  summary: 'play a trace: time and counters of every frame',
  operands: sourceOperand,
  options: {
    technique: { value: 'name', help: `one of ${techniqueHelp} (auto)` },
    ...cellSizeOption,
    verify: { help: 'check the pairs of every frame against an exact sweep' },
    ...sourceOptions,
  },
  async run(input, terminal) {
    const names: TechniqueName[] = input.names('technique', BroadPhase.techniques) ?? ['auto'];
    if (names.length !== 1) throw new UsageError('--technique: expected one name; `compare` takes several');
    const [technique] = names;
    const { source, first } = await openSource(input, terminal);
    const progress = progressBar(terminal);
    const frames: ReplayedFrame[] = [];
    const settings = { technique, ...readCellSize(input, source.dimensions) };
    for (const frame of replay(source, settings, input.has('verify'))) {
      frames.push({ ...frame, index: frame.index + first });
      progress.show('frames', frames.length, source.frames);
    }
    progress.end();
    const wrong = frames.filter(({ difference }) => difference);
    const ms = summarize(frames.map((frame) => frame.ms));
    if (input.has('json')) {
      const verified = input.has('verify') ? wrong.length === 0 : null;
      terminal.out(`${JSON.stringify({ dimensions: source.dimensions, ...settings, verified, ms, frames })}\n`);
      return wrong.length > 0 ? exitCode.different : exitCode.ok;
    }
    const head = ['frame', 'boxes', 'changed', 'ms', 'pairs', 'technique', 'tests', 'candidates', 'cells', 'memory'];
    const rows = frames.map((frame) => [
      String(frame.index),
      ...[frame.boxes, frame.changed].map(number),
      time(frame.ms),
      number(frame.pairs),
      frame.technique,
      ...[frame.tests, frame.candidates, frame.cells].map(number),
      bytes(frame.bytes),
    ]);
    terminal.out(table(terminal, head, rows));
    terminal.out(
      `\nmean ${time(ms.mean)} ms, median ${time(ms.median)}, 95 % ${time(ms.p95)}, worst ${time(ms.max)}\n`,
    );
    for (const { index, difference } of wrong) {
      const { missing, extra, pair } = difference!;
      complain(
        terminal,
        `frame ${index}: ${counted(missing, 'pair')} missing, ${extra} too many, first [${pair.join(', ')}]`,
      );
    }
    if (input.has('verify') && wrong.length === 0)
      terminal.out(
        `verified: the pairs of ${frames.length === 1 ? 'the frame' : `all ${frames.length} frames`} are exact\n`,
      );
    return wrong.length > 0 ? exitCode.different : exitCode.ok;
  },
};
