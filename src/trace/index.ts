// What `import 'broadphase/trace'` gives: record a game, read the trace, and find out what suits it best.

export { type Compared, type CompareOptions, compare } from './compare.ts';
export { type Difference, exactPairs } from './exact.ts';
export { type Frame, type FrameSource, formatVersion, TraceError } from './format.ts';
export { exportRecording, gunzip, importRecording, openAny } from './import.ts';
export { type OpenOptions, openTrace, readTrace, Trace } from './reader.ts';
export { type NodeSink, Recording, type RecordOptions, record } from './record.ts';
export { applyFrame, type ReplayedFrame, type ReplayOptions, replay } from './replay.ts';
export type { Bin, Summary } from './statistics.ts';
export { type Survey, survey } from './survey.ts';
export { type Candidate, type Measured, type Parameter, type Tuned, type TuneOptions, tune } from './tune.ts';
export { TraceWriter } from './writer.ts';
