// The screen and the input, on a canvas that only pretends.
import * as ro from 'broadphase/ro';
import { afterEach, describe, expect, test, vi } from 'vitest';
import { FakeCanvas } from './fake-canvas.ts';

afterEach(() => vi.unstubAllGlobals());

describe('the screen', () => {
  test('shows the world in the units of the canvas, divided by the scale', () => {
    const canvas = new FakeCanvas(400, 300);
    const screen = new ro.Screen(canvas.asElement(), 2);
    expect(screen.size).toEqual({ x: 200, y: 150 });
    expect(canvas.calls.at(-1)).toEqual(['setTransform', 2, 0, 0, 2, 0, 0]);
  });

  test('clears every pixel, whatever the transform was, and leaves it in world units', () => {
    const canvas = new FakeCanvas(400, 300);
    const screen = new ro.Screen(canvas.asElement());
    canvas.drain();
    screen.clear();
    expect(canvas.calls).toEqual([
      ['setTransform', 1, 0, 0, 1, 0, 0],
      ['clearRect', 0, 0, 400, 300],
      ['setTransform', 1, 0, 0, 1, 0, 0],
    ]);
  });

  test('has as many pixels as a dense display can show, at the same size on the page', () => {
    vi.stubGlobal('devicePixelRatio', 2);
    const canvas = new FakeCanvas(400, 300);
    const screen = new ro.Screen(canvas.asElement());
    screen.clear();
    screen.clear();
    expect([canvas.width, canvas.height, canvas.clientWidth, canvas.clientHeight]).toEqual([800, 600, 400, 300]);
    expect(screen.size).toEqual({ x: 400, y: 300 });
    expect(canvas.calls.at(-1)).toEqual(['setTransform', 2, 0, 0, 2, 0, 0]);
  });

  test('follows a change of its size on the page and of the density, and shows the same part of the world', () => {
    const canvas = new FakeCanvas(400, 300, 400);
    const screen = new ro.Screen(canvas.asElement());
    canvas.cssWidth = 357;
    vi.stubGlobal('devicePixelRatio', 1.5);
    screen.clear();
    expect([canvas.width, canvas.height]).toEqual([536, 402]);
    expect(canvas.style.width).toBeUndefined();
    expect(canvas.style.aspectRatio).toBe('400 / 300');
    expect(screen.size).toEqual({ x: 400, y: 300 });
  });

  test('keeps its pixels while the canvas is hidden', () => {
    const canvas = new FakeCanvas(400, 300, 400);
    const screen = new ro.Screen(canvas.asElement());
    canvas.cssWidth = 0;
    screen.clear();
    expect([canvas.width, canvas.height]).toEqual([400, 300]);
  });

  test('refuses a bad scale, and a canvas without a context', () => {
    const canvas = new FakeCanvas(400, 300);
    expect(() => new ro.Screen(canvas.asElement(), 0)).toThrow('scale is 0, expected a finite number above 0');
    expect(() => new ro.Screen(canvas.asElement(), Number.NaN)).toThrow('scale is NaN');
    canvas.context = null;
    expect(() => new ro.Screen(canvas.asElement())).toThrow(/no 2D context/);
  });

  test('is found by the id of its canvas', () => {
    const canvas = new FakeCanvas(10, 10);
    vi.stubGlobal('document', { getElementById: (id: string) => (id === 'game' ? canvas : null) });
    expect(new ro.World('game').screen?.canvas).toBe(canvas);
  });

  test('with debug, the structure of the technique is drawn in every step', () => {
    const structures: [ro.coltech.Technique, strokes: number][] = [
      [new ro.coltech.BruteForce(), 0],
      [new ro.coltech.SpatialGrid(0, 0, 100, 100, 10), 4],
    ];
    for (const [coltech, strokes] of structures) {
      const canvas = new FakeCanvas(100, 100);
      const world = new ro.World(canvas.asElement(), { coltech, debug: true });
      world.addEntity(new ro.Entity(5, 5, 10, 10));
      world.step();
      expect(canvas.drain().filter((name) => name === 'strokeRect')).toHaveLength(strokes);
      world.debug = false;
      world.step();
      expect(canvas.drain()).not.toContain('strokeRect');
    }
  });

  test('the structure of the library is drawn too', () => {
    const canvas = new FakeCanvas(100, 100);
    const technique = new ro.coltech.BroadPhase();
    technique.space.structure = () => Float32Array.of(1, 2, 4, 8, 0, 0, 1, 1);
    technique.draw(canvas.getContext() as CanvasRenderingContext2D);
    expect(canvas.calls).toEqual([
      ['strokeRect', 1, 2, 3, 6],
      ['strokeRect', 0, 0, 1, 1],
    ]);
  });
});

describe('the input', () => {
  test('follows the pointer in world units', () => {
    const canvas = new FakeCanvas(400, 300, 200);
    const { input } = new ro.World(canvas.asElement(), { scale: 2 });
    expect(input?.pointer).toEqual({ x: 0, y: 0, isOver: false, isDown: false });
    canvas.fire('pointermove', { offsetX: 50, offsetY: 75 });
    expect(input?.pointer).toEqual({ x: 50, y: 75, isOver: true, isDown: false });
    canvas.fire('pointerdown', { offsetX: 60, offsetY: 80 });
    expect(input?.pointer).toEqual({ x: 60, y: 80, isOver: true, isDown: true });
    canvas.fire('pointerleave', { offsetX: -1, offsetY: 80 });
    expect(input?.pointer).toMatchObject({ isOver: false, isDown: true });
    canvas.fire('pointerup', {}, canvas.ownerDocument);
    expect(input?.pointer.isDown).toBe(false);
  });

  test('follows the first finger only, and forgets one that the page has taken for scrolling', () => {
    const canvas = new FakeCanvas(100, 100);
    const { input } = new ro.World(canvas.asElement());
    canvas.fire('pointerdown', { offsetX: 10, offsetY: 10 });
    canvas.fire('pointermove', { offsetX: 90, offsetY: 90, isPrimary: false });
    expect(input?.pointer).toMatchObject({ x: 10, y: 10, isDown: true });
    canvas.fire('pointercancel', {}, canvas.ownerDocument);
    expect(input?.pointer).toMatchObject({ isOver: false, isDown: false });
  });

  test('knows the keys that are held while the canvas has the focus, which it can take', () => {
    const canvas = new FakeCanvas(100, 100);
    const { input } = new ro.World(canvas.asElement());
    expect(canvas.tabIndex).toBe(0);
    canvas.fire('keydown', { code: 'ArrowLeft' });
    canvas.fire('keydown', { code: 'KeyA' });
    canvas.fire('keyup', { code: 'KeyA' });
    expect([input?.isDown('ArrowLeft'), input?.isDown('KeyA')]).toEqual([true, false]);
    canvas.fire('blur');
    expect(input?.keys.size).toBe(0);
  });

  test('hears nothing more once it is disposed of', () => {
    const canvas = new FakeCanvas(100, 100);
    const { input } = new ro.World(canvas.asElement());
    input?.dispose();
    canvas.fire('keydown', { code: 'KeyA' });
    canvas.fire('pointerdown', { offsetX: 10, offsetY: 10 });
    expect([input?.keys.size, input?.pointer.isDown]).toEqual([0, false]);
  });
});
