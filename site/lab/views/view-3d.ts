// Solid scenes, by three.js. Boxes are one instanced cube whose corners the vertex shader puts between the minima and
// maxima of each, straight from the array they come in; cells are one instanced frame of twelve edges.
import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  Color,
  EdgesGeometry,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  InstancedInterleavedBuffer,
  InterleavedBufferAttribute,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  PerspectiveCamera,
  type Ray,
  Raycaster,
  Scene,
  ShaderMaterial,
  type ShaderMaterialParameters,
  SRGBColorSpace,
  Vector2,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { slotCount } from '../../shared/groups.ts';
import { scrollsPage } from '../../shared/pan-zoom.ts';
import type { Picture } from '../worker/messages.ts';
import { type LabView, onPalette, onSize } from './view.ts';

const vertexShader = `
attribute vec3 low, high;
attribute float slot;
uniform vec4 palette[${slotCount}];
uniform vec3 farLow, farHigh;
uniform float diagonal;
varying vec4 colour;
varying vec3 facing;
varying float veil;
void main() {
  colour = palette[int(slot + 0.5)];
  facing = normal;
  veil = 0.85 * smoothstep(0.1, 0.4, distance(low, high) / diagonal);
  vec3 place = mix(clamp(low, farLow, farHigh), clamp(high, farLow, farHigh), position + 0.5);
  gl_Position = projectionMatrix * modelViewMatrix * vec4(place, 1.0);
}`;

/**
 * Light from above: each side has its own shade, which is all that boxes need. Boxes so large that they would hide all
 * others are drawn with only some of their pixels, in a pattern of four by four.
 */
const solidShader = `
varying vec4 colour;
varying vec3 facing;
varying float veil;
void main() {
  vec2 at = floor(mod(gl_FragCoord.xy, 4.0));
  vec2 fine = mod(at, 2.0), coarse = floor(at / 2.0);
  float order = 4.0 * mod(2.0 * fine.x + 3.0 * fine.y, 4.0) + mod(2.0 * coarse.x + 3.0 * coarse.y, 4.0);
  if ((order + 0.5) / 16.0 < veil) discard;
  float light = 0.72 + 0.28 * facing.y + 0.12 * facing.x - 0.08 * abs(facing.z);
  gl_FragColor = vec4(colour.rgb * min(light, 1.0), 1.0);
}`;

const frameShader = `
varying vec4 colour;
void main() {
  gl_FragColor = colour;
}`;

const fieldOfView = 45;
/** The share of the view that is left free around the whole world. */
const fitMargin = 0.04;
/** Coordinates are clamped to this many diagonals of the world from its middle. */
const horizon = 20;

const firstDirection = new Vector3(0.55, 0.5, 0.67).normalize();

/** How far from the middle of a box the eye has to be, in its first direction, to see all eight corners. */
function distanceToSee(low: Vector3, high: Vector3, aspect: number): number {
  const right = new Vector3(0, 1, 0).cross(firstDirection).normalize();
  const up = firstDirection.clone().cross(right);
  const tangent = Math.tan((fieldOfView * Math.PI) / 360) * (1 - fitMargin);
  const half = high.clone().sub(low).multiplyScalar(0.5);
  let distance = 0;
  for (let k = 0; k < 8; k++) {
    const corner = new Vector3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1).multiply(half);
    const wide = Math.max(Math.abs(corner.dot(right)) / aspect, Math.abs(corner.dot(up)));
    distance = Math.max(distance, corner.dot(firstDirection) + wide / tangent);
  }
  return distance;
}

/** The camera, which turns around a point by mouse, fingers and keys. */
class Orbit {
  readonly camera = new PerspectiveCamera(fieldOfView);
  readonly middle = new Vector3();
  /** The length of the world from corner to corner. */
  diagonal = 1;
  readonly #controls: OrbitControls;
  readonly #low = new Vector3();
  readonly #high = new Vector3();
  #fitted = true;

