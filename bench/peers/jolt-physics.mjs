// jolt-physics: its broad phase, a tree with four boxes per node, which is optimized each frame. Then comes one search
// for each box that moved, whose answers go to a collector written in JavaScript.
import load from 'jolt-physics';
import { movingPairs } from './kit/moving-pairs.mjs';
import { resized } from './kit/resized.mjs';

export const dimensions = [3];

const layer = 0;
/** The bits of a body's id that are its index. */
const indexBits = 0x7fffff;

/** A physics system in which everything is in one layer. */
function createSystem(Jolt, count) {
  const settings = new Jolt.JoltSettings();
  settings.mMaxBodies = count;
  settings.mObjectLayerPairFilter = new Jolt.ObjectLayerPairFilterTable(1);
  const layers = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
  layers.MapObjectToBroadPhaseLayer(layer, new Jolt.BroadPhaseLayer(0));
  settings.mBroadPhaseLayerInterface = layers;
  settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(
    layers,
    1,
    settings.mObjectLayerPairFilter,
    1,
  );
  return new Jolt.JoltInterface(settings).GetPhysicsSystem();
}

/** Calls `hit` with the index of each body that a search finds. */
function createCollector(Jolt, hit) {
  const collector = new Jolt.CollideShapeBodyCollectorJS();
  collector.Reset = () => {};
  collector.SetContext = () => {};
  collector.AddHit = (body) => hit(Jolt.HEAPU32[body >> 2] & indexBits);
  return collector;
}

/** Whether the box at `at` is not as large as it was. */
function grown(halves, id, boxes, at) {
  for (let axis = 0; axis < 3; axis++) {
    const size = (boxes[at + axis + 3] - boxes[at + axis]) / 2;
    if (resized(halves[3 * id + axis], size, boxes[at + axis + 3])) return true;
  }
  return false;
}

export async function create({ count, boxes }) {
  const Jolt = await load();
  const system = createSystem(Jolt, count);
  const bodies = system.GetBodyInterface();
  const query = system.GetBroadPhaseQuery();
  const anyLayer = new Jolt.BroadPhaseLayerFilter();
  const anyObject = new Jolt.ObjectLayerFilter();

  const place = new Jolt.RVec3();
  const half = new Jolt.Vec3();
  const upright = new Jolt.Quat(0, 0, 0, 1);
  const halves = new Float32Array(3 * count);

  function shapeOf(id, at) {
    for (let axis = 0; axis < 3; axis++) halves[3 * id + axis] = (boxes[at + axis + 3] - boxes[at + axis]) / 2;
    half.Set(halves[3 * id], halves[3 * id + 1], halves[3 * id + 2]);
    return new Jolt.BoxShape(half, 0);
  }

  function placeAt(at) {
    place.Set(
      (boxes[at] + boxes[at + 3]) / 2,
      (boxes[at + 1] + boxes[at + 4]) / 2,
      (boxes[at + 2] + boxes[at + 5]) / 2,
    );
    return place;
  }

  const ids = new Uint32Array(count);
  const handles = Array.from({ length: count }, (_, id) => {
    const at = 6 * id;
    const creation = new Jolt.BodyCreationSettings(
      shapeOf(id, at),
      placeAt(at),
      upright,
      Jolt.EMotionType_Kinematic,
      layer,
    );
    const body = bodies.CreateBody(creation);
    Jolt.destroy(creation);
    const handle = body.GetID();
    ids[handle.GetIndex()] = id;
    bodies.AddBody(handle, Jolt.EActivation_DontActivate);
    return handle;
  });
  system.OptimizeBroadPhase();

  let tell;
  const collector = createCollector(Jolt, (index) => tell(ids[index]));
  const box = new Jolt.AABox();
  return movingPairs({
    dimensions: 3,
    count,
    boxes,
    move(id, at) {
      if (grown(halves, id, boxes, at))
        bodies.SetShape(handles[id], shapeOf(id, at), false, Jolt.EActivation_DontActivate);
      bodies.SetPosition(handles[id], placeAt(at), Jolt.EActivation_DontActivate);
    },
    ready: () => system.OptimizeBroadPhase(),
    search(_, at, found) {
      tell = found;
      box.mMin.Set(boxes[at], boxes[at + 1], boxes[at + 2]);
      box.mMax.Set(boxes[at + 3], boxes[at + 4], boxes[at + 5]);
      query.CollideAABox(box, collector, anyLayer, anyObject);
    },
  });
}
