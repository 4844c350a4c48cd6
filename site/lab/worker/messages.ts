// The messages between the page and its workers. A worker has one scene and one space, and answers requests.
import type { Stats, TechniqueName } from 'broadphase';

/** Where the boxes come from. */
export type Source =
  | { kind: 'scene'; name: string; boxes: number }
  | { kind: 'trace'; url: string }
  | { kind: 'file'; file: Blob };

export interface Opened {
  dimensions: 2 | 3;
  world: readonly number[];
  frames: number | undefined;
  boxes: number;
}

export interface Setup {
  technique: TechniqueName;
  cellSize: number | undefined;
}

/** What is to be in a picture. */
export interface Wanted {
  /** Frames to go on; 0: the current one again. */
  steps: number;
  /** Whether the boxes are, or only the structure of the technique. */
  boxes: boolean;
  structure: boolean;
  heat: boolean;
  pairs: boolean;
  /** The id of the box that was chosen. */
  chosen: number | undefined;
  /** Arrays of a picture that is no longer shown, for reuse. */
  spare?: Pick<Picture, 'drawn' | 'slots'> | undefined;
}

/** A box that was chosen, and its partners. */
export interface Chosen {
  id: number;
  box: number[];
  /** The number of partners, and the first of them. */
  partnerCount: number;
  partners: number[];
  /** The number of cells it is in. */
  cells: number;
}

export interface HotCell {
  boxes: number;
  box: number[];
}

/** One frame, ready to be drawn. */
export interface Picture {
  index: number;
  boxes: number;
  /** Milliseconds of `update()`; NaN if it did not run again. */
  ms: number;
  /** Of the scene's step, and of all the rest. */
  stepMs: number;
  otherMs: number;
  stats: Stats;
  /** A number that tells sets of pairs apart. */
  digest: number;
  /** Boxes that touch another. */
  touching: number;
  /** How many of `drawn` are cells: they come first, then the boxes. */
  cells: number;
  drawn: Float32Array<ArrayBuffer>;
  /** The colour slot of each. */
  slots: Uint8Array<ArrayBuffer>;
  /** From middle to middle of pairs: both ends, one after the other. */
  lines: Float32Array<ArrayBuffer> | undefined;
  chosen: Chosen | undefined;
  /** The cells with the most boxes. */
  hottest: HotCell[];
  /** JavaScript heap of the worker in bytes, if the browser reports it. */
  heap: number | undefined;
  recorded: { frames: number; bytes: number; full: boolean } | undefined;
}

export interface Cost {
  cellSize: number;
  ms: number;
  tests: number;
}

/** Useful cell sizes for the current scene and technique. */
export interface CellSizes {
  /** Whether the technique uses it. */
  heeded: boolean;
  /** The longest side of a typical box. */
  typical: number;
}

/** Requests to a worker, and its answers. */
export interface Requests {
  open: (source: Source, frame: number) => Opened;
  setup: (setup: Setup) => void;
  picture: (wanted: Wanted) => Picture;
  /** The id of the box at a place (2D), or of the first one that a ray from it hits (3D). */
  pick: (place: readonly number[], reach: number) => number | undefined;
  cellSizes: () => CellSizes;
  cost: (cellSize: number) => Cost;
  record: () => void;
  /** Ends the recording and returns its bytes. */
  recording: () => Uint8Array<ArrayBuffer>;
}

export type Ask<Name extends keyof Requests = keyof Requests> = {
  id: number;
  name: Name;
  args: Parameters<Requests[Name]>;
};

export type Answer = { id: number; value: unknown } | { id: number; error: string };
