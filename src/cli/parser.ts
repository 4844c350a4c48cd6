// Parsing and help, by commander, which is bundled. It suggests names for mistyped ones, prints the version, and wraps
// help. The commands check values themselves.
import { CommanderError, InvalidArgumentError, Command as Parser, Option as ParserOption } from 'commander';
import { version } from '../../package.json' with { type: 'json' };
import { type Command, exitCode, Input, type Option, type Terminal, UsageError } from './arguments.ts';
import { leastText, list, paint } from './terminal.ts';

const about =
  'Inspects and replays traces (recordings of the boxes of a game), and finds the best options for them. Joins files of boxes.';
const meanings: Record<keyof typeof exitCode, string> = {
  ok: 'success',
  different: 'wrong pairs',
  usage: 'wrong command line',
  badTrace: 'damaged trace, or a row that is not a box',
  files: 'a file cannot be read or written',
  missing: 'a package is missing',
  memory: 'not enough memory',
  fault: 'a bug in the command',
};
const codes = Object.entries(exitCode).map(
  ([name, code]) => [`${code}`, meanings[name as keyof typeof exitCode]] as const,
);

/** A following option is not its value; a negative number may be. */
function checkValue(given: string): string {
  if (/^-(?!\d)/.test(given)) throw new InvalidArgumentError('Expected a value, not an option.');
  return given;
}

function optionOf(name: string, { value, help }: Option): ParserOption {
  const option = new ParserOption(`--${name}${value ? ` <${value}>` : ''}`, help);
  return value ? option.argParser(checkValue) : option;
}

/** Adds a command, whose exit code goes to `ended`. */
function addCommand(
  program: Parser,
  name: string,
  command: Command,
  terminal: Terminal,
  ended: (code: number) => void,
): void {
  const made = Object.entries(command.options).map(([option, what]) => [option, optionOf(option, what)] as const);
  const parser = program.command(name).description(command.summary);
  for (const [operand, help] of Object.entries(command.operands)) parser.argument(`<${operand}>`, help);
  for (const [, option] of made) parser.addOption(option);
  parser.action(async () => {
    const given = parser.opts();
    const values = Object.fromEntries(made.map(([option, parsed]) => [option, given[parsed.attributeName()]]));
    ended(await command.run(new Input(parser.args, { ...values, json: program.opts().json }), terminal));
  });
}

/** An error of the parser, in the form of all other errors: on one line. */
const wordsOf = ({ code, message }: CommanderError): string =>
  code === 'commander.help' ? 'expected a command' : message.replace(/^error: /, '').replaceAll('\n', ' ');

/** For help on an unknown command, as words: that name alone, which the parser refuses with a suggestion. */
function helpOfNothing(commands: Readonly<Record<string, Command>>, argv: readonly string[]): string[] | undefined {
  const [help, name] = argv.filter((word) => !word.startsWith('-'));
  return help === 'help' && name !== undefined && !Object.hasOwn(commands, name) ? [name] : undefined;
}

/**
 * Runs a command line, given without the program's own name.
 * @returns the exit code
 * @throws UsageError that says what is wrong
 */
export async function runLine(
  commands: Readonly<Record<string, Command>>,
  argv: readonly string[],
  terminal: Terminal,
): Promise<number> {
  let code: number = exitCode.ok;
  const shownVersion = argv.includes('--json') ? JSON.stringify({ version }) : version;
  const program = new Parser('broadphase')
    .description(about)
    .version(shownVersion, '-v, --version', 'print the version')
    .option('--json', 'write the result as JSON')
    .helpOption('-h, --help', 'show this')
    .helpCommand('help [command]', 'show the help of a command')
    .configureHelp({
      minWidthToWrap: leastText,
      showGlobalOptions: true,
      styleTitle: (title) => paint(terminal, 'bold', title),
      subcommandTerm: (each) => [each.name(), ...each.registeredArguments.map((one) => `<${one.name()}>`)].join(' '),
    })
    .configureOutput({
      writeOut: terminal.out,
      writeErr: () => {}, // main.ts prints errors, like all others
      getOutHelpWidth: () => terminal.columns,
      getErrHelpWidth: () => terminal.columns,
      getOutHasColors: () => terminal.colour,
    })
    .addHelpText('after', `\n${paint(terminal, 'bold', 'Exit codes:')}\n${list(codes, terminal.columns)}`)
    .exitOverride();
  for (const [name, command] of Object.entries(commands)) {
    addCommand(program, name, command, terminal, (ended) => {
      code = ended;
    });
  }
  try {
    await program.parseAsync(helpOfNothing(commands, argv) ?? argv, { from: 'user' });
  } catch (error) {
    if (!(error instanceof CommanderError)) throw error;
    if (error.exitCode !== 0) throw new UsageError(wordsOf(error));
  }
  return code;
}
