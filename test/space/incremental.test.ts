// Long runs of scenes of which little changes, which is what the incremental technique keeps things for: boxes that
// rest, creep, wake, bounce, jump, come and go, change filters. After each update the pairs are those of strip-sweep,
// which keeps nothing; once both are the reference's.
import { BroadPhase, findPairs } from 'broadphase';
import { describe, expect, test } from 'vitest';
import { createRandom } from '../../src/scenes/random.ts';
import { Crowd } from '../support/crowd.ts';
import { expectKeys, expectSamePairs } from '../support/expect-pairs.ts';
import { keysOf, referencePairs } from '../support/reference.ts';
import { setBox } from '../support/set-box.ts';

interface Thing {
  box: number[];
  step: number[];
}

const runs = [
  { dimensions: 2, speed: 0, share: 1, huge: false, exact: true },
  { dimensions: 2, speed: 0.05, share: 1, huge: true, exact: true },
  { dimensions: 2, speed: 0.3, share: 0.1, huge: false, exact: false },
  { dimensions: 2, speed: 0.3, share: 1, huge: true, exact: false },
  { dimensions: 2, speed: 3, share: 0.02, huge: true, exact: true },
  { dimensions: 3, speed: 0.05, share: 0.3, huge: true, exact: true },
  { dimensions: 3, speed: 0.3, share: 0.02, huge: false, exact: false },
  { dimensions: 3, speed: 0.2, share: 0.8, huge: true, exact: true },
] as const;

describe.each(runs)('incremental, $dimensions dimensions, speed $speed of $share, huge $huge', (run) => {
  test.each([1, 2])('finds what strip-sweep finds, seed %i', { tags: 'long' }, (seed) => {
    const random = createRandom(seed);
    const { dimensions } = run;
    const count = 400 + Math.floor(random() * 600);
    const world = 10 * (count / 0.2) ** (1 / dimensions);
    const kept = new BroadPhase({ dimensions, technique: 'incremental' });
    const fresh = new BroadPhase({ dimensions, technique: 'strip-sweep' });
    const things: (Thing | undefined)[] = [];
    const rounded = (x: number) => (run.exact ? Math.fround(x) : x);
    const someBox = () => {
      const scale = run.huge && random() < 0.01 ? world / 5 : 10;
      const low = Array.from({ length: dimensions }, () => rounded(random() * world));
      return [...low, ...low.map((x) => rounded(x + scale * (0.3 + random())))];
    };
    const someStep = () =>
      Array.from({ length: dimensions }, () => (random() < run.share ? (random() * 2 - 1) * run.speed : 0));
    const put = (id: number) => {
      for (const space of [kept, fresh]) setBox(space, id, things[id]!.box);
    };
    for (let id = 0; id < count; id++) {
      things[id] = { box: someBox(), step: someStep() };
      put(id);
    }
    let answered = 0;
    for (let frame = 0; frame < 220; frame++) {
      things.forEach((thing, id) => {
        if (!thing?.step.some((x) => x !== 0)) return;
        thing.box = thing.box.map((x, k) => rounded(x + thing.step[k % dimensions]!));
        thing.step = thing.step.map((x, k) => (thing.box[k]! < 0 || thing.box[k]! > world ? -x : x));
        put(id);
      });
      for (let k = 0; k < 3 && frame % 5 === 4; k++) disturb(Math.floor(random() * things.length));
      if (frame === 180)
        things.forEach((thing, id) => {
          if (thing && random() < 0.5) jump(id);
        });
      kept.update();
      fresh.update();
      expectSamePairs(kept.pairs, fresh.pairs, `frame ${frame}`);
      if (kept.stats.tests !== fresh.stats.tests) answered++;
      expect(kept.stats.candidates, `frame ${frame}`).toBeGreaterThanOrEqual(kept.stats.pairs);
      kept.validate();
    }
    expect(answered, 'updates answered from what is kept').toBeGreaterThan(20);

    function jump(id: number): void {
      things[id]!.box = someBox();
      put(id);
    }
    function disturb(id: number): void {
      const thing = things[id];
      const what = Math.floor(random() * 7);
      if (!thing || what === 0) {
        things[id] = { box: someBox(), step: someStep() };
        put(id);
      } else if (what === 1) {
        for (const space of [kept, fresh]) space.delete(id);
        things[id] = undefined;
      } else if (what === 2) {
        jump(id);
      } else if (what === 3) {
        thing.step = someStep();
      } else if (what === 4) {
        thing.step = thing.step.map(() => 0);
      } else if (what === 5) {
        const isStatic = random() < 0.7;
        for (const space of [kept, fresh]) space.setStatic(id, isStatic);
      } else {
        const layer = 1 << Math.floor(random() * 3);
        for (const space of [kept, fresh]) space.setFilter(id, layer, 5);
      }
    }
  });
});