  constructor(element: HTMLElement, changed: () => void) {
    this.#controls = new OrbitControls(this.camera, element);
    this.#controls.enableDamping = false;
    this.#controls.addEventListener('change', changed);
    this.#controls.addEventListener('start', () => {
      this.#fitted = false;
    });
    // As in the plane: the page scrolls by a finger that moves up or down, and by a wheel over a view not clicked.
    element.style.touchAction = 'pan-y';
    const leaveToPage = (event: WheelEvent) => {
      if (scrollsPage(event, element)) event.stopImmediatePropagation();
    };
    element.addEventListener('wheel', leaveToPage, { capture: true, passive: true });
  }

  fit(world: readonly number[]): void {
    this.#low.fromArray(world, 0);
    this.#high.fromArray(world, 3);
    this.middle.copy(this.#low).add(this.#high).multiplyScalar(0.5);
    this.diagonal = this.#low.distanceTo(this.#high);
    this.camera.near = this.diagonal / 500;
    this.camera.far = this.diagonal * 2 * horizon;
    this.camera.updateProjectionMatrix();
    this.start();
  }

  /** Shows the whole world, from the first direction. */
  start(): void {
    const { camera } = this;
    camera.position
      .copy(firstDirection)
      .multiplyScalar(distanceToSee(this.#low, this.#high, camera.aspect))
      .add(this.middle);
    this.#controls.target.copy(this.middle);
    this.#controls.update();
    this.#fitted = true;
  }

  resize(aspect: number): void {
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
    if (this.#fitted) this.start();
  }

  zoom(factor: number): void {
    const { target } = this.#controls;
    this.camera.position.sub(target).divideScalar(factor).add(target);
    this.#leave();
  }

  /** Turns around the point, in radians. */
  turn(across: number, up: number): void {
    const { target } = this.#controls;
    const offset = this.camera.position.clone().sub(target);
    const length = offset.length();
    const polar = Math.min(Math.PI - 0.05, Math.max(0.05, Math.acos(offset.y / length) - up));
    const around = Math.atan2(offset.x, offset.z) - across;
    offset.setFromSphericalCoords(length, polar, around);
    this.camera.position.copy(target).add(offset);
    this.#leave();
  }

  /** After the camera was moved. */
  #leave(): void {
    this.#fitted = false;
    this.#controls.update();
  }

  get look(): readonly number[] | undefined {
    if (this.#fitted) return undefined;
    const shares = (place: Vector3) => place.clone().sub(this.middle).divideScalar(this.diagonal).toArray();
    return [...shares(this.camera.position), ...shares(this.#controls.target)];
  }

  set look(given: readonly number[] | undefined) {
    this.start();
    if (given?.length !== 6) return;
    const place = (at: number) => new Vector3().fromArray(given, at).multiplyScalar(this.diagonal).add(this.middle);
    if (place(0).distanceTo(place(3)) < this.camera.near) return;
    this.camera.position.copy(place(0));
    this.#controls.target.copy(place(3));
    this.#leave();
  }
}

const step = Math.PI / 24;
const keys: Record<string, (orbit: Orbit) => void> = {
  ArrowLeft: (orbit) => orbit.turn(step, 0),
  ArrowRight: (orbit) => orbit.turn(-step, 0),
  ArrowUp: (orbit) => orbit.turn(0, step),
  ArrowDown: (orbit) => orbit.turn(0, -step),
  '+': (orbit) => orbit.zoom(1.25),
  '=': (orbit) => orbit.zoom(1.25),
  '-': (orbit) => orbit.zoom(0.8),
  '0': (orbit) => orbit.start(),
};

/** The boxes, cells and pairs of a picture, in a scene. */
class Solids {
  readonly scene = new Scene();
  readonly #uniforms = {
    palette: { value: new Float32Array(4 * slotCount) },
    farLow: { value: new Vector3() },
    farHigh: { value: new Vector3() },
    diagonal: { value: 1 },
  };
  readonly #boxes = new Instances(
    (geometry) => new Mesh(geometry, this.#material({ fragmentShader: solidShader })),
    new BoxGeometry(),
  );
  readonly #cells = new Instances(
    (geometry) =>
      new LineSegments(geometry, this.#material({ fragmentShader: frameShader, transparent: true, depthWrite: false })),
    new EdgesGeometry(new BoxGeometry()),
  );
  readonly #pairs = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ depthTest: false }));

  constructor() {
    this.#pairs.frustumCulled = false;
    this.scene.add(this.#boxes.object, this.#cells.object, this.#pairs);
  }

  #material(parameters: ShaderMaterialParameters): ShaderMaterial {
    return new ShaderMaterial({ vertexShader, uniforms: this.#uniforms, ...parameters });
  }

  fit({ middle, diagonal }: Orbit): void {
    this.#uniforms.diagonal.value = diagonal;
    this.#uniforms.farLow.value.copy(middle).subScalar(horizon * diagonal);
    this.#uniforms.farHigh.value.copy(middle).addScalar(horizon * diagonal);
  }

  dress(slots: Float32Array, lineColour: string): void {
    this.#uniforms.palette.value.set(slots);
    this.#pairs.material.color.set(lineColour);
  }

  show({ drawn, slots, cells, boxes, lines }: Picture): void {
    this.#cells.set(drawn, slots, 0, cells);
    this.#boxes.set(drawn, slots, cells, boxes);
    this.#pairs.visible = lines !== undefined;
    if (!lines) return;
    this.#pairs.geometry.dispose();
    this.#pairs.geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(lines, 3));
  }
}

function rendererFor(canvas: HTMLCanvasElement): WebGLRenderer {
  try {
    return new WebGLRenderer({ canvas, antialias: true });
  } catch (cause) {
    throw new Error('solid scenes need WebGL, which is switched off or missing here', { cause });
  }
}

/** The element holds one canvas. */
export function createSolidView(element: HTMLElement, moved: () => void): LabView {
  const canvas = element.querySelector('canvas')!;
  const renderer = rendererFor(canvas);
  const solids = new Solids();
  let awaited = 0;

  const draw = () => renderer.render(solids.scene, orbit.camera);
  const redraw = () => {
    cancelAnimationFrame(awaited);
    awaited = requestAnimationFrame(draw);
  };
  const changed = () => {
    redraw();
    moved();
  };
  const orbit = new Orbit(element, changed);
  onPalette(element, ({ slots, background }, { color }) => {
    solids.dress(slots, color);
    renderer.setClearColor(new Color().setRGB(...background, SRGBColorSpace));
    redraw();
  });
  onSize(element, (width, height) => {
    renderer.setSize(width, height, false);
    orbit.resize(width / height);
    draw();
  });
  element.tabIndex = 0;
  element.addEventListener('keydown', (event) => {
    const act = event.ctrlKey || event.metaKey || event.altKey ? undefined : keys[event.key];
    if (!act) return;
    event.preventDefault();
    act(orbit);
    changed();
  });

  return {
    element,
    fit(world) {
      orbit.fit(world);
      solids.fit(orbit);
      redraw();
    },
    show(picture) {
      solids.show(picture);
      cancelAnimationFrame(awaited);
      draw();
    },
    zoom(factor) {
      orbit.zoom(factor);
      changed();
    },
    get look() {
      return orbit.look;
    },
    set look(given) {
      orbit.look = given;
      redraw();
    },
    cellsTooSmall: false, // the nearest are large enough
    place(clientX, clientY) {
      const frame = canvas.getBoundingClientRect();
      const x = (2 * (clientX - frame.left)) / frame.width - 1;
      const y = 1 - (2 * (clientY - frame.top)) / frame.height;
      const caster = new Raycaster();
      caster.setFromCamera(new Vector2(x, y), orbit.camera);
      const { origin, direction }: Ray = caster.ray;
      return { place: [...origin.toArray(), ...direction.toArray()], reach: Infinity };
    },
  };
}

/** Many copies of one shape, each between its own corners and in its own colour. */
class Instances<Shape extends Mesh | LineSegments> {
  readonly object: Shape;
  readonly #shape: BufferGeometry;
  #room = 0;

  constructor(make: (geometry: BufferGeometry) => Shape, shape: BufferGeometry) {
    this.#shape = shape;
    this.object = make(new InstancedBufferGeometry());
    this.object.frustumCulled = false;
  }

  /** Shows `count` of the boxes of an array, from `first` on. */
  set(drawn: Float32Array, slots: Uint8Array, first: number, count: number): void {
    if (count > this.#room) this.#grow(Math.ceil(1.25 * count));
    const geometry = this.object.geometry as InstancedBufferGeometry;
    geometry.instanceCount = count;
    this.object.visible = count > 0;
    if (count === 0) return;
    const { data } = geometry.getAttribute('low') as InterleavedBufferAttribute;
    data.array.set(drawn.subarray(6 * first, 6 * (first + count)));
    data.clearUpdateRanges();
    data.addUpdateRange(0, 6 * count);
    data.needsUpdate = true;
    const colours = geometry.getAttribute('slot') as InstancedBufferAttribute;
    colours.array.set(slots.subarray(first, first + count));
    colours.needsUpdate = true;
  }

  #grow(room: number): void {
    this.#room = room;
    this.object.geometry.dispose();
    const geometry = new InstancedBufferGeometry();
    geometry.index = this.#shape.index;
    for (const name of ['position', 'normal']) {
      if (this.#shape.hasAttribute(name)) geometry.setAttribute(name, this.#shape.getAttribute(name));
    }
    const corners = new InstancedInterleavedBuffer(new Float32Array(6 * room), 6);
    geometry.setAttribute('low', new InterleavedBufferAttribute(corners, 3, 0));
    geometry.setAttribute('high', new InterleavedBufferAttribute(corners, 3, 3));
    geometry.setAttribute('slot', new InstancedBufferAttribute(new Uint8Array(room), 1));
    this.object.geometry = geometry;
  }
}
