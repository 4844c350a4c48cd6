// box2d3-wasm: the whole of Box2D v3. Bodies are put in place, then a tiny time step updates its trees and contacts,
// and moves almost nothing. Its events tell which pairs begin and cease to touch.
import load from 'box2d3-wasm';
import { Contacts } from './kit/contacts.mjs';
import { resized } from './kit/resized.mjs';

export const dimensions = [2];

/** Seconds. A step of 0 does nothing. */
const instant = 1e-7;

const isStill = (frame, previous, k) =>
  frame[k] === previous[k] &&
  frame[k + 1] === previous[k + 1] &&
  frame[k + 2] === previous[k + 2] &&
  frame[k + 3] === previous[k + 3];

export async function create({ count, boxes, fixed = 0 }) {
  const b2 = await load();
  const worldDef = b2.b2DefaultWorldDef();
  worldDef.gravity.Set(0, 0);
  worldDef.enableSleep = false;
  worldDef.enableContinuous = false;
  const world = b2.b2CreateWorld(worldDef);
  const bodyDef = b2.b2DefaultBodyDef();
  bodyDef.fixedRotation = true;
  const shapeDef = b2.b2DefaultShapeDef();
  shapeDef.enableContactEvents = true;
  const upright = b2.b2MakeRot(0);
  const position = new b2.b2Vec2();
  const ids = new Map();
  const bodies = [];
  const shapes = [];
  const sizes = new Float32Array(2 * count);

  for (let id = 0, k = 0; id < count; id++, k += 4) {
    position.Set((boxes[k] + boxes[k + 2]) / 2, (boxes[k + 1] + boxes[k + 3]) / 2);
    bodyDef.position = position;
    bodyDef.type = id < fixed ? b2.b2BodyType.b2_staticBody : b2.b2BodyType.b2_dynamicBody;
    bodies.push(b2.b2CreateBody(world, bodyDef));
    sizes[2 * id] = boxes[k + 2] - boxes[k];
    sizes[2 * id + 1] = boxes[k + 3] - boxes[k + 1];
    const polygon = b2.b2MakeBox(sizes[2 * id] / 2, sizes[2 * id + 1] / 2);
    shapes.push(b2.b2CreatePolygonShape(bodies[id], shapeDef, polygon));
    polygon.delete();
    ids.set(shapes[id].index1, id);
  }

  const contacts = new Contacts();
  const take = (event, action) => {
    const { shapeIdA, shapeIdB } = event;
    contacts[action](ids.get(shapeIdA.index1), ids.get(shapeIdB.index1));
  };
  const previous = boxes.slice();
  return {
    update(frame) {
      for (let id = 0, k = 0; id < count; id++, k += 4) {
        if (isStill(frame, previous, k)) continue;
        const width = frame[k + 2] - frame[k];
        const height = frame[k + 3] - frame[k + 1];
        if (resized(sizes[2 * id], width, frame[k + 2]) || resized(sizes[2 * id + 1], height, frame[k + 3])) {
          sizes[2 * id] = width;
          sizes[2 * id + 1] = height;
          const polygon = b2.b2MakeBox(width / 2, height / 2);
          b2.b2Shape_SetPolygon(shapes[id], polygon);
          polygon.delete();
        }
        position.Set(frame[k] + width / 2, frame[k + 1] + height / 2);
        b2.b2Body_SetTransform(bodies[id], position, upright);
      }
      previous.set(frame);
      b2.b2World_Step(world, instant, 1);
      const events = b2.b2World_GetContactEvents(world);
      for (let k = 0; k < events.endCount; k++) take(events.GetEndEvent(k), 'end');
      for (let k = 0; k < events.beginCount; k++) take(events.GetBeginEvent(k), 'begin');
      return contacts.find(frame, 2);
    },
    pairs: () => contacts.pairs(),
  };
}
