// The recorded scenes in the repository, a few frames each.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { gunzipSync } from 'node:zlib';
import { type Recording, readRecording } from '../../src/scenes/recorded.ts';

const files = {
  rain: '../../site/public/traces/rain.bin.gz',
  junkyard: '../traces/junkyard.bin.gz',
  smash: '../traces/smash.bin.gz',
  spinner: '../traces/spinner.bin.gz',
  tumbler: '../traces/tumbler.bin.gz',
  'rapier3d-freefall10k': '../traces/rapier3d-freefall10k.bin.gz',
  'rapier3d-gravity8k': '../traces/rapier3d-gravity8k.bin.gz',
};

export type TraceName = keyof typeof files;

export const traceNames = Object.keys(files) as TraceName[];

export const traceFile = (name: TraceName): string => fileURLToPath(new URL(files[name], import.meta.url));

export function readTrace(name: TraceName): Recording {
  return readRecording(gunzipSync(readFileSync(traceFile(name))));
}
