// A showcase: half a million stones orbit in a belt, a camera flies among them, and only those in view are drawn. The
// same boxes serve to pick the one under the pointer, and to show those nearby on a map.
import {
  Box3,
  Color,
  DirectionalLight,
  Fog,
  HemisphereLight,
  IcosahedronGeometry,
  InstancedMesh,
  Mesh,
  MeshLambertMaterial,
  PerspectiveCamera,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
} from 'three';
import { Belt } from './belt.mjs';
import { Culler } from './culler.mjs';
import { inNextFrame, time } from './page/showcase.mjs';
import { moveView } from './page/view.mjs';
import { EachByThree, FlatSpheres, InstancedMeshTree, tell } from './rivals.mjs';

/** With more stones, the tree of instanced-mesh takes seconds to build and to move. */
const mostInTree = 20_000;
/** How far the camera sees. */
const sight = 320;
/** At most this many are drawn. */
const mostDrawn = 40_000;
/** How fast the camera flies along the belt, in radians per frame. */
const flight = 0.0004;
const [closest, widest] = [15, 75];
const mapSize = 148;

const whole = new Intl.NumberFormat('en');
const rivals = { each: EachByThree, flat: FlatSpheres, tree: InstancedMeshTree };

/** The scene without the stones. */
function makeScene() {
  const scene = new Scene();
  const sun = new DirectionalLight(0xfff0dd, 2.6);
  sun.position.set(1, 0.8, 0.3);
  scene.fog = new Fog(0, sight / 3, sight);
  scene.add(new HemisphereLight(0xdde6ff, 0x554433, 1.3), sun);
  return scene;
}

/** What a camera sees that flies in the middle of the belt. The pointer turns it, and picks a stone. */
class View {
  camera = new PerspectiveCamera(50, 1, 0.5, sight);
  angle = 0;
  /** The stone under the pointer, or -1. */
  picked = -1;
  #yaw = 0;
  #pitch = -0.08;
  #scene = makeScene();
  #renderer = new WebGLRenderer({ antialias: true });
  #ray = new Raycaster();
  #mesh;
  #marked;

