// Why bytes are not a snapshot that can be restored, in words. What a snapshot holds: kernel/space/snapshot.hpp.
import { badValue } from './errors.ts';
import { bytesOf } from './values.ts';

/** Bytes in front of what stands in the space, and the version of them that this library writes. */
export const headerBytes = 24;
const newest = 2;

/** What was given to `restore`, as bytes. */
export function snapshotBytes(value: unknown): Uint8Array {
  return (
    bytesOf(value) ?? badValue('restore', value, 'the bytes of snapshot(), as a Uint8Array or an ArrayBuffer', true)
  );
}

/** `fault` is kernel/space/snapshot.hpp's SnapshotFault. */
export function badSnapshot(fault: number, bytes: Uint8Array, dimensions: 2 | 3, technique: string): never {
  const reasons = [
    '',
    `got ${bytes.length} bytes that are not a snapshot, expected those of snapshot()`,
    `got a snapshot of format ${bytes[4]}, expected at most ${newest}: it was made by a newer version of this library`,
    `got ${bytes.length} bytes, which is not the snapshot's length: it was cut off, or something follows it`,
    'the snapshot is damaged: its checksum or its header is wrong',
    `got a snapshot of a space with ${bytes[5]! & 15} dimensions, expected ${dimensions}`,
    `got a snapshot of a space with the technique ${technique}, which is not available here: 'broadphase/all' has all`,
    'the snapshot has contents that no space can have, so snapshot() did not make it',
  ];
  throw new RangeError(`restore: ${reasons[fault]}`);
}
