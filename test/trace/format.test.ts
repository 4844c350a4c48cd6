// The trace format: what is written is read, to the last bit; what is broken is told apart, and where.
import { readFileSync } from 'node:fs';
import { gunzipSync } from 'node:zlib';
import { openAny, openTrace, readTrace, TraceError, TraceWriter } from 'broadphase/trace';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { crc32 } from '../../src/trace/crc32.ts';
import { concat, factsOf, type GivenFrame, someFrames, write } from '../support/random-frames.ts';
import { runs, seed } from '../support/runs.ts';

const numRuns = runs(200);

function read(dimensions: number, bytes: Uint8Array) {
  return Array.from(openTrace(bytes), (frame) => factsOf(dimensions, frame));
}

async function* inPieces(bytes: Uint8Array, size: number) {
  for (let at = 0; at < bytes.length; at += size) yield bytes.subarray(at, at + size);
}

async function readInPieces(bytes: Uint8Array, size: number) {
  const frames = [];
  for await (const frame of readTrace(inPieces(bytes, size))) frames.push(factsOf(frame.dimensions, frame));
  return frames;
}

describe.each([2, 3] as const)(`in ${'%d'} dimensions (SEED=${seed})`, (dimensions) => {
  test('what is written is read, at once and as a stream', async () => {
    const property = fc.asyncProperty(
      someFrames(dimensions),
      fc.integer({ min: 1, max: 300 }),
      async (frames, size) => {
        const given = frames.map((frame) => factsOf(dimensions, frame));
        const bytes = write(dimensions, frames);
        expect(read(dimensions, bytes)).toEqual(given);
        expect(await readInPieces(bytes, size)).toEqual(given);
      },
    );
    await fc.assert(property, { seed, numRuns });
  });

  test('what is cut off or has flipped bits is an error with a place, or the frames before are exact', async () => {
    const damage = fc.array(fc.tuple(fc.nat(1e6), fc.integer({ min: 0, max: 7 })), { minLength: 1, maxLength: 4 });
    const property = fc.asyncProperty(
      someFrames(dimensions),
      damage,
      fc.option(fc.nat(1e6)),
      async (frames, flips, cut) => {
        const whole = write(dimensions, frames);
        const broken = whole.slice(0, cut === null ? whole.length : cut % whole.length);
        for (const [at, bit] of flips) if (broken.length > 0) broken[at % broken.length] ^= 1 << bit;
        const given = frames.map((frame) => factsOf(dimensions, frame));
        if (Buffer.compare(broken, whole) === 0) return;
        expect(() => read(dimensions, broken)).toThrow(TraceError);
        await expect(readInPieces(broken, 64)).rejects.toThrow(/^trace: (header|frame \d+), byte \d+: /);
        if (broken.length < 16 || Buffer.compare(broken.subarray(0, 16), whole.subarray(0, 16)) !== 0) return;
        const salvaged = openTrace(broken, { salvage: true });
        const facts = Array.from(salvaged, (frame) => factsOf(dimensions, frame));
        expect(facts).toEqual(given.slice(0, facts.length));
        expect(salvaged.fault).toBeInstanceOf(TraceError);
      },
    );
    await fc.assert(property, { seed, numRuns });
  });

  test('bodies made up at random, with checksums that are right, never crash or hang', () => {
    // The writer's own checksum is used on bodies that it did not make: what a hostile file would do.
    const property = fc.property(fc.uint8Array({ minLength: 1, maxLength: 60 }), fc.boolean(), (body, early) => {
      const frames = early ? [] : [{ boxes: new Float32Array(4 * dimensions) }];
      const bytes = forge(dimensions, frames, body);
      try {
        for (const frame of openTrace(bytes)) expect(frame.boxes.length).toBeLessThan(60 * 2 * dimensions);
      } catch (error) {
        expect(error).toBeInstanceOf(TraceError);
      }
    });
    fc.assert(property, { seed, numRuns: 10 * numRuns });
  });
});

/** A trace with one body put in front of the end by hand. */
function forge(dimensions: 2 | 3, frames: GivenFrame[], body: Uint8Array): Uint8Array {
  const good = write(dimensions, frames);
  const endBytes = 8 + 2;
  const start = good.slice(0, good.length - endBytes);
  const lastChecksum = checksumBefore(dimensions, frames);
  const length = Uint8Array.of(body.length, body.length >> 8, body.length >> 16, body.length >> 24);
  const checksum = crc([...length, ...body], lastChecksum);
  return concat([start, length, le(checksum), body]);
}

