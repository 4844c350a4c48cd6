// Draws the contents of a space as lines in a three.js scene. Add it to the scene, and call its update() after the
// space's. It is for debugging: it reads every box each time.
import { Lines } from 'broadphase/draw';
import { BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments } from 'three';

/** What can be shown: the method of Lines that adds it, and its colour. */
const kinds = {
  boxes: ['addBoxes', 0x8893a5],
  touching: ['addTouching', 0xe0457b],
  pairs: ['addPairs', 0xe0457b],
  cells: ['addCells', 0x3f8fdc],
  hot: ['addHotCells', 0xf08c1a],
};

/** The lines of one kind. In a 2D space, z is 0. */
class KindOfLines extends LineSegments {
  constructor(space, method, color) {
    super(new BufferGeometry(), new LineBasicMaterial({ color }));
    this.space = space;
    this.method = method;
    this.lines = new Lines(space.dimensions);
    this.frustumCulled = false; // they change each frame
  }

  update() {
    const { lines, geometry } = this;
    lines.clear()[this.method](this.space);
    if (geometry.attributes.position?.array !== lines.data) {
      geometry.dispose(); // its array has become too short
      geometry.setAttribute('position', new BufferAttribute(lines.data, lines.dimensions));
    }
    geometry.attributes.position.needsUpdate = true;
    geometry.setDrawRange(0, lines.length / lines.dimensions);
  }
}

export class SpaceHelper extends Group {
  /** `shown`: some of boxes, touching, pairs, cells, hot. Each is a child of that name, whose `visible` can be set. */
  constructor(space, shown = ['boxes', 'touching', 'pairs']) {
    super();
    for (const name of shown) {
      if (!(name in kinds)) {
        throw new TypeError(`SpaceHelper: got '${name}', expected one of ${Object.keys(kinds).join(', ')}`);
      }
      const lines = new KindOfLines(space, ...kinds[name]);
      lines.name = name;
      this.add(lines);
    }
  }

  update() {
    for (const lines of this.children) if (lines.visible) lines.update();
  }

  dispose() {
    for (const { geometry, material } of this.children) {
      geometry.dispose();
      material.dispose();
    }
  }
}
