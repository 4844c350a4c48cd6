// What the page and its workers say to each other. A worker has one scene and one space; it is asked, and answers.
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
  /** Frames to go on; 0: the one at hand again. */
  steps: number;
  /** Whether the boxes are, or only what the technique made of them. */
  boxes: boolean;
  structure: boolean;
  heat: boolean;
  pairs: boolean;
  /** The id of the box that was chosen. */
  chosen: number | undefined;
  /** Arrays of a picture that is no longer shown, to be used again. */
  spare?: Pick<Picture, 'drawn' | 'slots'> | undefined;
}

/** A box that was chosen: what it is, and whom it meets. */
export interface Chosen {
  id: number;
  box: number[];
  /** How many partners, and the first of them. */
  partnerCount: number;
  partners: number[];
  /** How many cells it is in. */
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
  /** Milliseconds of `update()`; NaN where it did not run again. */
  ms: number;
  /** Of the scene's step, and of all the rest. */
  stepMs: number;
  otherMs: number;
  stats: Stats;
  /** A number that tells sets of pairs apart. */
  digest: number;
  /** Boxes that touch another. */
  touching: number;
  /** How many of `drawn` are cells: they come first, and then the boxes. */
  cells: number;
  drawn: Float32Array<ArrayBuffer>;
  /** The colour slot of each. */
  slots: Uint8Array<ArrayBuffer>;
  /** From middle to middle of pairs: both ends, one after the other. */
  lines: Float32Array<ArrayBuffer> | undefined;
  chosen: Chosen | undefined;
  /** The cells with the most boxes. */
  hottest: HotCell[];
  /** JavaScript heap of the worker in bytes, where it tells. */
  heap: number | undefined;
  recorded: { frames: number; bytes: number; full: boolean } | undefined;
}

export interface Cost {
  cellSize: number;
  ms: number;
  tests: number;
}

/** What cell sizes are of use for the scene and technique at hand. */
export interface CellSizes {
  /** Whether the technique looks at it. */
  heeded: boolean;
  /** The longest side of a usual box. */
  typical: number;
}

/** What can be asked of a worker, and what it answers. */
export interface Requests {
  open: (source: Source, frame: number) => Opened;
  setup: (setup: Setup) => void;
  picture: (wanted: Wanted) => Picture;
  /** The id of the box at a place (2D), or that a ray from it meets first (3D). */
  pick: (place: readonly number[], reach: number) => number | undefined;
  cellSizes: () => CellSizes;
  cost: (cellSize: number) => Cost;
  record: () => void;
  /** Ends the recording and gives its bytes. */
  recording: () => Uint8Array<ArrayBuffer>;
}

export type Ask<Name extends keyof Requests = keyof Requests> = {
  id: number;
  name: Name;
  args: Parameters<Requests[Name]>;
};

export type Answer = { id: number; value: unknown } | { id: number; error: string };
