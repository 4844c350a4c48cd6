// How the numbers of a changed box are written: each as its distance, counted in representable numbers, from a
// prediction that reader and writer both make. A minimum is expected to keep its speed, a maximum to keep its distance
// from the minimum. So a box in steady motion leaves little more than zeros. Arithmetic in doubles is the same on every
// machine, and so are predictions. Bits are compared as integers, so nothing is lost, not even the sign of a zero.

const float = new Float32Array(1);
const floatBits = new Int32Array(float.buffer);
const double = new Float64Array(1);
const doubleBits = new Int32Array(double.buffer);
/** The order of the halves of a double. */
const low = new Uint8Array(Uint16Array.of(1).buffer)[0] === 1 ? 0 : 1;
const high = 1 - low;

/** Maps the bits of numbers to integers in the same order; its own inverse. */
const ordered = (bits: number): number => bits ^ ((bits >> 31) & 0x7fffffff);

/**
 * The predicted number `k` of a box.
 * @param was the box in the frame before, at `at` in the array
 * @param before the box two frames ago, at the same place
 * @param now the numbers before `k`, at the same place
 */
export function predict(
  was: Float64Array,
  before: Float64Array,
  now: Float64Array,
  at: number,
  k: number,
  dimensions: number,
): number {
  const i = at + k;
  const expected =
    k < dimensions ? was[i] + (was[i] - before[i]) : now[i - dimensions] + (was[i] - was[i - dimensions]);
  return Number.isNaN(expected) ? was[i] : expected;
}

/**
 * Writes the distance of `value` from `expected`, lowest byte first and without the zero bytes at the end.
 * @returns how many bytes that were: up to 4, and up to 8 for doubles
 */
export function putDistance(bytes: Uint8Array, at: number, value: number, expected: number, doubles: boolean): number {
  let size = 0;
  if (!doubles) {
    float[0] = value;
    const bits = ordered(floatBits[0]);
    float[0] = expected;
    const distance = (bits - ordered(floatBits[0])) | 0;
    for (let rest = (distance << 1) ^ (distance >> 31); rest !== 0; rest >>>= 8) bytes[at + size++] = rest;
    return size;
  }
  double[0] = value;
  const sign = doubleBits[high] >> 31;
  const valueHigh = ordered(doubleBits[high]);
  const valueLow = doubleBits[low] ^ sign;
  double[0] = expected;
  const expectedLow = doubleBits[low] ^ (doubleBits[high] >> 31);
  const borrow = valueLow >>> 0 < expectedLow >>> 0 ? 1 : 0;
  const lower = (valueLow - expectedLow) | 0;
  const upper = (valueHigh - ordered(doubleBits[high]) - borrow) | 0;
  const negative = upper >> 31;
  const restHigh = ((upper << 1) | (lower >>> 31)) ^ negative;
  const restLow = (lower << 1) ^ negative;
  for (let rest = restLow; rest !== 0; rest >>>= 8) bytes[at + size++] = rest;
  if (restHigh === 0) return size;
  while (size < 4) bytes[at + size++] = 0;
  for (let rest = restHigh; rest !== 0; rest >>>= 8) bytes[at + size++] = rest;
  return size;
}

/** The number at the distance from `expected` that is read from `size` bytes. */
export function takeDistance(bytes: Uint8Array, at: number, size: number, expected: number, doubles: boolean): number {
  let restLow = 0;
  let restHigh = 0;
  for (let k = 0; k < size && k < 4; k++) restLow |= bytes[at + k] << (8 * k);
  if (!doubles) {
    const distance = (restLow >>> 1) ^ -(restLow & 1);
    float[0] = expected;
    floatBits[0] = ordered((ordered(floatBits[0]) + distance) | 0);
    return float[0];
  }
  for (let k = 4; k < size; k++) restHigh |= bytes[at + k] << (8 * (k - 4));
  const negative = -(restLow & 1);
  const lower = ((restLow >>> 1) | (restHigh << 31)) ^ negative;
  const upper = (restHigh >>> 1) ^ negative;
  double[0] = expected;
  const expectedLow = doubleBits[low] ^ (doubleBits[high] >> 31);
  const sum = (expectedLow >>> 0) + (lower >>> 0);
  const sumHigh = (ordered(doubleBits[high]) + upper + (sum > 0xffffffff ? 1 : 0)) | 0;
  doubleBits[low] = sum ^ (sumHigh >> 31);
  doubleBits[high] = ordered(sumHigh);
  return double[0];
}