test('an update in which nothing has changed keeps the pairs and has no events', () => {
  const random = createRandom(5);
  const space = new BroadPhase({ technique: 'incremental', events: true });
  const boxes: number[] = [];
  for (let id = 0; id < 3000; id++) {
    const [x, y] = [random() * 1000, random() * 1000];
    boxes.push(x, y, x + 10, y + 10);
    space.set(id, x, y, x + 10, y + 10);
  }
  space.update();
  for (let frame = 0; frame < 200; frame++) {
    space.set(
      frame % 3000,
      ...(boxes.slice(4 * (frame % 3000), 4 * (frame % 3000) + 4) as [number, number, number, number]),
    );
    space.update();
    expect(space.began.length + space.ended.length).toBe(0);
  }
  expectKeys(space, referencePairs(boxes, 2));
});

test('where all move, what is found is kept, through bounces, new boxes, and a crowd that turns at once', () => {
  const random = createRandom(11);
  const space = new BroadPhase();
  const boxes: number[] = [];
  const steps: number[] = [];
  const add = () => {
    const [x, y] = [random() * 1000, random() * 1000];
    boxes.push(x, y, x + 10, y + 10);
    steps.push(random() - 0.5, random() - 0.5);
  };
  for (let id = 0; id < 2000; id++) add();
  let kept = 0;
  for (let frame = 0; frame < 210; frame++) {
    if (frame > 50) add();
    for (let id = 0; id < steps.length / 2; id++) {
      if (frame === 130 && id < 500) steps[2 * id]! *= -3;
      for (let k = 0; k < 4; k++) boxes[4 * id + k] = Math.fround(boxes[4 * id + k]! + steps[2 * id + (k % 2)]!);
    }
    space.boxes(boxes.length / 4).set(boxes);
    space.update();
    kept += Number(space.stats.technique === 'incremental');
    expectKeys(space, referencePairs(boxes, 2));
  }
  expect(kept).toBeGreaterThan(100);
});

describe.each([2, 3] as const)('a few boxes creep, each in its own direction, %i dimensions', (dimensions) => {
  test.each([250, 400, 800])('what is found among %i boxes is kept', (count) => {
    const random = createRandom(count);
    const world = 10 * (count / 0.2) ** (1 / dimensions);
    const space = new BroadPhase({ dimensions });
    const things = Array.from({ length: count }, () => {
      const low = Array.from({ length: dimensions }, () => random() * world);
      return [...low, ...low.map((x) => x + 10 * random())];
    });
    for (const [id, box] of things.entries()) setBox(space, id, box);
    let kept = 0;
    for (let frame = 0; frame < 250; frame++) {
      for (let creeping = 0; creeping < 5; creeping++) {
        const id = Math.floor(random() * count);
        const step = Array.from({ length: dimensions }, () => random() - 0.5);
        things[id] = things[id]!.map((x, k) => x + step[k % dimensions]!);
        setBox(space, id, things[id]);
      }
      space.update();
      kept += Number(space.stats.technique === 'incremental');
      expectKeys(space, referencePairs(things.flat(), dimensions));
    }
    expect(kept).toBeGreaterThan(40);
  });
});

test.each([2, 3] as const)('what is kept takes little memory, %i dimensions', (dimensions) => {
  const random = createRandom(29);
  const count = 20_000;
  const width = 2 * dimensions;
  const world = 10 * (count / 0.5) ** (1 / dimensions);
  const boxes = new Float32Array(width * count);
  const steps = Float32Array.from({ length: dimensions * count }, () => random() * 0.4 - 0.2);
  for (let k = 0; k < boxes.length; k++) {
    boxes[k] = k % width < dimensions ? random() * world : boxes[k - dimensions]! + 10;
  }
  const space = new BroadPhase({ dimensions });
  let most = 0;
  for (let frame = 0; frame < 150; frame++) {
    for (let k = 0; k < boxes.length; k++) boxes[k]! += steps[Math.floor(k / width) * dimensions + (k % dimensions)]!;
    space.boxes(count).set(boxes);
    most = Math.max(most, space.update().stats.bytes / count);
  }
  expect(space.stats.reason).toContain('are retained');
  expect(most, 'bytes a box').toBeLessThan(dimensions === 2 ? 240 : 360);
  space.dispose();
});