function checksumBefore(dimensions: 2 | 3, frames: GivenFrame[]): number {
  const writer = new TraceWriter(dimensions);
  const header = writer.header();
  let checksum = new DataView(header.buffer).getUint32(12, true);
  for (const { boxes, ids, rules, ...own } of frames) {
    checksum = new DataView(writer.frame(boxes, ids, rules, own).buffer).getUint32(4, true);
  }
  return checksum;
}

const le = (value: number) => Uint8Array.of(value, value >>> 8, value >>> 16, value >>> 24);

/** CRC-32 bit by bit: written apart from the library's. */
function crc(bytes: readonly number[], before = 0): number {
  let c = ~before;
  for (const byte of bytes) {
    c ^= byte;
    for (let bit = 0; bit < 8; bit++) c = (c >>> 1) ^ (0xedb88320 & -(c & 1));
  }
  return ~c >>> 0;
}

const two = [
  { boxes: Float32Array.of(0, 0, 1, 1, 2, 2, 3, 3) },
  { boxes: Float32Array.of(0, 0, 1, 1, 2, 2.5, 3, 3.5) },
];

describe('errors say where', () => {
  const bytes = write(2, two);

  test('checksums are CRC-32, each going on from the one before', () => {
    const view = new DataView(bytes.buffer);
    expect(view.getUint32(12, true)).toBe(crc([...bytes.subarray(0, 12)]));
    const length = view.getUint32(16, true);
    const covered = [...bytes.subarray(16, 20), ...bytes.subarray(24, 24 + length)];
    expect(view.getUint32(20, true)).toBe(crc(covered, view.getUint32(12, true)));
  });

  test('version 1 is read, and knows of no rules', () => {
    const old = new Uint8Array(gunzipSync(readFileSync('recordings/smash.trace.gz')));
    expect(old[8]).toBe(1);
    expect(openTrace(old).frames).toBe(20);
    const writer = new TraceWriter(2);
    const pieces = [
      writer.header(),
      writer.frame(two[0].boxes, undefined, Uint32Array.of(1, 1, 0, 1, 1, 1)),
      writer.end(),
    ];
    pieces[0][8] = 1;
    let checksum = crc([...pieces[0].subarray(0, 12)]);
    pieces[0].set(le(checksum), 12);
    for (const piece of pieces.slice(1)) {
      checksum = crc([...piece.subarray(0, 4), ...piece.subarray(8)], checksum);
      piece.set(le(checksum), 4);
    }
    expect(() => openTrace(concat(pieces))).toThrow('frame 0, byte 25: a frame of unknown kind 33');
  });

  test('a newer file is refused as such', () => {
    const newer = bytes.slice();
    newer[8] = 3;
    expect(() => openTrace(newer)).toThrow(
      'trace: header, byte 8: of format 3, but this version reads formats up to 2',
    );
  });

  test('other files are no traces, and those that openAny reads are recognised', () => {
    expect(() => openTrace(new TextEncoder().encode('{"frames": []}  '))).toThrow('header, byte 0: not a trace');
    expect(() => openTrace(Uint8Array.of(0x1f, 0x8b, 8, 0))).toThrow('looks like gzip, which openAny reads');
    expect(() => openTrace(new Uint8Array(Int32Array.of(0x424f5841, 2, 0, 0).buffer))).toThrow(
      'looks like a raw recording, which openAny reads',
    );
    expect(() => openTrace(new Uint8Array())).toThrow('truncated: 0 bytes');
  });

  test('a trace without its end is truncated, and salvaged on request', () => {
    const cut = bytes.subarray(0, bytes.length - 10);
    expect(() => openTrace(cut)).toThrow(`trace: frame 2, byte ${cut.length}: truncated: only 0 of 8 bytes`);
    const salvaged = openTrace(cut, { salvage: true });
    expect(salvaged.frames).toBe(2);
    expect(salvaged.fault?.frame).toBe(2);
    expect(salvaged.fault?.offset).toBe(cut.length);
    expect(openTrace(cut.subarray(0, -1), { salvage: true }).frames).toBe(1);
  });

  test('missing, exchanged or repeated frames are detected, and bytes after the end', () => {
    const writer = new TraceWriter(2);
    const [header, first, second] = [writer.header(), writer.frame(two[0].boxes), writer.frame(two[1].boxes)];
    const end = writer.end();
    expect(openTrace(concat([header, first, second, end])).frames).toBe(2);
    for (const pieces of [
      [header, second, end],
      [header, first, end],
      [header, second, first, end],
      [header, first, first, second, end],
      [header, first, second, end, end],
      [header, first, second, end, Uint8Array.of(0)],
    ]) {
      expect(() => openTrace(concat(pieces))).toThrow(TraceError);
    }
  });

  test.each([
    [
      'rules of more boxes than there are',
      [0x21, 0, 0, 1, 0, 1, 0],
      'the number of new rules is 1, expected at most 0',
    ],
    ['a rule of a place that is not', [0x21, 2, 0, 1, 2, 1, 0], 'a rule for place 2 of 2'],
    ['a rule of unknown kind', [0x21, 2, 0, 1, 0, 32, 0], 'a rule of unknown kind 32'],
    ['a reach below 0', [0x21, 2, 0, 1, 0, 16, 0, 0, 0, 0, 0, 0, 0xf0, 0xbf, 0], 'a reach of -1'],
    ['a group of more than 32 bits', [0x21, 2, 0, 1, 0, 8, 255, 255, 255, 255, 127, 0], 'a group is 34359738367'],
    ['a layer of more than 32 bits', [0x21, 2, 0, 1, 0, 2, 255, 255, 255, 255, 127, 1, 0], 'a layer is 34359738367'],
    ['an unknown kind', [7], 'unknown kind'],
    ['changes before any snapshot', [2, 0, 0, 0], 'not a snapshot'],
    [
      'sixteen million boxes in ten bytes',
      [1, 0x80, 0x80, 0x80, 8, 0, 0],
      '16777216 boxes are new, but only 0 of them',
    ],
    [
      'the same, said to be there',
      [1, 0x80, 0x80, 0x80, 8, 0, 1, 0, 0x80, 0x80, 0x80, 8],
      'sizes of numbers would take',
    ],
    ['more boxes than ids', [1, 0x81, 0x80, 0x80, 8], 'expected at most 16777216'],
    ['a number of 36 bits', [1, 0xff, 0xff, 0xff, 0xff, 0xff, 1], 'more than 32 bits'],
    ['an id for a box that is not', [1, 1, 1, 1, 5, 1, 0, 1, 0, 0], 'place 1 of 1'],
    ['an id twice', [1, 2, 1, 1, 0, 1, 0, 2, 0, 0, 0, 0], 'id 0 appears twice'],
    ['a float of seven bytes', [1, 1, 0, 1, 0, 1, 7, 0, 1, 2, 3, 4, 5, 6, 7], 'has 7 bytes'],
    ['an empty run', [1, 1, 0, 1, 1, 0], 'empty run'],
    ['a run past the end', [1, 1, 0, 1, 1, 1], 'up to 2 of 1'],
    ['a bad box', [1, 1, 0, 1, 0, 1, 1, 1, 2, 1], 'which is not a box'],
    ['bytes left over', [1, 0, 0, 0, 9], '1 bytes too many'],
    ['an end that counts wrongly', [0, 3], 'the end frame counts 3 frames, but 0'],
  ])('%s', (_, body, message) => {
    expect(() => openTrace(forge(2, [], Uint8Array.from(body)))).toThrow(message);
  });

  test('a length of gigabytes takes no memory', async () => {
    const head = concat([new TraceWriter(2).header(), le(0xffffffff), le(0)]);
    expect(() => openTrace(head)).toThrow('its length is 4294967295');
    const large = concat([new TraceWriter(2).header(), le(2 ** 29), le(0)]);
    expect(() => openTrace(large)).toThrow('truncated: only 8 of 536870920');
    await expect(readInPieces(large, 5)).rejects.toThrow('truncated: only 8 of 536870920');
  });

  test('what is no frame is not written', () => {
    const writer = new TraceWriter(2);
    expect(() => writer.frame(new Float32Array(3))).toThrow('expected 4 for each');
    expect(() => writer.frame(Float32Array.of(0, 0, Number.NaN, 1))).toThrow('box 0 is [0, 0, NaN, 1]');
    expect(() => writer.frame(two[0].boxes, [1])).toThrow('ids.length: got 1, expected 2');
    expect(() => writer.frame(two[0].boxes, [1, 1])).toThrow('id 1 appears twice');
    expect(() => writer.frame(two[0].boxes, [1, 2 ** 24])).toThrow('an id is 16777216');
    expect(() => new TraceWriter(4 as 2)).toThrow('dimensions: got 4, expected 2 or 3');
    expect(writer.frames).toBe(0);
  });
});

