// Cuts a few frames out of a recorded scene and packs them small (see src/scenes/recorded.ts for the layouts).
//   node scripts/cut-trace.mjs <in.bin.gz> <out.bin.gz> [first frame = 0] [frames = 20]
// All boxes are kept, to the last bit.
import { readFileSync, writeFileSync } from 'node:fs';
import { gunzipSync, gzipSync } from 'node:zlib';

const [input, output, first = '0', frames = '20'] = process.argv.slice(2);
if (!input || !output) {
  console.error('usage: node scripts/cut-trace.mjs <in.bin.gz> <out.bin.gz> [first frame] [frames]');
  process.exit(1);
}

const rawMagic = 0x424f5841;
const packedMagic = 0x424f5850;
const source = gunzipSync(readFileSync(input));
const [magic, dimensions, count, recorded] = [0, 4, 8, 12].map((at) => source.readInt32LE(at));
if (magic !== rawMagic) throw new Error(`${input} is not a raw recording.`);
const from = Number(first);
const kept = Math.min(Number(frames), recorded - from);
if (!(from >= 0 && kept > 0)) throw new Error(`${input} has ${recorded} frames: cannot take ${frames} from ${first}.`);

const stride = 2 * dimensions * count;
const length = stride * kept;
const packed = Buffer.alloc(16 + 4 * length);
[packedMagic, dimensions, count, kept].forEach((value, k) => {
  packed.writeInt32LE(value, 4 * k);
});
const bits = (i) => source.readUInt32LE(16 + 4 * (from * stride + i));
for (let i = 0; i < length; i++) {
  const change = i < stride ? bits(i) : bits(i) ^ bits(i - stride);
  for (let byte = 0; byte < 4; byte++) packed[16 + byte * length + i] = change >>> (8 * byte);
}
const zipped = gzipSync(packed, { level: 9 });
writeFileSync(output, zipped);
console.log(`${output}: ${kept} frames of ${count} boxes, ${zipped.length} bytes`);