test('few boxes that move fast among many at rest are found', { tags: 'long' }, () => {
  const random = createRandom(3);
  const count = 8000;
  const world = 10 * (count / 0.2) ** (1 / 3);
  const kept = new BroadPhase({ dimensions: 3 });
  const fresh = new BroadPhase({ dimensions: 3, technique: 'strip-sweep' });
  const boxes = new Float32Array(6 * count);
  const steps = new Float32Array(3 * count);
  for (let k = 0; k < 3 * count; k++) {
    const at = 6 * Math.floor(k / 3) + (k % 3);
    boxes[at] = random() * world;
    boxes[at + 3] = boxes[at]! + 10;
    if (k % 300 < 3) steps[k] = random() < 0.5 ? 3 : -3;
  }
  let answered = 0;
  for (let frame = 0; frame < 150; frame++) {
    for (let k = 0; k < 3 * count; k++) {
      const at = 6 * Math.floor(k / 3) + (k % 3);
      if (boxes[at]! + steps[k]! < 0 || boxes[at]! > world) steps[k]! *= -1;
      boxes[at]! += steps[k]!;
      boxes[at + 3] = boxes[at]! + 10;
    }
    for (const space of [kept, fresh]) {
      space.boxes(count).set(boxes);
      space.update();
    }
    answered += Number(kept.stats.reason.includes('are retained'));
    expectSamePairs(kept.pairs, fresh.pairs, `frame ${frame}`);
  }
  expect(answered, 'updates answered from what is kept').toBeGreaterThan(50);
});

// Seeds 61 and 95 found a box that was not in all the cells it touches.
test.each([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 61, 95])('among thousands of boxes, seed %i', { tags: 'long' }, (seed) => {
  const crowd = new Crowd(seed);
  for (let frame = 0; frame < 120; frame++) {
    crowd.step();
    const { expected, found } = crowd.pairs;
    expect(found, `frame ${frame}`).toBe(expected);
  }
  crowd.dispose();
});

test('a box that jumps beside one that turns is not reported twice', () => {
  const space = new BroadPhase();
  const put = (id: number, x: number, y: number) => space.set(id, x, y, x + 10, y + 10);
  for (let frame = 0; frame < 40; frame++) {
    for (let id = 2; id < 300; id++) put(id, id * 50 + frame / 64, 500);
    put(0, frame / 64, 0);
    put(1, 45 + frame / 64, 0);
    space.update();
  }
  expect(space.stats.reason).toMatch(/are retained/);
  put(0, 6, 0); // both leave their fat boxes
  put(1, 51, 0);
  space.update();
  put(0, 20, 9); // one leaves it again; its new one reaches where the other was before it jumped
  put(1, 28, 15);
  space.update();
  expect(space.stats.reason).toMatch(/are retained/);
  expect([...space.pairs]).toEqual([0, 1]);
});

test.each([2, 3] as const)(
  'a box at rest that jumps leaves no pairs behind, %i dimensions',
  { tags: 'long' },
  (dimensions) => {
    const random = createRandom(7);
    const [kept, fresh] = (['incremental', 'strip-sweep'] as const).map(
      (technique) => new BroadPhase({ dimensions, technique }),
    );
    const side = Math.ceil(300 ** (1 / dimensions));
    const count = side ** dimensions;
    const lows = Array.from({ length: count }, (_, id) =>
      Array.from({ length: dimensions }, (_, axis) => 8 * (Math.floor(id / side ** axis) % side)),
    );
    const put = (id: number) => {
      for (const space of [kept!, fresh!]) setBox(space, id, [...lows[id]!, ...lows[id]!.map((x) => x + 10)]);
    };
    for (let id = 0; id < count; id++) put(id);
    let answered = 0;
    for (let frame = 0; frame < 300; frame++) {
      for (let id = 0; id < count; id += 20) {
        lows[id]![0]! += frame % 60 < 30 ? 0.125 : -0.125;
        put(id);
      }
      if (frame > 200 && frame % 3 === 0) {
        const id = 20 * Math.floor((random() * count) / 20) + 1; // rests, beside one that moves
        lows[id] = lows[id]!.map(() => 8 * Math.floor(random() * side));
        put(id);
      }
      for (const space of [kept!, fresh!]) space.update();
      expectSamePairs(kept!.pairs, fresh!.pairs, `frame ${frame}`);
      if (frame > 200 && kept!.stats.tests !== fresh!.stats.tests) answered++;
    }
    expect(answered, 'updates answered from what is kept').toBeGreaterThan(50);
  },
);

