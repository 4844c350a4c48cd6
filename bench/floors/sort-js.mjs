// A floor, not a contender: one radix sort of the boxes' first minima, three passes of 11 bits, in plain JavaScript.
// Nothing that sorts can be faster. It finds no pairs.
export const dimensions = [2, 3];
export const findsPairs = false;

const digits = 1 << 11;

export function create({ dimensions, count }) {
  const stride = 2 * dimensions;
  const floats = new Float32Array(count);
  const bits = new Int32Array(floats.buffer);
  let keys = new Uint32Array(count);
  let sorted = new Uint32Array(count);
  const places = new Uint32Array(3 * digits);
  return {
    update(boxes) {
      places.fill(0);
      for (let k = 0; k < count; k++) {
        floats[k] = boxes[stride * k];
        const key = (bits[k] ^ ((bits[k] >> 31) | 0x80000000)) >>> 0;
        keys[k] = key;
        places[key & 2047]++;
        places[digits + ((key >>> 11) & 2047)]++;
        places[2 * digits + (key >>> 22)]++;
      }
      for (let pass = 0; pass < 3; pass++) {
        let place = 0;
        for (let digit = pass * digits; digit < (pass + 1) * digits; digit++) {
          const size = places[digit];
          places[digit] = place;
          place += size;
        }
        for (let k = 0; k < count; k++) {
          const key = keys[k];
          sorted[places[pass * digits + ((key >>> (11 * pass)) & 2047)]++] = key;
        }
        [keys, sorted] = [sorted, keys];
      }
      return keys[count - 1];
    },
  };
}
