// Two sets of pairs are the same when their fingerprints are: the count, and two sums of well mixed 32-bit hashes,
// which do not depend on the order of the pairs or within a pair, but change if a pair is found twice.

export function fingerprint(pairs) {
  let first = 0;
  let second = 0;
  for (let k = 0; k < pairs.length; k += 2) {
    const low = Math.min(pairs[k], pairs[k + 1]);
    const high = Math.max(pairs[k], pairs[k + 1]);
    first = (first + mix(Math.imul(low, 0x9e3779b1) ^ mix(high))) | 0;
    second = (second + mix(Math.imul(high, 0x85ebca77) ^ mix(low + 0x5bd1e995))) | 0;
  }
  return `${pairs.length / 2} ${(first >>> 0).toString(16)} ${(second >>> 0).toString(16)}`;
}

function mix(value) {
  let hash = value | 0;
  hash = Math.imul(hash ^ (hash >>> 16), 0x7feb352d);
  hash = Math.imul(hash ^ (hash >>> 15), 0x846ca68b);
  return hash ^ (hash >>> 16);
}

const bits = new Uint32Array(1);
const asFloat = new Float32Array(bits.buffer);

/** The fingerprint of the boxes of a frame, as float32: equal for equal frames. */
export function fingerprintOfBoxes(boxes) {
  let hash = boxes.length;
  for (let k = 0; k < boxes.length; k++) {
    asFloat[0] = boxes[k];
    hash = (Math.imul(hash ^ bits[0], 0x01000193) + k) | 0;
  }
  return (hash >>> 0).toString(16);
}
