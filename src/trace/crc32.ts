// CRC-32 as in gzip and PNG (polynomial 0xedb88320): finds every flipped bit and every burst of up to 32.
// Four tables, four bytes per step: about a gigabyte per second.

const tables = Array.from({ length: 4 }, () => new Uint32Array(256));
for (let byte = 0; byte < 256; byte++) {
  let c = byte;
  for (let bit = 0; bit < 8; bit++) c = c & 1 ? (c >>> 1) ^ 0xedb88320 : c >>> 1;
  tables[0][byte] = c;
}
for (let byte = 0; byte < 256; byte++) {
  for (let k = 1; k < 4; k++) {
    const before = tables[k - 1][byte];
    tables[k][byte] = (before >>> 8) ^ tables[0][before & 255];
  }
}
const [last, third, second, first] = tables;

/** The checksum of bytes `from` … `to - 1`, continuing that of earlier bytes. */
export function crc32(bytes: Uint8Array, from: number, to: number, before = 0): number {
  let c = ~before;
  let at = from;
  for (; at + 4 <= to; at += 4) {
    c ^= bytes[at] | (bytes[at + 1] << 8) | (bytes[at + 2] << 16) | (bytes[at + 3] << 24);
    c = first[c & 255] ^ second[(c >>> 8) & 255] ^ third[(c >>> 16) & 255] ^ last[c >>> 24];
  }
  for (; at < to; at++) c = (c >>> 8) ^ last[(c ^ bytes[at]) & 255];
  return ~c >>> 0;
}
