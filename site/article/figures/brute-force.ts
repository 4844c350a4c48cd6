// Fig. 2: the two loops of brute force, and the test of two boxes, run one operation at a time on six boxes.
import bruteForceSource from '../../../src/ro/coltech/brute-force.ts?raw';
import techniqueSource from '../../../src/ro/coltech/technique.ts?raw';
import { boxOn, fitWorld, lookOf, text } from '../kit/drawing.ts';
import { columns, counters, createStepper, createView, excerpt, listing, type Sheet, sayer } from '../kit/index.ts';
import { type Box, type BruteForceOperation, recordBruteForce } from '../record.ts';

const world = [0, 0, 220, 120] as const;
const boxes: readonly Box[] = [
  [12, 14, 50, 34],
  [48, 34, 44, 36],
  [112, 12, 40, 30],
  [138, 52, 52, 40],
  [176, 30, 34, 34],
  [26, 82, 46, 26],
];
const lights: Readonly<Record<BruteForceOperation['kind'], string>> = {
  outer: 'for (let i',
  inner: 'for (let j',
  count: 'this.collisionTests++',
  test: 'if (this.aabb2DIntersection',
};

/** The four comparisons of the test, up to the first “no”. */
function questions(i: number, j: number): string {
  const a = boxes[i];
  const b = boxes[j];
  const begins = `Does ${i} begin before ${j} ends`;
  const ends = `Does ${i} end after ${j} begins`;
  const asked: [question: string, left: number, sign: string, right: number, yes: boolean][] = [
    [`${begins}, along x`, a[0], '≤', b[0] + b[2], a[0] <= b[0] + b[2]],
    [`${ends}, along x`, a[0] + a[2], '≥', b[0], a[0] + a[2] >= b[0]],
    [`${begins}, along y`, a[1], '≤', b[1] + b[3], a[1] <= b[1] + b[3]],
    [`${ends}, along y`, a[1] + a[3], '≥', b[1], a[1] + a[3] >= b[1]],
  ];
  const no = asked.find(([, , , , yes]) => !yes);
  if (!no) return `Four times yes: ${i} and ${j} overlap, and the pair is recorded.`;
  const [question, left, sign, right] = no;
  return `${question}? ${left} ${sign} ${right}: no. They are apart, and the test ends.`;
}

function explain(operation: BruteForceOperation): string {
  const { kind, i } = operation;
  if (kind === 'outer') {
    return i < boxes.length ? `i is ${i}: every box after ${i} is compared with it.` : 'i is 6: all are done.';
  }
  const { j } = operation;
  if (kind === 'inner') {
    return j < boxes.length ? `j is ${j}: the next pair is ${i} and ${j}.` : `j is ${j}: no box is left after ${i}.`;
  }
  if (kind === 'count') return `One more comparison: boxes ${i} and ${j}.`;
  return questions(i, j);
}

export function mount(root: HTMLElement): () => void {
  const operations = recordBruteForce(boxes);
  let at = 0;
  const [left, right] = columns(root);

  const code = [
    excerpt(bruteForceSource, 'queryForCollisionPairs()'),
    excerpt(techniqueSource, 'aabb2DIntersection(entityA'),
  ].join('\n\n');
  const source = listing(left, 'ro/coltech/brute-force.ts, technique.ts', code);

  const scene = createView(right, {
    label: 'Six boxes.',
    height: (width) => Math.min(230, width * 0.56),
    draw: (sheet) => drawBoxes(sheet, operations.slice(0, at + 1)),
  });
  const triangle = createView(right, {
    label: 'Which pairs have been compared.',
    height: () => 194,
    draw: (sheet) => drawTriangle(sheet, operations.slice(0, at + 1)),
  });
  triangle.canvas.classList.add('bare');

  const say = sayer(right, true);
  const count = counters(right, { tests: 'Comparisons', pairs: 'Pairs found' });

  const stepper = createStepper(root, {
    steps: operations,
    show(operation, index) {
      at = index;
      source.light(lights[operation.kind]);
      const words = explain(operation);
      say(words);
      count({ tests: operation.tests, pairs: operation.pairs });
      scene.describe(`Six boxes, numbered 0 to 5. ${words}`);
      triangle.describe(`${operation.tests} of 15 pairs have been compared, ${operation.pairs} of them overlap.`);
      scene.redraw();
      triangle.redraw();
    },
  });
  return () => stepper.stop();
}

/** The boxes after these operations: those that collide, and those that the last one is about. */
function drawBoxes(sheet: Sheet, done: readonly BruteForceOperation[]): void {
  const { ctx, colors } = sheet;
  const fit = fitWorld(sheet, world);
  const now = done[done.length - 1];
  const pair = now.kind === 'outer' ? [now.i] : [now.i, now.j];
  boxes.forEach((box, id) => {
    const hit = done.some((each) => each.kind === 'test' && each.hit && (each.i === id || each.j === id));
    const look = lookOf(colors, hit ? 'hit' : 'alone', String(id));
    boxOn(ctx, fit, box, pair.includes(id) ? { ...look, line: colors.now, lineWidth: 3 } : look);
  });
}

/** A square for each pair: not compared so far, compared, colliding. The pair of the last operation has a frame. */
function drawTriangle({ ctx, width, height, colors }: Sheet, done: readonly BruteForceOperation[]): void {
  const side = 24;
  const x = Math.round((width - boxes.length * side) / 2);
  const y = height - boxes.length * side - 6;
  const square = (i: number, j: number) => [x + j * side + 1.5, y + i * side + 1.5, side - 3, side - 3] as const;
  const hits = new Map<string, boolean>();
  for (const each of done) if (each.kind === 'test') hits.set(`${each.i}:${each.j}`, each.hit);
  for (let i = 0; i < boxes.length; i++) {
    text(ctx, String(i), x + (i + 0.5) * side, y - 11, colors.muted);
    text(ctx, String(i), x - 12, y + (i + 0.5) * side, colors.muted);
    for (let j = 0; j < boxes.length; j++) {
      const hit = hits.get(`${i}:${j}`);
      ctx.fillStyle = hit === undefined ? (j > i ? colors.page : 'transparent') : hit ? colors.hit : colors.box;
      ctx.fillRect(...square(i, j));
      ctx.strokeStyle = j > i ? colors.grid : colors.line;
      ctx.lineWidth = 1;
      if (j > i) ctx.strokeRect(...square(i, j));
      else ctx.fillRect(x + j * side + side / 2, y + i * side + side / 2, 1, 1);
    }
  }
  const now = done[done.length - 1];
  if (now.kind !== 'outer' && now.j < boxes.length) {
    ctx.strokeStyle = colors.now;
    ctx.lineWidth = 2.5;
    ctx.strokeRect(...square(now.i, now.j));
  }
  text(ctx, 'i', x - 30, y + boxes.length * side * 0.5, colors.muted);
  text(ctx, 'j', x + boxes.length * side * 0.5, y - 30, colors.muted);
}
