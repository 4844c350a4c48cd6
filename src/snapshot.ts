// Why bytes are not a snapshot that can be restored, in words. What a snapshot holds: kernel/space/snapshot.hpp.
import { badValue } from './errors.ts';
import { bytesOf } from './values.ts';

/** Bytes in front of what stands in the space, and the version of them that this library writes. */
export const headerBytes = 24;
const newest = 2;

/** What was given to `restore`, as bytes. */
export function snapshotBytes(value: unknown): Uint8Array {
  return (
    bytesOf(value) ??
    badValue('restore', value, 'the bytes that snapshot() gave, as a Uint8Array or an ArrayBuffer', true)
  );
}

/** `fault` is kernel/space/snapshot.hpp's SnapshotFault. */
export function badSnapshot(fault: number, bytes: Uint8Array, dimensions: 2 | 3, technique: string): never {
  const reasons = [
    '',
    `got ${bytes.length} bytes that are no snapshot, expected what snapshot() gave`,
    `got a snapshot of format ${bytes[4]}, expected at most ${newest}: it was made by a newer version of this library`,
    `got ${bytes.length} bytes, expected another number of them: the snapshot was cut off, or something is behind it`,
    'the snapshot is damaged: its checksum or its header is wrong',
    `got a snapshot of a space with ${bytes[5]! & 15} dimensions, expected ${dimensions}`,
    `got a snapshot of a space with the technique ${technique}, expected one that there is: 'broadphase/all' has all`,
    'the snapshot holds what no space holds, so it was not made by snapshot()',
  ];
  throw new RangeError(`restore: ${reasons[fault]}`);
}
