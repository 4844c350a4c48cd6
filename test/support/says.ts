// Checks what the comments in the documentation's examples say: see doc-examples.ts.
import { expect } from 'vitest';

/** `said` is a JavaScript expression, for a typed array with its kind before it. */
export function gives(value: unknown, said: string): void {
  const [, kind, text] = /^(?:(\w+Array) )?(.*)$/s.exec(said)!;
  if (kind) expect((value as object).constructor.name).toBe(kind);
  const plain = ArrayBuffer.isView(value) ? Array.from(value as Uint32Array) : value;
  expect(plain).toEqual(new Function(`return (${text});`)());
}

export function throws(run: () => void, said: string): void {
  const [, kind, message] = /^(\w+)(?:: (.*))?$/s.exec(said)!;
  let error: unknown;
  try {
    run();
  } catch (caught) {
    error = caught;
  }
  expect(error).toBeInstanceOf(Error);
  expect((error as Error).name).toBe(kind);
  if (message) expect((error as Error).message).toContain(message);
}