test('boxes in steady motion take a few bytes a frame, boxes at rest none', () => {
  const writer = new TraceWriter(2);
  const boxes = Float32Array.from({ length: 4000 }, (_, k) => (k % 4) * 8 + 3 * (k >> 2));
  writer.header();
  const sizes = Array.from({ length: 5 }, () => {
    for (let k = 0; k < 2000; k++) boxes[k] += 0.25;
    return writer.frame(boxes).length;
  });
  expect(sizes[4]).toBeLessThan(500 * 2 + 30);
  expect(writer.frame(boxes).length).toBeLessThan(2500); // they have stopped: that much is news
  expect(writer.frame(boxes).length).toBeLessThan(20);
});

test('a gzip bomb is stopped, and a broken gzip said to be', async () => {
  const { gzipSync } = await import('node:zlib');
  const { gunzip } = await import('broadphase/trace');
  const zipped = gzipSync(new Uint8Array(5_000_000));
  await expect(gunzip(zipped, 1_000_000)).rejects.toThrow('exceeds the limit of 1000000 bytes');
  await expect(openAny(zipped.subarray(0, 2000))).rejects.toThrow('its gzip data is broken');
  await expect(openAny(gzipSync(write(2, two)))).resolves.toMatchObject({ frames: 2, dimensions: 2 });
});

