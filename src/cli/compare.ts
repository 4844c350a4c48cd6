// `broadphase compare`: all techniques on the same frames.
import { BroadPhase } from 'broadphase';
import { compare, TraceError } from 'broadphase/trace';
import { type Command, exitCode } from './arguments.ts';
import { openSource, sourceOperand, sourceOptions } from './files.ts';
import { cellSizeOption, readCellSize, techniqueHelp } from './technique.ts';
import { bytes, complain, number, progressBar, table, time } from './terminal.ts';

export const compareCommand: Command = {
  summary: 'compare all techniques: time, tests, memory',
  operands: sourceOperand,
  options: {
    techniques: { value: 'names', help: `some of ${techniqueHelp}, separated by commas (all)` },
    ...cellSizeOption,
    passes: { value: 'n', help: 'how many times the frames are played; each counts with its fastest time (3)' },
    ...sourceOptions,
  },
  async run(input, terminal) {
    const techniques = input.names('techniques', BroadPhase.techniques) ?? BroadPhase.techniques;
    const passes = input.number('passes', { least: 1, most: 1000, whole: true }) ?? 3;
    const { source, first } = await openSource(input, terminal);
    if (source.frames === 0) throw new TraceError(`${input.operands[0]}: no frames to compare on`, -1, 0);
    const progress = progressBar(terminal);
    const settings = readCellSize(input, source.dimensions);
    const results = compare(source, {
      ...settings,
      techniques,
      passes,
      progress: (done, total) => progress.show('frames', done, total),
    });
    progress.end();
    for (const each of results) if (each.disagrees !== null) each.disagrees += first;
    results.sort((a, b) => a.ms.mean - b.ms.mean);
    const wrong = results.filter(({ disagrees }) => disagrees !== null);
    const code = wrong.length > 0 ? exitCode.different : exitCode.ok;
    if (input.has('json')) {
      const { dimensions, frames } = source;
      terminal.out(
        `${JSON.stringify({ dimensions, frames, passes, agree: wrong.length === 0, techniques: results })}\n`,
      );
      return code;
    }
    const fastest = results[0]?.ms.mean || 1;
    const rows = results.map(({ technique, ms, tests, bytes: memory, ran }) => [
      ran.length === 1 && ran[0] === technique ? technique : `${technique} (${ran.join(', ')})`,
      time(ms.mean),
      `${(ms.mean / fastest).toFixed(2)}x`,
      ...[ms.p95, ms.max, ms.median].map(time),
      bytes(memory),
      number(tests),
    ]);
    terminal.out(
      table(terminal, ['technique', 'mean ms', 'to best', '95 %', 'worst', 'median', 'memory', 'tests'], rows, 0),
    );
    for (const { technique, disagrees } of wrong) {
      complain(terminal, `${technique} finds different pairs than ${techniques[0]}, first in frame ${disagrees}`);
    }
    if (wrong.length === 0) terminal.out('\nall agree on the pairs of every frame\n');
    return code;
  },
};