test.each([2, 3] as const)(
  'a world that alternately rests and jumps builds new lists only as often as they pay, %i dimensions',
  (dimensions) => {
    const random = createRandom(11);
    const count = 3000;
    const width = 2 * dimensions;
    const world = 10 * (count / 0.2) ** (1 / dimensions);
    const space = new BroadPhase({ dimensions });
    let lists = 0;
    for (let frame = 0; frame < 300; frame++) {
      const boxes = space.boxes(count);
      for (let id = 0; id < count && frame % 2 === 0; id++) {
        for (let axis = 0; axis < dimensions; axis++) {
          boxes[id * width + axis] = random() * world;
          boxes[id * width + dimensions + axis] = boxes[id * width + axis]! + 10;
        }
      }
      space.update();
      if (frame % 2 === 0 && space.stats.reason.includes('are retained')) lists++;
      if (frame % 10 > 1) continue;
      expectSamePairs(space.pairs, findPairs(space.boxes(count).slice(), { dimensions }), `frame ${frame}`);
    }
    expect(lists, 'lists made though all had jumped').toBeLessThan(15);
    space.dispose();
  },
);

test.each([
  ['every 20th', (k: number) => k % 20 === 0],
  ['the first of each 5,120', (k: number) => k % 5120 < 256],
])('who moves is found out whatever the order of the ids: %s', (_, moves) => {
  const random = createRandom(33);
  const count = 20_480;
  const world = Math.sqrt(count * 400);
  const space = new BroadPhase();
  const boxes = new Float32Array(4 * count);
  for (let k = 0; k < count; k++) {
    const [x, y] = [random() * world, random() * world];
    boxes.set([x, y, x + 10, y + 10], 4 * k);
  }
  space.setAll(boxes);
  for (let frame = 0; frame < 200; frame++) {
    for (let k = 0; k < count; k++) {
      if (!moves(k)) continue;
      const at = 4 * k;
      for (const n of [at, at + 2]) boxes[n]! += 0.1;
      space.set(k, boxes[at]!, boxes[at + 1]!, boxes[at + 2]!, boxes[at + 3]!);
    }
    space.update();
  }
  expectKeys(space, referencePairs(boxes, 2));
  expect(space.stats.tests, 'where 5 % move').toBeLessThan(0.4 * count);
  space.dispose();
});

test('boxes that all stand in a row are kept too', () => {
  const random = createRandom(12);
  const count = 3000;
  const boxes = new Float32Array(4 * count);
  for (let id = 0; id < count; id++) {
    const x = random() * 8 * count;
    boxes.set([x, 0, x + 10, 10], 4 * id);
  }
  const space = new BroadPhase().setAll(boxes);
  let answered = 0;
  for (let frame = 0; frame < 220; frame++) {
    for (let id = 0; id < count; id += 20) {
      boxes[4 * id]! += 0.5;
      boxes[4 * id + 2]! += 0.5;
      space.set(id, boxes[4 * id]!, 0, boxes[4 * id + 2]!, 10);
    }
    space.update();
    if (space.stats.reason.includes('are retained')) answered++;
    if (frame % 10 > 1) continue;
    expectSamePairs(space.pairs, findPairs(boxes), `frame ${frame}`);
  }
  expect(answered, 'updates answered from what is kept').toBeGreaterThan(40);
});