// Whoever sends a trace must not be able to keep its reader busy for longer than the bytes are worth.
describe('many small frames after a large one are opened in time that goes with their bytes', { tags: 'long' }, () => {
  const count = 2 ** 18;
  const varint = (value: number): number[] => (value < 128 ? [value] : [(value & 127) | 128, ...varint(value >>> 7)]);
  const large = varint(count);
  const lastGone = varint(count - 1);
  const kinds: Record<string, number[][]> = {
    'nothing changes': [[2, ...large, 0, 0]],
    'two boxes exchange their ids, and back': [
      [2, ...large, 2, 0, 1, 0, 0, 0],
      [2, ...large, 2, 0, 0, 0, 1, 0],
    ],
    'one box is static, and not': [
      [0x22, ...large, 0, 1, 0, 1, 0],
      [0x22, ...large, 0, 1, 0, 0, 0],
    ],
    'doubles and floats take turns': [
      [0x12, ...large, 0, 1, 0, 1, 0, 0],
      [2, ...large, 0, 0],
    ],
    'the last box goes, and comes back': [
      [2, ...lastGone, 0, 0],
      [2, ...large, 0, 1, ...lastGone, 1, 0, 0],
    ],
  };

  test.each(Object.entries(kinds))('%s', (_, bodies) => {
    const frames = 20_000;
    const first = concat([Uint8Array.of(1, ...large, 0, 1, 0, ...large), new Uint8Array(2 * count)]);
    const header = new TraceWriter(2).header();
    let checksum = new DataView(header.buffer).getUint32(12, true);
    const seal = (body: Uint8Array) => {
      const length = le(body.length);
      checksum = crc32(body, 0, body.length, crc32(length, 0, 4, checksum));
      return concat([length, le(checksum), body]);
    };
    const pieces = [header, seal(first)];
    for (let k = 0; k < frames; k++) pieces.push(seal(Uint8Array.from(bodies[k % bodies.length])));
    pieces.push(seal(Uint8Array.of(0, ...varint(frames + 1))));
    const bytes = concat(pieces);
    const started = performance.now();
    expect(openTrace(bytes).frames).toBe(frames + 1);
    expect(performance.now() - started).toBeLessThan(2000);
  });
});
