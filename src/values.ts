// Type tests that work for values of any realm: an iframe, a vm context or a test runner has its own globals, so
// `instanceof` fails for values that structuredClone or a message brought from there.

const typedArray = Object.getPrototypeOf(Uint8Array.prototype) as object;
const typedArrayTag = Object.getOwnPropertyDescriptor(typedArray, Symbol.toStringTag)!.get!;

/** Whether a value is a typed array of this name, such as Float32Array. */
export const isTypedArray = (value: unknown, name: string): boolean => typedArrayTag.call(value) === name;

export const isFloat32Array = (value: unknown): value is Float32Array => isTypedArray(value, 'Float32Array');
export const isFloat64Array = (value: unknown): value is Float64Array => isTypedArray(value, 'Float64Array');

/** Whether the memory of a typed array is still there. If not, even `keys` throws; its length is just 0. */
export function isAttached(numbers: ArrayBufferView): boolean {
  try {
    (numbers as Uint8Array).keys();
    return true;
  } catch {
    return false;
  }
}

export const isModule = (value: unknown): value is WebAssembly.Module => tagOf(value) === 'WebAssembly.Module';

/**
 * Any view of bytes, or all of a buffer, as bytes. Undefined for anything else.
 * @param where the call that got it, for errors
 * @throws TypeError if its memory was transferred or resized
 */
export function bytesOf(value: unknown, where: string): Uint8Array | undefined {
  try {
    if (ArrayBuffer.isView(value)) return new Uint8Array(value.buffer, value.byteOffset, value.byteLength);
    if (/^(Shared)?ArrayBuffer$/.test(tagOf(value))) return new Uint8Array(value as ArrayBuffer);
  } catch (cause) {
    throw new TypeError(`${where}: got detached memory: it was transferred or resized`, { cause });
  }
  return undefined;
}

export const tagOf = (value: unknown): string => Object.prototype.toString.call(value).slice('[object '.length, -1);
