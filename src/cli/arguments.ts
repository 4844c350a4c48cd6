// How a command is described: its arguments and options by name, its exit codes, and where it writes. parser.ts derives
// parsing and help from that.

/** Exit codes: what a script can rely on. */
export const exitCode = {
  /** All went well. */
  ok: 0,
  /** The pairs are wrong: `replay --verify` or `compare` found a difference. */
  different: 1,
  /** The command line is wrong. */
  usage: 2,
  /** A file is broken, too new, or not a trace; or a row of it is not a box. */
  badTrace: 3,
  /** A file cannot be read or written. */
  files: 4,
  /** A package that the command needs is not installed. */
  missing: 5,
  /** The boxes of a trace and their pairs need more memory than there is. */
  memory: 6,
  /** A fault of this program. */
  fault: 70,
} as const;

/** The command line is wrong: says how. */
export class UsageError extends Error {}

export interface Option {
  /** The placeholder of the value in the help; undefined for a switch. */
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
  /** How wide tables may be: unlimited unless the output is a terminal. */
  tableColumns: number;
  /** Whether `out` shows colours. */
  colour: boolean;
}

export interface Command {
  summary: string;
  /** The arguments without a dash, in order: their names, and what each is. */
  operands: Readonly<Record<string, string>>;
  options: Readonly<Record<string, Option>>;
  /** Returns the exit code. */
  run(input: Input, terminal: Terminal): Promise<number>;
}

/** The range of a number, both ends included. */
export interface Range {
  least: number;
  most?: number;
  whole?: boolean;
}

/** The value of an option, as errors name it. */
export const named = (text: string): string => text.trim() || 'empty';

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
      const expected = `${whole ? 'an integer' : 'a number'} from ${least}${upTo}`;
      throw new UsageError(`--${name} is ${named(text)}, expected ${expected}`);
    }
    return value;
  }

  /** One of the names, or several, separated by commas. */
  names<Name extends string>(name: string, known: readonly Name[]): Name[] | undefined {
    const names = this.text(name)
      ?.trim()
      .split(/\s*,\s*/);
    for (const each of names ?? []) {
      if (!known.includes(each as Name)) {
        throw new UsageError(`--${name}: no ${each || 'empty name'}, expected one of ${known.join(', ')}`);
      }
    }
    return names as Name[] | undefined;
  }
}
