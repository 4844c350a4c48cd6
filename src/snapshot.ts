// A space as bytes, and back. The format is in kernel/space/snapshot.hpp; the messages for bad bytes are here.
import { badInPlace, checkExposed } from './boxes.ts';
import type { Dimensions } from './dimensions.ts';
import { badValue } from './errors.ts';
import { boxesAt, newestSnapshot, snapshotFaults, techniques } from './generated/abi.ts';
import type { KernelInstance } from './kernel/instance.ts';
import { readStats } from './stats.ts';
import { bytesOf } from './values.ts';

/** Bytes of the header: `SnapshotHeader` in the kernel. */
const headerBytes = 24;

export function snapshot(instance: KernelInstance): Uint8Array<ArrayBuffer> {
  if (instance.exposedIsOpen) checkExposed(instance, 'snapshot'); // else an update has seen what was written
  let bad = -1;
  try {
    const at = instance.kernel.save() >>> 0;
    const [length, id] = instance.io() as unknown as [number, number];
    if (id < 0) return new Uint8Array(instance.kernel.memory.buffer, at, length).slice();
    bad = id;
  } catch (error) {
    instance.recover(error, 'snapshot');
  }
  badInPlace(instance, 'snapshot', bad);
}

export function restore(instance: KernelInstance, bytes: Uint8Array | ArrayBuffer): void {
  const source = snapshotBytes(bytes);
  const place = placeOf(instance);
  const io = instance.io();
  // The header first: memory is allocated only for bytes that may be a snapshot, and are as long as their header says.
  const header = new Uint8Array(io.buffer, io.byteOffset, headerBytes);
  header.fill(0);
  header.set(source.subarray(0, headerBytes));
  let fault = 0;
  try {
    const at = instance.kernel.stage_snapshot(source.length) >>> 0;
    fault = instance.io()[0]!;
    if (fault === 0) {
      new Uint8Array(instance.kernel.memory.buffer, at, source.length).set(source);
      instance.ring.forget();
      fault = instance.kernel.restore();
    }
  } catch (error) {
    try {
      instance.recover(error, 'restore');
    } finally {
      if (placeOf(instance) !== place) restored(instance, source); // memory ran out while finding the pairs
    }
  }
  if (fault !== 0) badSnapshot(fault, source, instance.dimensions);
  restored(instance, source);
}

function restored(instance: KernelInstance, source: Uint8Array): void {
  instance.technique = Math.min(source[7]!, techniques.length - 1); // 255 stands for `auto`, the last one
  instance.exposed = undefined;
  readStats(instance);
}

/** The address of the boxes, which changes when others are restored. */
function placeOf(instance: KernelInstance): number {
  instance.kernel.contents();
  return instance.io()[boxesAt]!;
}

/** What was given to `restore`, as bytes. */
function snapshotBytes(value: unknown): Uint8Array {
  return (
    bytesOf(value, 'restore') ??
    badValue('restore', value, 'the bytes of snapshot(), as a Uint8Array or an ArrayBuffer', true)
  );
}

/** `fault` is the number of one of `snapshotFaults`. */
function badSnapshot(fault: number, bytes: Uint8Array, dimensions: Dimensions): never {
  const technique = techniques[bytes[7]!] ?? `number ${bytes[7]}`;
  const reasons: Record<(typeof snapshotFaults)[number], string> = {
    none: '',
    foreign: `got ${bytes.length} bytes that are not a snapshot, expected those of snapshot()`,
    newer: `got a snapshot of format ${bytes[4]}, expected at most ${newestSnapshot}: it was made by a newer version`,
    length: `got ${bytes.length} bytes, which is not the snapshot's length: it was cut off, or more follows it`,
    damaged: 'the snapshot is damaged: its checksum or header is wrong',
    dimensions: `got a snapshot of a space with ${bytes[5]! & 15} dimensions, expected ${dimensions}`,
    technique: `got a snapshot of a space with the technique ${technique}, which is only in 'broadphase/all'`,
    content: 'the snapshot has contents that no space can have: it is forged',
  };
  throw new RangeError(`restore: ${reasons[snapshotFaults[fault]!]}`);
}
