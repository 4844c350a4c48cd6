// Command lines: Node's own parser, and on top of it what each command takes, checked, with help made from the same.
import { parseArgs } from 'node:util';
import { counted, list, wrap } from './terminal.ts';

/** Exit codes: what a script can rely on. */
export const exitCode = {
  /** All went well. */
  ok: 0,
  /** The pairs are wrong: `replay --verify` or `compare` found a difference. */
  different: 1,
  /** The command line is wrong. */
  usage: 2,
  /** A file is broken, too new, or no trace; or a row of it is no box. */
  badTrace: 3,
  /** A file cannot be read or written. */
  files: 4,
  /** A package that the command needs is not installed. */
  missing: 5,
  /** A fault of this program. */
  fault: 70,
} as const;

/** The command line is wrong: says how. */
export class UsageError extends Error {}

export interface Option {
  /** What stands for the value in the help; left out for a switch. */
  value?: string;
  help: string;
}

/** Where a command writes: results to `out`, all else to `err`. */
export interface Terminal {
  out(text: string): void;
  err(text: string): void;
  /** Whether a person is watching `err`, on a terminal that can rewrite a line. */
  interactive: boolean;
  /** How wide lines may be. */
  columns: number;
}

export interface Command {
  summary: string;
  /** The arguments without a dash, by name. */
  operands: readonly string[];
  options: Readonly<Record<string, Option>>;
  /** Returns the exit code. */
  run(input: Input, terminal: Terminal): Promise<number>;
}

/** Every command has these. */
const common: Record<string, Option> = {
  json: { help: 'write the result as JSON' },
  help: { help: 'show this' },
};

/** What a number may be, both ends included. */
export interface Range {
  least: number;
  most?: number;
  whole?: boolean;
}

/** The arguments of a command, as given; each is checked when it is asked for. */
export class Input {
  readonly operands: readonly string[];
  readonly #values: Readonly<Record<string, string | boolean | undefined>>;

  constructor(operands: readonly string[], values: Readonly<Record<string, string | boolean | undefined>>) {
    this.operands = operands;
    this.#values = values;
  }

  has(name: string): boolean {
    return this.#values[name] !== undefined;
  }

  text(name: string): string | undefined {
    const value = this.#values[name];
    return typeof value === 'string' ? value : undefined;
  }

  number(name: string, { least, most = Infinity, whole = false }: Range): number | undefined {
    const text = this.text(name);
    if (text === undefined) return undefined;
    const value = Number(text);
    const inRange = value >= least && value <= most && value < Infinity;
    if (text.trim() === '' || !inRange || (whole && !Number.isInteger(value))) {
      const upTo = most < Infinity ? ` to ${most}` : '';
      throw new UsageError(`--${name} is ${text}, expected ${whole ? 'an integer' : 'a number'} from ${least}${upTo}`);
    }
    return value;
  }

  /** One of the names, or with commas between them several. */
  names<Name extends string>(name: string, known: readonly Name[]): Name[] | undefined {
    const names = this.text(name)?.split(',');
    for (const each of names ?? []) {
      if (!known.includes(each as Name)) {
        throw new UsageError(`--${name}: no ${each || 'empty name'}, expected one of ${known.join(', ')}`);
      }
    }
    return names as Name[] | undefined;
  }
}

/**
 * Reads the arguments after the name of a command.
 * @throws UsageError that names what is wrong
 */
export function parse(command: Command, argv: readonly string[]): Input {
  const options: Record<string, Option> = { ...common, ...command.options };
  const asked = Object.entries(options).map(
    ([name, { value }]) =>
      [name, { type: value ? 'string' : 'boolean', ...(name === 'help' && { short: 'h' }) }] as const,
  );
  const { values, positionals, tokens } = parseArgs({
    args: [...argv],
    options: Object.fromEntries(asked) as Record<string, { type: 'string' | 'boolean'; short?: string }>,
    allowPositionals: true,
    strict: false, // what is wrong is said below
    tokens: true,
  });
  const input = new Input(positionals, values as Record<string, string | boolean | undefined>);
  for (const token of tokens) if (token.kind === 'option') checkOption(token.name, token.rawName, token.value, options);
  if (positionals.length !== command.operands.length && !input.has('help')) {
    const expected = command.operands.map((name) => `<${name}>`).join(' ');
    throw new UsageError(`expected ${expected}, got ${counted(positionals.length, 'argument')}`);
  }
  return input;
}

function checkOption(name: string, written: string, value: string | undefined, options: Record<string, Option>): void {
  if (!Object.hasOwn(options, name)) {
    const known = Object.keys(options).map((each) => `--${each}`);
    throw new UsageError(`no option ${written}, expected ${known.slice(0, -1).join(', ')} or ${known.at(-1)}`);
  }
  const takes = options[name].value;
  // An option behind this one is not its value; a negative number may be.
  if (takes && (value === undefined || /^-(?!\d)/.test(value))) {
    throw new UsageError(`--${name} has no value, expected --${name} <${takes}>`);
  }
  if (!takes && value !== undefined) throw new UsageError(`--${name} is ${value}, expected no value: it is a switch`);
}

/** What `--help` shows of a command, in lines no wider than so many columns. */
export function helpOf(name: string, command: Command, columns: number): string {
  const options = Object.entries({ ...command.options, ...common }).map(
    ([option, { value, help }]) => [`--${option}${value ? ` <${value}>` : ''}`, help] as const,
  );
  return [
    `broadphase ${[name, ...command.operands.map((operand) => `<${operand}>`)].join(' ')} [options]`,
    '',
    ...wrap(command.summary, columns),
    '',
    list(options, columns),
    '',
  ].join('\n');
}
