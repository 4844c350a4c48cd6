// Looks inside a space: whether its invariants hold, and the cells of its technique.
import { broken } from './generated/abi.ts';
import type { KernelInstance } from './kernel/instance.ts';

export function validate(instance: KernelInstance): void {
  const code = instance.kernel.validate();
  if (code !== 0) throw new Error(`validate: ${broken[code]} ${instance.io()[0]}`);
}

/** The cells, strips or nodes of the last update as boxes, to draw. */
export function structure(instance: KernelInstance): Float32Array {
  try {
    const { kernel } = instance;
    const at = kernel.structure() >>> 0; // WebAssembly addresses are signed in JavaScript
    return new Float32Array(kernel.memory.buffer, at, kernel.structure_count() * instance.width);
  } catch (error) {
    instance.recover(error, 'structure');
  }
}
