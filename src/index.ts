// Placeholder while the kernel is being written: the same names, answered by brute force in TypeScript.
export interface BroadPhaseOptions {
  dimensions?: 2 | 3;
  technique?: string;
  cellSize?: number | readonly number[];
  bounds?: readonly number[];
  margin?: number;
  events?: boolean;
  capacity?: number;
}

export interface Stats {
  technique: string;
  tests: number;
  candidates: number;
  pairs: number;
  cells: number;
  bytes: number;
}

export class BroadPhase {
  static readonly techniques: readonly string[] = ['auto', 'brute-force', 'spatial-grid', 'strip-sweep'];
  technique: string;
  readonly dimensions: 2 | 3;
  readonly stats: Stats = { technique: '', tests: 0, candidates: 0, pairs: 0, cells: 0, bytes: 0 };
  #boxes = new Map<number, number[]>();
  #pairs = new Uint32Array();
  #view: Float32Array | undefined;

  constructor(options: BroadPhaseOptions = {}) {
    this.dimensions = options.dimensions ?? 2;
    this.technique = options.technique ?? 'auto';
  }
  set(id: number, ...box: number[]): this {
    this.#boxes.set(id, box);
    return this;
  }
  setAll(boxes: ArrayLike<number>, count = boxes.length / (2 * this.dimensions)): this {
    const stride = 2 * this.dimensions;
    this.#boxes.clear();
    for (let id = 0; id < count; id++) {
      this.#boxes.set(
        id,
        Array.from({ length: stride }, (_, k) => boxes[id * stride + k]!),
      );
    }
    return this;
  }
  boxes(count: number): Float32Array {
    const length = count * 2 * this.dimensions;
    if (this.#view?.length !== length) this.#view = new Float32Array(length);
    return this.#view;
  }
  delete(id: number): boolean {
    return this.#boxes.delete(id);
  }
  has(id: number): boolean {
    return this.#boxes.has(id);
  }
  get(id: number): number[] | undefined {
    return this.#boxes.get(id);
  }
  clear(): void {
    this.#boxes.clear();
  }
  get size(): number {
    return this.#boxes.size;
  }
  update(): this {
    if (this.#view) this.setAll(this.#view);
    const all = [...this.#boxes];
    const d = this.dimensions;
    const found: number[] = [];
    this.stats.tests = 0;
    for (let i = 0; i < all.length; i++) {
      for (let j = i + 1; j < all.length; j++) {
        const [a, p] = all[i]!;
        const [b, q] = all[j]!;
        this.stats.tests++;
        let hit = true;
        for (let k = 0; k < d; k++) hit &&= p[k]! <= q[k + d]! && q[k]! <= p[k + d]!;
        if (hit) found.push(Math.min(a, b), Math.max(a, b));
      }
    }
    this.#pairs = Uint32Array.from(found);
    this.stats.pairs = this.pairCount;
    this.stats.technique = this.technique;
    return this;
  }
  get pairs(): Uint32Array {
    return this.#pairs;
  }
  get pairCount(): number {
    return this.#pairs.length / 2;
  }
  structure(): Float32Array {
    return new Float32Array();
  }
}
