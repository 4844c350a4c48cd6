// The one-shot functions: boxes in, pairs out, nothing kept.
import { BroadPhase, findPairs, findPairsBetween } from 'broadphase';
import { describe, expect, onTestFinished, test } from 'vitest';
import { createScene, sceneNames } from '../../src/scenes/index.ts';
import { firstDifference } from '../support/expect-pairs.ts';
import { hostileCases } from '../support/hostile-boxes.ts';
import { keysOf, type Numbers, overlap, referencePairs } from '../support/reference.ts';

/** The keys red * 2^24 + blue of [red, blue, …], sorted. */
function bipartiteKeys(pairs: Numbers): Float64Array {
  return Float64Array.from({ length: pairs.length / 2 }, (_, k) => pairs[2 * k] * 2 ** 24 + pairs[2 * k + 1]).sort();
}

function bipartiteReference(red: Numbers, blue: Numbers, dimensions: number): Float64Array {
  const keys: number[] = [];
  for (let i = 0; i < red.length / (2 * dimensions); i++) {
    for (let j = 0; j < blue.length / (2 * dimensions); j++) {
      if (overlap(red, i, blue, j, dimensions)) keys.push(i * 2 ** 24 + j);
    }
  }
  return Float64Array.from(keys).sort();
}

describe('findPairs', () => {
  test('finds the pairs of a few boxes', () => {
    const pairs = findPairs([0, 0, 2, 2, 5, 5, 6, 6, 1, 1, 3, 3]);
    expect(pairs).toEqual(Uint32Array.of(0, 2));
  });

  test.each(sceneNames)('finds the pairs of %s', (name) => {
    const { boxes, dimensions } = createScene(name, 1000);
    const pairs = findPairs(boxes, { dimensions });
    expect(pairs).toBeInstanceOf(Uint32Array);
    for (let k = 0; k < pairs.length; k += 2) if (pairs[k] >= pairs[k + 1]) expect.fail(`pair ${k / 2} is not a < b`);
    expect(firstDifference(keysOf(pairs), referencePairs(boxes, dimensions))).toBeUndefined();
  });

  test.each(BroadPhase.techniques)('takes the technique %s', (technique) => {
    const { boxes } = createScene('mixed2d', 500);
    expect(firstDifference(keysOf(findPairs(boxes, { technique })), referencePairs(boxes, 2))).toBeUndefined();
  });

  test('gives arrays that no later call changes', () => {
    const first = findPairs([0, 0, 2, 2, 1, 1, 3, 3]);
    findPairs(createScene('dense2d', 2000).boxes);
    expect(first).toEqual(Uint32Array.of(0, 1));
  });

  test('refuses bad boxes and options', () => {
    expect(() => findPairs([0, 0, 1, 1, 0, Number.NaN, 1, 1])).toThrow(/1.*NaN/s);
    expect(() => findPairs([0, 0, 1])).toThrow('3');
    expect(() => findPairs([], { dimensions: 4 as never })).toThrow('4');
    expect(() => findPairs(null as never)).toThrow(/null/);
    expect(findPairs([0, 0, 1, 1, 1, 1, 2, 2])).toEqual(Uint32Array.of(0, 1));
  });
});

describe('findPairsBetween', () => {
  test('finds what of the one meets what of the other, and nothing within either', () => {
    const red = [0, 0, 2, 2, 1, 1, 3, 3];
    const blue = [9, 9, 9, 9, 3, 3, 4, 4, 0, 0, 0, 0];
    expect(bipartiteKeys(findPairsBetween(red, blue))).toEqual(bipartiteKeys([0, 2, 1, 1]));
  });

  test.each(sceneNames)('finds the pairs between two times of %s', (name) => {
    const red = createScene(name, 700);
    const blue = createScene(name, 500, { seed: 2 });
    const pairs = findPairsBetween(red.boxes, blue.boxes, { dimensions: red.dimensions });
    expect(pairs).toBeInstanceOf(Uint32Array);
    const expected = bipartiteReference(red.boxes, blue.boxes, red.dimensions);
    expect(firstDifference(bipartiteKeys(pairs), expected)).toBeUndefined();
  });

  describe.each([2, 3] as const)('in %d dimensions', (dimensions) => {
    test.each(hostileCases(dimensions).map((set) => [set.name, set] as const))(
      'finds the pairs within %s',
      (_, set) => {
        const boxes = set.boxes();
        const half = 2 * dimensions * Math.ceil(boxes.length / (4 * dimensions));
        const [red, blue] = [boxes.slice(0, half), Float64Array.from(boxes.slice(half))];
        const pairs = findPairsBetween(red, blue, { dimensions });
        expect(firstDifference(bipartiteKeys(pairs), bipartiteReference(red, blue, dimensions))).toBeUndefined();
      },
    );
  });

  test('takes nothing on either side', () => {
    expect(findPairsBetween([], [0, 0, 1, 1])).toEqual(new Uint32Array());
    expect(findPairsBetween([0, 0, 1, 1], [])).toEqual(new Uint32Array());
    expect(findPairsBetween([], [])).toEqual(new Uint32Array());
  });

  test('refuses bad boxes on either side', () => {
    expect(() => findPairsBetween([0, 0, 1, Number.NaN], [])).toThrow(/0.*NaN/s);
    expect(() => findPairsBetween([], [0, 0, 1, 1, 5, 0, 1, 1])).toThrow(/1.*5/s);
    expect(() => findPairsBetween([0, 0, 1, 1], [5, 0, 1, 1])).toThrow('findPairsBetween: blue: box 0 has minX 5');
    expect(() => findPairsBetween([0, 0, 1], [])).toThrow('3');
  });

  test('rounds nothing if one of the two is float32', () => {
    const single = Float32Array.of(0, 0, 1, 1);
    for (const double of [Float64Array.of(1 + 2 ** -40, 0, 2, 1), [1 + 2 ** -40, 0, 2, 1]]) {
      expect([...findPairsBetween(single, double), ...findPairsBetween(double, single)]).toEqual([]);
    }
  });

  test('takes an ordinary array beside a typed one, and converts nothing in it', () => {
    const typed = Float32Array.of(0, 0, 1, 1);
    expect([...findPairsBetween([5, 5, 6, 6, 1, 1, 2, 2.1], typed)]).toEqual([1, 0]);
    expect([...findPairsBetween(typed, [5, 5, 6, 6, 1, 1, 2, 2.1])]).toEqual([0, 1]);
    const sparse = [0, 0, 1, 1];
    delete sparse[2];
    for (const bad of [sparse, [0, 0, '1', 1], [0, 0, null, 1], [0, 0, 1n, 1]] as number[][]) {
      expect(() => findPairsBetween(typed, bad)).toThrow(
        /^findPairsBetween: blue: maxX of box 0 is .*, expected a number$/,
      );
      expect(() => findPairsBetween(bad, typed)).toThrow(
        /^findPairsBetween: red: maxX of box 0 is .*, expected a number$/,
      );
    }
  });
});

