// The world: holds the entities, moves them on step by step, and ties technique, screen and input together.
//
// Positions advance in steps of one fixed length, because the velocity of Verlet integration is a distance per step.
// The loop lets the display call as often as it likes and takes as many steps as the time since then is worth.
import { checkFinite } from './checks.ts';
import { BruteForce } from './coltech/brute-force.ts';
import type { Pair, Technique } from './coltech/technique.ts';
import type { Entity } from './entity.ts';
import { nextFrame } from './frames.ts';
import { Input } from './input.ts';
import { Screen } from './screen.ts';

/** 60 steps per second. */
const DEFAULT_TIME_STEP = 1000 / 60;
/** After a pause of the page the world goes on from where it was, instead of catching up with what it missed. */
const MAX_STEPS_PER_FRAME = 5;
/** Milliseconds a frame may come early and still get its step: the frames of a 60 Hz display are not quite evenly spaced. */
const EARLY = 1;
/** The colour of a technique's structure: a grey that is visible on white and on black. */
const STRUCTURE_COLOR = 'rgb(128 128 128 / 45%)';

/** How a world is set up. Inside the functions, `this` is the world. */
export interface WorldOptions<E extends Entity = Entity> {
  /** Finds the colliding pairs; default `new coltech.BruteForce()`. It must have no entities. */
  coltech?: Technique<E> | undefined;
  /** Draws the structure that the technique searches. */
  debug?: boolean | undefined;
  /** Canvas pixels per world unit; default 1. */
  scale?: number | undefined;
  /** The length of a step of the loop in milliseconds, above 0; default a 60th of a second. */
  timeStep?: number | undefined;
  /** Called once, at the end of construction: the place to add the first entities. */
  init?(this: World<E>): void;
  /** Draws the frame, in place of drawing every entity. Not called without a screen. */
  draw?(this: World<E>, ctx: CanvasRenderingContext2D): void;
  /** Called in every step with the pairs of entities whose boxes overlap. */
  handleCollisions?(this: World<E>, dt: number, pairs: Pair<E>[]): void;
  /** Called at the end of every step. */
  update?(this: World<E>, dt: number): void;
}

const callbackNames = ['init', 'draw', 'handleCollisions', 'update'];
const optionNames = ['coltech', 'debug', 'scale', 'timeStep', ...callbackNames];

/**
 * Holds the entities, moves them on step by step, and ties technique, screen and input together. One step: clear the
 * screen, draw, accelerate all, find the pairs and hand them to `handleCollisions`, move all on by their inertia, and
 * call `update`.
 *
 * @example
 * let collisions = 0;
 * const world = new World(null, {
 *   coltech: new coltech.BroadPhase(),
 *   init() {
 *     this.addEntity(new Entity(0, 0, 10, 10));
 *     this.addEntity(new Entity(5, 5, 10, 10));
 *   },
 *   handleCollisions(dt, pairs) {
 *     collisions += pairs.length;
 *   },
 * });
 * world.step();
 * collisions; // → 1
 */
export class World<E extends Entity = Entity> {
  /** The canvas and its context; null when the world has none. */
  readonly screen: Screen | null;
  /** The pointer and the keys; null when the world has no canvas. */
  readonly input: Input | null;
  /** Whether the technique's structure is drawn. */
  debug: boolean;
  /** The length of a step of the loop in milliseconds. */
  readonly timeStep: number;
  /** The _roId of the next entity. Ids are never given twice. */
  uniq = 0;
  readonly #options: WorldOptions<E>;
  #broadPhase: Technique<E>;
  readonly #entities = new Set<E>();
  /** The entities as an array, until one is added or removed. */
  #list: readonly E[] | undefined;
  #running = false;
  #cancelFrame: (() => void) | null = null;
  /** When the last frame was, in milliseconds; null for the first one after `start`. */
  #lastFrame: number | null = null;
  /** Milliseconds that have passed and have not been stepped through. */
  #due = 0;

