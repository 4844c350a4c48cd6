/**
 * Record a game, read the trace, and find the best options for it. Times are in milliseconds; frames are counted from
 * 0.
 *
 * @module broadphase/trace
 */

export type { Own, World } from '../watch.ts';
export { type Compared, type CompareOptions, compare } from './compare.ts';
export { type Difference, exactPairs } from './exact.ts';
export { type Frame, type FrameSource, formatVersion, TraceError } from './format.ts';
export { exportRecording, gunzip, importRecording, openAny } from './import.ts';
export { type OpenOptions, openTrace, readTrace, type StreamedFrame, Trace } from './reader.ts';
export { type NodeSink, Recording, type RecordOptions, record } from './record.ts';
export { applyFrame, type ReplayedFrame, type ReplayOptions, replay } from './replay.ts';
export type { Bin, Summary } from './statistics.ts';
export { type Survey, survey } from './survey.ts';
export {
  type Candidate,
  type Curve,
  type CurvePoint,
  type Measured,
  type Parameter,
  type Screened,
  type Tuned,
  type TunedFrame,
  type TuneOptions,
  tune,
} from './tune.ts';
export { TraceWriter } from './writer.ts';
