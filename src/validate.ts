// What is wrong with a space whose invariants do not hold, in words.
import type { KernelInstance } from './kernel/instance.ts';

/** By the kernel's number of them: see Space::validate in kernel/space/space.hpp. */
const broken = [
  '',
  'ids and slots do not name each other, at id',
  'a box has a NaN or a minimum above its maximum, id',
  'a box is not what its numbers are rounded to, id',
  '',
  'a pair is not in order, number',
];

export function validate(instance: KernelInstance): void {
  const code = instance.kernel.validate();
  if (code !== 0) throw new Error(`validate: ${broken[code]} ${instance.io()[0]}`);
}

/** The boxes of what the last update has used, to be drawn. */
export function structure(instance: KernelInstance): Float32Array {
  try {
    const { kernel } = instance;
    const at = kernel.structure();
    return new Float32Array(kernel.memory.buffer, at, kernel.structure_count() * instance.width);
  } catch (error) {
    instance.recover(error, 'structure');
  }
}
