// `broadphase tune`: the technique, cell size and margin that suit a trace best, with a report of how they were found.
import { basename } from 'node:path';
import { BroadPhase } from 'broadphase';
import { type FrameSource, TraceError, tune } from 'broadphase/trace';
import { type Command, exitCode } from './arguments.ts';
import { checkWritable, openSource, sourceOperand, sourceOptions, write } from './files.ts';
import { nameOf, reportOf, verdictOf } from './report.ts';
import { techniqueHelp } from './technique.ts';
import { progressBar, table, time, wrap } from './terminal.ts';

export const tuneCommand: Command = {
  summary: 'find the best options for a trace, as code to paste',
  operands: sourceOperand,
  options: {
    techniques: { value: 'names', help: `some of ${techniqueHelp}, separated by commas (all)` },
    seconds: { value: 'n', help: 'how long the finalists run against each other, in seconds (8)' },
    exhaustive: { help: 'try every technique with every cell size and margin on all frames: slow' },
    report: { value: 'file', help: 'write a self-contained HTML page with plots' },
    ...sourceOptions,
  },
  async run(input, terminal) {
    const techniques = input.names('techniques', BroadPhase.techniques) ?? BroadPhase.techniques;
    const seconds = input.number('seconds', { least: 0, most: 3600 }) ?? 8;
    const { source, first } = await openSource(input, terminal);
    const [path] = input.operands;
    if (isEmpty(source)) throw new TraceError(`${path}: no frame has boxes to tune on`, -1, 0);
    const report = input.text('report');
    if (report !== undefined) await checkWritable('--report', report, [path]);
    const progress = progressBar(terminal);
    const tuned = tune(source, {
      techniques,
      seconds,
      exhaustive: input.has('exhaustive'),
      progress: (what, done, total) => progress.show(what, done, total),
    });
    progress.end();
    for (const frame of tuned.frames) frame.index += first;
    const writeReport = async () => {
      if (report !== undefined) await write(report, reportOf(basename(path), source.dimensions, tuned));
    };
    if (input.has('json')) {
      await writeReport();
      terminal.out(`${JSON.stringify(tuned)}\n`);
      return exitCode.ok;
    }
    const rows = tuned.finalists.map(({ ms, ...candidate }) => [
      nameOf(candidate),
      time(ms.mean),
      `${(ms.mean / tuned.best.ms.mean).toFixed(2)}x`,
      ...[ms.p95, ms.max].map(time),
    ]);
    const at = tuned.finalists.indexOf(tuned.best);
    terminal.out(table(terminal, ['finalists', 'mean ms', 'vs. recommended', '95 %', 'worst'], rows, at));
    terminal.out(
      `\n${wrap(verdictOf(tuned), terminal.columns).join('\n')}\n\n${tuned.code.replaceAll(/^(?=.)/gm, '  ')}\n`,
    );
    await writeReport(); // the result is printed before this, which may fail
    if (report !== undefined) terminal.out(`\nreport: ${report}\n`);
    return exitCode.ok;
  },
};

function isEmpty(source: FrameSource): boolean {
  for (const { count } of source) if (count > 0) return false;
  return true;
}
