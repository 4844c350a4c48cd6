// The recorded scenes of recordings/, with a few frames of each that are quick to check.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { gunzipSync } from 'node:zlib';
import { framesOf, type RecordedFrames } from '../../src/scenes/recorded.ts';
import { openTrace } from '../../src/trace/reader.ts';

/** The first frame, and the one after the last. */
const frames = {
  rain: [0, 20],
  junkyard: [14, 20],
  smash: [0, 6],
  spinner: [0, 4],
  tumbler: [0, 8],
  'rapier3d-freefall10k': [0, 2],
  'rapier3d-gravity8k': [0, 2],
};

export type TraceName = keyof typeof frames;

export const traceNames = Object.keys(frames) as TraceName[];

export const traceFile = (name: TraceName): string =>
  fileURLToPath(new URL(`../../recordings/${name}.trace.gz`, import.meta.url));

export const readTrace = (name: TraceName): RecordedFrames =>
  framesOf(openTrace(gunzipSync(readFileSync(traceFile(name)))), ...(frames[name] as [number, number]));
