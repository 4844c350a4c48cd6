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
  SRGBColorSpace,
  Vector2,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { slotCount } from '../../shared/groups.ts';
import { makePalette } from '../../shared/palette.ts';
import { scrollsPage } from '../../shared/pan-zoom.ts';
import { type LabView, onSize } from './view.ts';

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

/** The element holds one canvas. */
export function createSolidView(element: HTMLElement, moved: () => void): LabView {
  const canvas = element.querySelector('canvas')!;
  const renderer = new WebGLRenderer({ canvas, antialias: true });
  const scene = new Scene();
  const camera = new PerspectiveCamera(fieldOfView);
  const controls = new OrbitControls(camera, element);
  // As in the plane: the page scrolls by a finger that moves up or down, and by a wheel over a view not clicked.
  element.style.touchAction = 'pan-y';
  const leaveToPage = (event: WheelEvent) => {
    if (scrollsPage(event, element)) event.stopImmediatePropagation();
  };
  element.addEventListener('wheel', leaveToPage, { capture: true, passive: true });
  const uniforms = {
    palette: { value: new Float32Array(4 * slotCount) },
    farLow: { value: new Vector3() },
    farHigh: { value: new Vector3() },
    diagonal: { value: 1 },
  };
  const boxes = new Instances(
    (geometry) => new Mesh(geometry, new ShaderMaterial({ vertexShader, fragmentShader: solidShader, uniforms })),
    new BoxGeometry(),
  );
  const cells = new Instances(
    (geometry) =>
      new LineSegments(
        geometry,
        new ShaderMaterial({
          vertexShader,
          fragmentShader: frameShader,
          uniforms,
          transparent: true,
          depthWrite: false,
        }),
      ),
    new EdgesGeometry(new BoxGeometry()),
  );
  const pairs = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ depthTest: false }));
  pairs.frustumCulled = false;
  scene.add(boxes.object, cells.object, pairs);
  const [middle, low, high] = [new Vector3(), new Vector3(), new Vector3()];
  let diagonal = 1;
  let fitted = true;
  let awaited = 0;

  const draw = () => renderer.render(scene, camera);
  const redraw = () => {
    cancelAnimationFrame(awaited);
    awaited = requestAnimationFrame(draw);
  };
  const start = () => {
    controls.target.copy(middle);
    camera.position
      .copy(firstDirection)
      .multiplyScalar(distanceToSee(low, high, camera.aspect))
      .add(middle);
    controls.update();
    fitted = true;
    redraw();
  };
  controls.enableDamping = false;
  controls.addEventListener('change', redraw);
  controls.addEventListener('start', () => {
    fitted = false;
  });
  controls.addEventListener('change', moved);

  const dark = matchMedia('(prefers-color-scheme: dark)');
  const dress = () => {
    const style = getComputedStyle(element);
    const palette = makePalette(dark.matches, style.getPropertyValue('--page').trim());
    uniforms.palette.value.set(palette.slots);
    renderer.setClearColor(new Color().setRGB(...palette.background, SRGBColorSpace));
    pairs.material.color.set(style.color);
    redraw();
  };
  dark.addEventListener('change', dress);
  dress();
  onSize(element, (width, height) => {
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    if (fitted) start();
    draw();
  });

  const zoom = (factor: number) => {
    camera.position.sub(controls.target).divideScalar(factor).add(controls.target);
    fitted = false;
    controls.update();
  };
  /** Turns around the centre, in radians. */
  const turn = (across: number, up: number) => {
    const offset = camera.position.clone().sub(controls.target);
    const length = offset.length();
    const polar = Math.min(Math.PI - 0.05, Math.max(0.05, Math.acos(offset.y / length) - up));
    const around = Math.atan2(offset.x, offset.z) - across;
    offset.setFromSphericalCoords(length, polar, around);
    camera.position.copy(controls.target).add(offset);
    fitted = false;
    controls.update();
  };
  const step = Math.PI / 24;
  const keys: Record<string, () => void> = {
    ArrowLeft: () => turn(step, 0),
    ArrowRight: () => turn(-step, 0),
    ArrowUp: () => turn(0, step),
    ArrowDown: () => turn(0, -step),
    '+': () => zoom(1.25),
    '=': () => zoom(1.25),
    '-': () => zoom(0.8),
    '0': start,
  };
  element.tabIndex = 0;
  element.addEventListener('keydown', (event) => {
    const act = event.ctrlKey || event.metaKey || event.altKey ? undefined : keys[event.key];
    if (!act) return;
    event.preventDefault();
    act();
    moved();
  });

  return {
    element,
    fit(world) {
      low.fromArray(world, 0);
      high.fromArray(world, 3);
      middle.copy(low).add(high).multiplyScalar(0.5);
      diagonal = low.distanceTo(high);
      uniforms.diagonal.value = diagonal;
      uniforms.farLow.value.copy(middle).subScalar(horizon * diagonal);
      uniforms.farHigh.value.copy(middle).addScalar(horizon * diagonal);
      camera.near = diagonal / 500;
      camera.far = diagonal * 2 * horizon;
      camera.updateProjectionMatrix();
      start();
    },
    show({ drawn, slots, cells: cellCount, boxes: boxCount, lines }) {
      cells.set(drawn, slots, 0, cellCount);
      boxes.set(drawn, slots, cellCount, boxCount);
      pairs.visible = lines !== undefined;
      if (lines) {
        pairs.geometry.dispose();
        pairs.geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(lines, 3));
      }
      cancelAnimationFrame(awaited);
      draw();
    },
    zoom(factor) {
      zoom(factor);
      moved();
    },
    get look() {
      if (fitted) return undefined;
      const shares = (place: Vector3) => place.clone().sub(middle).divideScalar(diagonal).toArray();
      return [...shares(camera.position), ...shares(controls.target)];
    },
    set look(given) {
      start();
      if (given?.length !== 6) return;
      const place = (at: number) => new Vector3().fromArray(given, at).multiplyScalar(diagonal).add(middle);
      if (place(0).distanceTo(place(3)) < camera.near) return;
      camera.position.copy(place(0));
      controls.target.copy(place(3));
      fitted = false;
      controls.update();
    },
    cellsTooSmall: false, // the nearest are large enough
    place(clientX, clientY) {
      const frame = canvas.getBoundingClientRect();
      const x = (2 * (clientX - frame.left)) / frame.width - 1;
      const y = 1 - (2 * (clientY - frame.top)) / frame.height;
      const caster = new Raycaster();
      caster.setFromCamera(new Vector2(x, y), camera);
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