test.each([2, 3] as const)(
  'boxes at rest that become static, or cease to, are seen where all are written, %iD',
  { tags: 'long' },
  (dimensions) => {
    const random = createRandom(dimensions);
    const count = 6000;
    const stride = 2 * dimensions;
    const world = 10 * count ** (1 / dimensions);
    const boxes = new Float32Array(stride * count);
    for (let id = 0; id < count; id++) {
      for (let k = 0; k < dimensions; k++) {
        boxes[stride * id + k] = random() * world;
        boxes[stride * id + dimensions + k] = boxes[stride * id + k]! + 10;
      }
    }
    const spaces = (['auto', 'strip-sweep'] as const).map((technique) => new BroadPhase({ dimensions, technique }));
    let answered = 0;
    for (let frame = 0; frame < 260; frame++) {
      const step = frame % 20 < 10 ? 0.25 : -0.25;
      for (let at = 0; at < boxes.length; at += 100 * stride) {
        boxes[at]! += step;
        boxes[at + dimensions]! += step;
      }
      const found = spaces.map((space) => {
        space.boxes(count).set(boxes);
        // All of some rows of ids; with every frame a few more of them.
        const on = frame >= 200 && frame < 230;
        if (frame >= 200) for (let id = frame; id < count; id += 30) space.setStatic(id, on);
        space.update();
        return frame < 195 ? [] : keysOf(space.pairs);
      });
      if (spaces[0]!.stats.reason.includes('are retained')) answered++;
      expect(found[0], `frame ${frame}`).toEqual(found[1]);
    }
    expect(answered, 'updates answered from what is kept').toBeGreaterThan(100);
    for (const space of spaces) space.dispose();
  },
);

test('what is kept of a world at rest is given up while more and more boxes begin to jump', { tags: 'long' }, () => {
  const count = 4000;
  const world = Math.sqrt(count * 200);
  const random = createRandom(3);
  const boxes = new Float32Array(4 * count);
  for (let k = 0; k < count; k++) {
    const [x, y] = [random() * world, random() * world];
    boxes.set([x, y, x + 10, y + 10], 4 * k);
  }
  const steps = Float32Array.from({ length: 4 * count }, () => 2 * random() - 1);
  const kept = new BroadPhase();
  const fresh = new BroadPhase({ technique: 'strip-sweep' });
  const firstMovers = count / 20;
  const settled = 150;
  let [atRest, givenUp] = [0, 0];
  for (let frame = 0; frame < 400; frame++) {
    const speed = frame < settled ? 1 : 12;
    const moving = Math.min(count, firstMovers + (Math.max(0, frame - settled) * count) / 200);
    for (let k = 0; k < moving; k++) {
      for (let axis = 0; axis < 2; axis++) {
        const at = 4 * k + axis;
        if (boxes[at]! < 0 || boxes[at]! > world) steps[at] = -steps[at]!;
        boxes[at]! += speed * steps[at]!;
        boxes[at + 2]! += speed * steps[at]!;
      }
    }
    kept.setAll(boxes).update();
    fresh.setAll(boxes).update();
    if (frame % 5 === 0) expectSamePairs(kept.pairs, fresh.pairs, `frame ${frame}`);
    const { reason } = kept.stats;
    if (frame < settled) atRest += Number(reason.includes('are retained'));
    else givenUp += Number(reason.includes('full rebuild'));
  }
  expect(atRest, 'updates answered from what is kept').toBeGreaterThan(50);
  expect(givenUp, 'updates with a full rebuild').toBeGreaterThan(10);
});

test('auto says what it chose and why', () => {
  const random = createRandom(9);
  const space = new BroadPhase();
  space.set(0, 0, 0, 1, 1).update();
  expect([space.stats.technique, space.stats.reason]).toEqual(['brute-force', 'a handful of boxes']);
  const seen = new Set<string>();
  for (let id = 0; id < 1000; id++) {
    const [x, y] = [random() * 1000, random() * 1000];
    space.set(id, x, y, x + 5, y + 5);
  }
  for (let frame = 0; frame < 120; frame++) {
    space.set(7, frame, 0, frame + 5, 5).update();
    seen.add(`${space.stats.technique}: ${space.stats.reason}`);
  }
  expect([...seen]).toEqual([
    'strip-sweep: full rebuild: how boxes move is being observed',
    'incremental: candidates are retained: boxes are at rest or move little',
  ]);
  for (let frame = 0; frame < 5; frame++) {
    for (let id = 0; id < 1000; id++) {
      const [x, y] = [random() * 1000, random() * 1000];
      space.set(id, x, y, x + 5, y + 5);
    }
    space.update();
  }
  expect(space.stats.reason).toBe('full rebuild: boxes move too far, or there are few');
});
