// The `broadphase` command: runs a command line, and turns errors into a message and an exit code.
import { TraceError } from 'broadphase/trace';
import { type Command, exitCode, type Terminal, UsageError } from './arguments.ts';
import { compareCommand } from './compare.ts';
import { convertCommand } from './convert.ts';
import { FileError } from './files.ts';
import { generateCommand } from './generate.ts';
import { infoCommand } from './info.ts';
import { initCommand } from './init.ts';
import { MissingPackage } from './join/duckdb.ts';
import { DataError } from './join/source.ts';
import { joinCommand } from './join.ts';
import { runLine } from './parser.ts';
import { replayCommand } from './replay.ts';
import { complain } from './terminal.ts';
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
  try {
    return await runLine(commands, argv, terminal);
  } catch (error) {
    const code = codeOf(error);
    const message = error instanceof Error ? error.message : String(error);
    if (argv.includes('--json')) {
      const place = error instanceof TraceError ? { frame: error.frame, offset: error.offset } : {};
      terminal.out(`${JSON.stringify({ error: { code, message, ...place } })}\n`);
    }
    complain(terminal, code === exitCode.fault && error instanceof Error ? error.stack! : message);
    const [name] = argv;
    if (code === exitCode.usage)
      terminal.err(`Try: broadphase ${name && Object.hasOwn(commands, name) ? `${name} ` : ''}--help\n`);
    return code;
  }
}

function codeOf(error: unknown): number {
  if (error instanceof UsageError) return exitCode.usage;
  if (error instanceof TraceError || error instanceof DataError) return exitCode.badTrace;
  if (error instanceof FileError) return exitCode.files;
  if (error instanceof MissingPackage) return exitCode.missing;
  if (isOutOfMemory(error)) return exitCode.memory;
  return exitCode.fault;
}

/** Whether the library, or Node itself, could not allocate what a trace needs. */
const isOutOfMemory = (error: unknown): boolean =>
  error instanceof RangeError && /out of memory|allocation failed/i.test(error.message);