  /**
   * @param canvas a canvas, the id of one, or null for a world that draws nothing and needs no page
   * @throws Error for an id that no canvas of the page has, RangeError for a number out of range, TypeError for an unknown
   * option and for a value of another type.
   */
  constructor(canvas: HTMLCanvasElement | string | null, options: WorldOptions<E> = {}) {
    for (const name in options) {
      // Others may have been added to all objects by a script.
      if (!optionNames.includes(name) && Object.hasOwn(options, name)) {
        throw new TypeError(`ro.World: there is no option "${name}", expected one of ${optionNames.join(', ')}`);
      }
      const value = options[name as keyof typeof options];
      if (callbackNames.includes(name) && value !== undefined && typeof value !== 'function') {
        refuse(name, value, 'a function');
      }
    }
    const { coltech = new BruteForce<E>(), debug = false, scale = 1, timeStep = DEFAULT_TIME_STEP } = options;
    if (typeof debug !== 'boolean') refuse('debug', debug, 'true or false');
    checkFinite('ro.World: scale', scale);
    checkFinite('ro.World: timeStep', timeStep);
    expectEmpty(coltech);
    this.screen = canvas === null ? null : new Screen(findCanvas(canvas), scale);
    this.input = this.screen && new Input(this.screen);
    this.debug = debug;
    this.timeStep = timeStep;
    this.#broadPhase = coltech;
    this.#options = options;
    options.init?.call(this);
  }

  /** Frameworks that wrap what they hold in proxies, such as Vue, leave alone objects whose name here is not `Object`. */
  get [Symbol.toStringTag](): string {
    return 'World';
  }

  /**
   * In the order they were added. A new array after one was added or removed, so that a loop over this one may do
   * both as it goes.
   */
  get entities(): readonly E[] {
    this.#list ??= [...this.#entities];
    return this.#list;
  }

  /** The collision technique. If you set another, which must have no entities, those of the previous one move to it. */
  get broadPhase(): Technique<E> {
    return this.#broadPhase;
  }

  /** @throws Error for a technique that has entities already */
  set broadPhase(technique: Technique<E>) {
    if (technique === this.#broadPhase) return;
    expectEmpty(technique);
    for (const entity of this.#entities) technique.addEntity(entity);
    for (const entity of this.#entities) this.#broadPhase.removeEntity(entity);
    this.#broadPhase = technique;
  }

  /** Whether `start` was called, and `stop` was not called since. */
  get isRunning(): boolean {
    return this.#running;
  }

  /**
   * Adds an entity, and gives it its _roId.
   * @throws Error for an entity that is in a world already, RangeError for one whose pos or size is not finite; the
   * world stays as it was.
   *
   * @example
   * const world = new World(null);
   * const entity = new Entity(0, 0, 1, 1);
   * world.addEntity(entity);
   * world.entities.length; // → 1
   * world.addEntity(entity); // throws Error: addEntity: entity 0 is in this world already
   */
  addEntity(entity: E): void {
    if (entity.world !== null) {
      const where = this.#has(entity) ? 'this world' : 'another world';
      throw new Error(`addEntity: entity ${entity._roId} is in ${where} already, expected one that is in none`);
    }
    entity.updateAABB();
    entity._roId = this.uniq;
    this.#broadPhase.addEntity(entity);
    this.uniq++;
    entity.world = this;
    this.#entities.add(entity);
    this.#list = undefined;
  }

  /**
   * Takes an entity out. Allowed at any time, also within a step.
   * @throws Error for an entity that is not in this world; the world stays as it was.
   *
   * @example
   * new World(null).removeEntity(new Entity(0, 0, 1, 1)); // throws Error: is not in this world
   */
  removeEntity(entity: E): void {
    if (!this.#has(entity)) {
      throw new Error(`removeEntity: entity ${entity._roId} is not in this world, expected one that was added to it`);
    }
    this.#broadPhase.removeEntity(entity);
    entity.world = null;
    this.#entities.delete(entity);
    this.#list = undefined;
  }

  /**
   * Draws the frame: what the option `draw` does, or else every entity. Without a screen it does nothing.
   *
   * @example
   * new World(null).draw(); // → undefined
   */
  draw(): void {
    if (!this.screen) return;
    if (this.#options.draw) this.#options.draw.call(this, this.screen.ctx);
    else for (const entity of this.entities) entity.draw();
  }

  /**
   * Moves the world on by one step.
   * @param dt the length of the step in milliseconds, 0 or more, finite; 0 draws and collides but moves nothing
   * @throws RangeError for another dt, before anything is done.
   *
   * @example
   * const world = new World(null);
   * world.step(16);
   * world.step(-1); // throws RangeError: ro.World: dt is -1
   */
  step(dt: number = this.timeStep): void {
    checkFinite('ro.World: dt', dt, 0);

    this.screen?.clear();
    this.draw();

    this.#forEachEntity((entity) => {
      entity.accelerate(dt);
      entity.updateAABB();
    });

    this.#broadPhase.update();
    const pairs = this.#broadPhase.queryForCollisionPairs();
    if (this.debug) this.#drawStructure();
    this.#options.handleCollisions?.call(this, dt, pairs);

    this.#forEachEntity((entity) => {
      entity.inertia(dt);
      entity.updateAABB();
    });

    this.#options.update?.call(this, dt);
  }