  constructor(stage, stone, belt, culler, changed) {
    Object.assign(this, { stage, belt, culler, changed });
    this.#renderer.domElement.setAttribute('aria-hidden', 'true');
    stage.append(this.#renderer.domElement);
    this.#mesh = new InstancedMesh(stone, new MeshLambertMaterial({ flatShading: true }), mostDrawn);
    this.#mesh.frustumCulled = false; // it has only stones in view
    this.#marked = new Mesh(stone, new MeshLambertMaterial({ color: 0xff7a1a, flatShading: true }));
    this.#marked.matrixAutoUpdate = this.#marked.frustumCulled = false;
    this.#scene.add(this.#mesh, this.#marked);
    new ResizeObserver(() => this.#resize()).observe(stage);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', changed);
    moveView(stage, this);
  }

  #resize() {
    const { clientWidth, clientHeight } = this.stage;
    if (clientWidth * clientHeight === 0) return; // hidden: it has no aspect
    this.#renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.#renderer.setSize(clientWidth, clientHeight);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.changed();
  }

  pan(dx, dy) {
    this.#yaw -= 0.004 * dx;
    this.#pitch = Math.max(-1.2, Math.min(1.2, this.#pitch + 0.004 * dy));
    this.changed();
  }

  zoom(factor) {
    this.camera.fov = Math.max(closest, Math.min(widest, this.camera.fov / factor));
    this.camera.updateProjectionMatrix();
    this.changed();
  }

  point(x, y) {
    const { clientWidth, clientHeight } = this.stage;
    this.#ray.setFromCamera(new Vector2((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight), this.camera);
    const hit = this.culler.pick(this.#ray.ray);
    this.picked = hit && hit.distance < sight ? hit.id : -1;
    this.changed();
  }

  /** Puts the camera where it has flown to, and turns it. */
  aim() {
    this.camera.position.set(this.belt.radius * Math.cos(this.angle), 0, this.belt.radius * Math.sin(this.angle));
    this.camera.rotation.set(this.#pitch, -this.angle - this.#yaw, 0, 'YXZ');
    this.camera.updateMatrixWorld();
  }

  /** Draws the stones with these ids. */
  draw(seen) {
    const [from, to] = [this.belt.matrices, this.#mesh.instanceMatrix.array];
    this.#mesh.count = Math.min(seen.length, mostDrawn);
    for (let k = 0; k < this.#mesh.count; k++) {
      for (let n = 0; n < 16; n++) to[16 * k + n] = from[16 * seen[k] + n];
    }
    this.#mesh.instanceMatrix.needsUpdate = true;
    this.#marked.visible = this.picked >= 0;
    if (this.picked >= 0) this.#marked.matrix.fromArray(from, 16 * this.picked).scale(new Vector3(1.05, 1.05, 1.05));
    const page = new Color(getComputedStyle(document.body).backgroundColor);
    this.#scene.fog.color = this.#scene.background = page;
    this.#mesh.material.color.set(page.getHSL({}).l < 0.5 ? 0x8f9bd8 : 0x7f88b4);
    this.#renderer.render(this.#scene, this.camera);
  }
}

/** The canvas of the map, in a corner of the stage. */
function makeMap(stage) {
  const map = Object.assign(document.createElement('canvas'), { width: 2 * mapSize, height: 2 * mapSize });
  map.setAttribute('aria-hidden', 'true');
  const look = { position: 'absolute', left: '12px', bottom: '12px', width: `${mapSize}px`, height: `${mapSize}px` };
  Object.assign(map.style, look, { borderRadius: '50%', pointerEvents: 'none' });
  stage.append(map);
  return map.getContext('2d');
}

/** Draws the stones around the camera as dots, those that it sees in another colour. */
function drawMap(map, { matrices }, culler, { position }, seen) {
  const dot = (id) => {
    const at = (axis) => mapSize * (1 + (matrices[16 * id + 12 + axis] - position.getComponent(axis)) / sight);
    map.fillRect(at(0) - 1, at(2) - 1, 2, 2);
  };
  const { color } = getComputedStyle(map.canvas);
  map.clearRect(0, 0, 2 * mapSize, 2 * mapSize);
  map.fillStyle = `color-mix(in srgb, ${color} 12%, transparent)`;
  map.fillRect(0, 0, 2 * mapSize, 2 * mapSize);
  map.fillStyle = `color-mix(in srgb, ${color} 35%, transparent)`;
  const around = new Box3().setFromCenterAndSize(position, new Vector3(1, 1, 1).multiplyScalar(2 * sight));
  for (const id of culler.within(around)) dot(id);
  map.fillStyle = '#ff7a1a';
  for (const id of seen) dot(id);
}

/** A showcase: see examples/page/showcase.mjs. */
class BeltDemo {
  legend = 'A frame’s culling, without the drawing, by';
  stone = new IcosahedronGeometry(1, 0);
  share = 0.01;
  flying = false;

  constructor(count, stage, { wake, say }) {
    this.say = say;
    this.belt = new Belt(count);
    this.culler = new Culler(this.stone, this.belt.matrices);
    /** Who finds what is drawn. */
    this.user = this.culler;
    this.drawSoon = inNextFrame(() => this.#draw());
    stage.tabIndex = 0;
    this.view = new View(stage, this.stone, this.belt, this.culler, this.drawSoon);
    this.map = makeMap(stage);
    this.contenders = {
      broadphase: 'broadphase',
      each: 'each, as BatchedMesh does',
      flat: 'a loop over spheres',
      ...(count <= mostInTree && { tree: 'the tree of instanced-mesh' }),
    };
    const setShare = (share) => () => {
      this.share = share;
      wake();
    };
    this.actions = {
      Fly: () => {
        this.flying = true;
        wake();
      },
      'None move': setShare(0),
      '1 % move': setShare(0.01),
      '10 % move': setShare(0.1),
      'All move': setShare(1),
    };
  }

  #contender(key) {
    return key === 'broadphase' ? this.culler : new rivals[key](this.stone, this.belt.matrices);
  }

  use(key) {
    this.user = this.#contender(key);
    this.drawSoon();
  }

  race(key) {
    const contender = this.#contender(key);
    let moved;
    const prepare = () => {
      moved = this.belt.move(this.share);
      if (contender !== this.culler) tell(this.culler, moved.first, moved.many);
    };
    return time(() => {
      tell(contender, moved.first, moved.many);
      contender.visible(this.view.camera);
    }, prepare);
  }

  /** Moves the stones by one frame, and the camera by some if it flies. */
  #move(frames) {
    const { first, many } = this.belt.move(this.share);
    tell(this.culler, first, many);
    if (this.user !== this.culler) tell(this.user, first, many);
    if (this.flying) this.view.angle += frames * flight;
  }

  #draw() {
    const { belt, culler, user, view } = this;
    view.aim();
    const ours = culler.visible(view.camera); // also for the map and the pointer
    const seen = user === culler ? ours : user.visible(view.camera);
    view.draw(seen);
    drawMap(this.map, belt, culler, view.camera, seen);
    const [all, moving] = [whole.format(belt.count), whole.format(Math.round(this.share * belt.count))];
    const pick = view.picked < 0 ? '' : `; stone ${whole.format(view.picked)} is under the pointer`;
    this.say(`${whole.format(seen.length)} of ${all} stones in view, ${moving} move in each frame${pick}`);
  }

  step() {
    this.#move(1);
    this.#draw();
    return this.flying;
  }

  settle() {
    this.#move(20);
    this.flying = false;
    this.#draw();
  }

  stop() {
    this.flying = false;
  }
}

/** The showcase, with this many stones. */
export const beltDemo = (count) => (stage, tools) => new BeltDemo(count, stage, tools);