describe('the spare space', () => {
  const scene = (count: number, dimensions: 2 | 3, seed: number) =>
    createScene(dimensions === 2 ? 'mixed2d' : 'mixed3d', count, { seed }).boxes;

  /** A call that names a technique has a space of its own. */
  const fresh = (dimensions: 2 | 3) => ({ dimensions, technique: 'auto' as const });

  test.each([2, 3] as const)(
    'gives the pairs in the order of a fresh one, whatever was before, in %dD',
    (dimensions) => {
      const counts = [2, 3000, 0, 40, 25, 700, 24, 5000, 1, 300, 6000, 30, 3000];
      for (const [k, count] of [...counts, ...counts.toReversed()].entries()) {
        const boxes = scene(count, dimensions, k);
        const given = k % 3 === 1 ? Float64Array.from(boxes, (number) => number + 0.1) : boxes;
        expect(findPairs(given, { dimensions })).toEqual(findPairs(given, fresh(dimensions)));
        const others = scene((count >> 1) + 1, dimensions, k + 100);
        const between = findPairsBetween(given, others, { dimensions });
        expect(between).toEqual(findPairsBetween(given, others, fresh(dimensions)));
        if (k % 4 === 0)
          expect(() => findPairs([...boxes, ...Array(2 * dimensions).fill(Number.NaN)], { dimensions })).toThrow();
      }
    },
  );

  test('is used by one call at a time', () => {
    const inner = Float32Array.of(0, 0, 1, 1, 1, 1, 2, 2, 5, 5, 6, 6, 6, 6, 7, 7);
    const found: Uint32Array[] = [];
    const numbers = [0, 0, 2, 2, 5, 5, 6, 6, 1, 1, 3, 3];
    const outer = new Proxy(numbers, {
      get(target, key) {
        if (key === '5') found.push(findPairs(inner), findPairsBetween(inner, inner.slice(0, 4)));
        return Reflect.get(target, key);
      },
    });
    for (let k = 0; k < 2; k++) {
      found.length = 0;
      expect(findPairs(outer)).toEqual(Uint32Array.of(0, 2));
      expect(found.length).toBeGreaterThan(1);
      for (let at = 0; at < found.length; at += 2) {
        expect(found[at]).toEqual(Uint32Array.of(0, 1, 2, 3));
        expect(bipartiteKeys(found[at + 1])).toEqual(bipartiteKeys([0, 0, 1, 0]));
      }
    }
  });

  test('is made once, but again after a call that threw, and after one that took much memory', () => {
    const { Instance } = WebAssembly;
    let made = 0;
    onTestFinished(() => void Object.assign(WebAssembly, { Instance }));
    WebAssembly.Instance = class extends Instance {
      constructor(module: WebAssembly.Module) {
        super(module);
        made++;
      }
    };
    const makes = (call: () => void) => {
      const before = made;
      call();
      return made - before;
    };
    const few = () => findPairs([0, 0, 1, 1]);
    few();
    expect(makes(few)).toBe(0);
    expect(makes(() => findPairsBetween([0, 0, 1, 1], [0, 0, 1, 1]))).toBe(0);
    expect(makes(() => findPairs(createScene('uniform2d', 20_000).boxes))).toBe(0);
    expect(makes(few)).toBe(0);
    expect(() => findPairs([1, 0, 0, 1])).toThrow(RangeError);
    expect(makes(few)).toBe(1);
    expect(makes(() => findPairs(new Float32Array(4 * 4500)))).toBe(0); // 81 MB of pairs
    expect(makes(few)).toBe(1);
    expect(makes(() => findPairs([0, 0, 1, 1], { technique: 'brute-force' }))).toBe(1);
    expect(makes(few)).toBe(0);
    for (const dimensions of [2, 3] as const) {
      const boxes = Array(2 * dimensions).fill(0);
      findPairs(boxes, { dimensions });
      expect(makes(() => findPairs(boxes, { dimensions }))).toBe(0);
      expect(makes(() => findPairs(boxes, { dimensions, touching: false }))).toBe(1);
    }
  });
});
