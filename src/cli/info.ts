// `broadphase info`: what is in a trace.
import { type Summary, survey } from 'broadphase/trace';
import { type Command, exitCode } from './arguments.ts';
import { openSource, sourceOperand, sourceOptions } from './files.ts';
import { counted, histogram, number, percent, progressBar, table } from './terminal.ts';

export const infoCommand: Command = {
  summary: 'show the contents of a trace: boxes, sizes, density, motion, pairs',
  operands: sourceOperand,
  options: sourceOptions,
  async run(input, terminal) {
    const { source } = await openSource(input, terminal);
    const progress = progressBar(terminal);
    const found = survey(source, (done, total) => progress.show('frames', done, total));
    progress.end();
    if (input.has('json')) {
      terminal.out(`${JSON.stringify(found)}\n`);
      return exitCode.ok;
    }
    const { dimensions, frames, boxes, pairs, moving, sides, world, density, histograms } = found;
    const row = (name: string, { min, median, mean, p95, max }: Summary, show = number) => [
      name,
      ...[min, median, mean, p95, max].map(show),
    ];
    const numbers = `${found.doubles ? 'doubles' : 'float32'}${found.ids ? ', with explicit ids' : ''}${found.rules ? ', with rules' : ''}${found.wrap ? `, in a world of ${found.wrap.join(' × ')} that wraps around` : ''}${found.touching === false ? ', where boxes that only touch are no pairs' : ''}`;
    terminal.out(`${input.operands[0]}: ${dimensions}D, ${counted(frames, 'frame')}, ${numbers}\n\n`);
    terminal.out(
      table(
        terminal,
        ['', 'min', 'median', 'mean', '95 %', 'max'],
        [
          row('boxes', boxes),
          row('pairs', pairs),
          row('moving', moving, percent),
          ...sides.map((side, axis) => row(`size along ${'xyz'[axis]}`, side)),
        ],
      ),
    );
    const extents = Array.from({ length: dimensions }, (_, axis) => number(world[axis + dimensions] - world[axis]));
    terminal.out(
      `\nworld ${extents.join(' × ')}, ${percent(density)} of it covered by boxes (overlaps count several times)\n`,
    );
    terminal.out(`\nboxes by their longest side\n${histogram(histograms.side, terminal.columns)}`);
    terminal.out(`\nboxes by number of overlaps\n${histogram(histograms.overlaps, terminal.columns)}`);
    return exitCode.ok;
  },
};