  /**
   * Steps in real time, from the next frame on, until `stop`.
   *
   * @example
   * const world = new World(null);
   * world.start();
   * world.isRunning; // → true
   * world.stop();
   * world.isRunning; // → false
   */
  start(): void {
    if (this.#running) return;
    this.#running = true;
    this.#lastFrame = null;
    this.#cancelFrame = nextFrame(this.#frame);
  }

  /**
   * Stops stepping. Allowed at any time, also within a step.
   *
   * @example
   * const world = new World(null);
   * world.stop();
   * world.isRunning; // → false
   */
  stop(): void {
    this.#running = false;
    this.#cancelFrame?.();
    this.#cancelFrame = null;
  }

  readonly #frame = (now: number): void => {
    this.#cancelFrame = null;
    // The first frame after a start is worth one step: how long the world stood still does not matter.
    this.#due = this.#lastFrame === null ? this.timeStep : this.#due + now - this.#lastFrame;
    this.#due = Math.min(this.#due, MAX_STEPS_PER_FRAME * this.timeStep);
    this.#lastFrame = now;
    try {
      while (this.#running && this.#due >= this.timeStep - EARLY) {
        this.#due -= this.timeStep;
        this.step();
      }
    } catch (error) {
      this.stop();
      throw error;
    }
    if (this.#running) this.#cancelFrame ??= nextFrame(this.#frame);
  };

  #has(entity: E): boolean {
    return entity.world === this;
  }

  /** Every entity that is in the world when its turn comes; those added meanwhile wait for the next time. */
  #forEachEntity(visit: (entity: E) => void): void {
    for (const entity of this.entities) if (this.#has(entity)) visit(entity);
  }

  #drawStructure(): void {
    if (!this.screen) return;
    const { ctx, scale } = this.screen;
    ctx.strokeStyle = STRUCTURE_COLOR;
    ctx.lineWidth = 1 / scale;
    this.#broadPhase.draw?.(ctx);
  }
}

function refuse(name: string, value: unknown, expected: string): never {
  throw new TypeError(`ro.World: ${name} is ${String(value)}, expected ${expected}`);
}

function expectEmpty(coltech: { entities: readonly unknown[] }): void {
  if (!Array.isArray(coltech?.entities)) refuse('coltech', coltech, 'a technique, such as those of ro.coltech');
  const { length } = coltech.entities;
  if (length > 0) throw new Error(`ro.World: the coltech has ${length} entities, expected one without any`);
}

function findCanvas(canvas: HTMLCanvasElement | string): HTMLCanvasElement {
  const element = typeof canvas === 'string' ? byId(canvas) : canvas;
  if (typeof (element as Partial<HTMLCanvasElement> | undefined)?.getContext !== 'function') {
    const what = typeof canvas === 'string' ? `the element with the id "${canvas}"` : String(canvas);
    throw new TypeError(`ro.World: ${what} is not a canvas; expected a <canvas>, the id of one, or null for no screen`);
  }
  return element as HTMLCanvasElement;
}

function byId(id: string): HTMLElement {
  if (typeof document === 'undefined') {
    throw new Error(`ro.World: there is no document to find the canvas "${id}" in; expected null for no screen`);
  }
  const element = document.getElementById(id);
  if (!element) throw new Error(`ro.World: no element has the id "${id}"; expected the id of a <canvas>`);
  return element;
}
