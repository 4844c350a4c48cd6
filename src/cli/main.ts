// The `broadphase` command: finds the subcommand, runs it, and turns what goes wrong into a message and an exit code.
import { TraceError } from 'broadphase/trace';
import { version } from '../../package.json' with { type: 'json' };
import { type Command, exitCode, helpOf, parse, type Terminal, UsageError } from './arguments.ts';
import { compareCommand } from './compare.ts';
import { convertCommand } from './convert.ts';
import { FileError } from './files.ts';
import { generateCommand } from './generate.ts';
import { infoCommand } from './info.ts';
import { initCommand } from './init.ts';
import { MissingPackage } from './join/duckdb.ts';
import { DataError } from './join/source.ts';
import { joinCommand } from './join.ts';
import { replayCommand } from './replay.ts';
import { list, wrap } from './terminal.ts';
import { tuneCommand } from './tune.ts';

const commands: Readonly<Record<string, Command>> = {
  info: infoCommand,
  replay: replayCommand,
  compare: compareCommand,
  tune: tuneCommand,
  convert: convertCommand,
  generate: generateCommand,
  join: joinCommand,
  init: initCommand,
};

/** Runs a command line, given without the program's own name. Returns the exit code. */
export async function main(argv: readonly string[], terminal: Terminal): Promise<number> {
  const [name = '', ...rest] = argv;
  try {
    if (name === '--version') {
      terminal.out(`${version}\n`);
      return exitCode.ok;
    }
    if (['--help', '-h', 'help'].includes(name) && !Object.hasOwn(commands, rest[0] ?? '')) {
      terminal.out(overview(terminal.columns));
      return exitCode.ok;
    }
    if (name === 'help') return await main([rest[0], '--help'], terminal);
    const command = Object.hasOwn(commands, name) ? commands[name] : undefined;
    if (!command) throw new UsageError(name ? `no command ${name}` : 'expected a command');
    const input = parse(command, rest);
    if (input.has('help')) {
      terminal.out(helpOf(name, command, terminal.columns));
      return exitCode.ok;
    }
    return await command.run(input, terminal);
  } catch (error) {
    const code = codeOf(error);
    const message = error instanceof Error ? error.message : String(error);
    if (argv.includes('--json')) {
      const place = error instanceof TraceError ? { frame: error.frame, offset: error.offset } : {};
      terminal.out(`${JSON.stringify({ error: { code, message, ...place } })}\n`);
    }
    terminal.err(`broadphase: ${code === exitCode.fault && error instanceof Error ? error.stack : message}\n`);
    if (code === exitCode.usage)
      terminal.err(`Try: broadphase ${Object.hasOwn(commands, name) ? `${name} ` : ''}--help\n`);
    return code;
  }
}

function codeOf(error: unknown): number {
  if (error instanceof UsageError) return exitCode.usage;
  if (error instanceof TraceError || error instanceof DataError) return exitCode.badTrace;
  if (error instanceof FileError) return exitCode.files;
  if (error instanceof MissingPackage) return exitCode.missing;
  return exitCode.fault;
}

function overview(columns: number): string {
  const calls = Object.entries(commands).map(
    ([name, { summary, operands }]) =>
      [[name, ...operands.map((operand) => `<${operand}>`)].join(' '), summary] as const,
  );
  const codes = [
    ['0', 'all well'],
    ['1', 'wrong pairs'],
    ['2', 'wrong command line'],
    ['3', 'broken trace, or a row that is no box'],
    ['4', 'file trouble'],
    ['5', 'a package missing'],
    ['70', 'a fault here'],
  ] as const;
  return [
    'broadphase <command> [options]',
    '',
    ...wrap(
      'Looks into, replays, compares and tunes on traces: recordings of the boxes of a game. Joins files of boxes.',
      columns,
    ),
    '',
    list(calls, columns),
    '',
    ...wrap(
      'Each takes --help (-h) and --json. A <trace> is a file of broadphase/trace, or a raw recording; gzipped or not. ' +
        '`broadphase --version` says which version this is.',
      columns,
    ),
    '',
    'Exit codes:',
    list(codes, columns),
    '',
  ].join('\n');
}
