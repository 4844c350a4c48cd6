// A belt of stones around a planet: their matrices and their motion.
import { Euler, Matrix4, Quaternion, Vector3 } from 'three';

/** Pseudorandom numbers from 0 to 1, the same each time. */
export function seeded(seed) {
  let state = seed >>> 0 || 1;
  return () => {
    state = (Math.imul(state ^ (state >>> 15), 0x2c1b3c6d) + 0x9e3779b9) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 13), 0x297a2d39);
    mixed ^= mixed >>> 16;
    return (mixed >>> 0) / 2 ** 32;
  };
}

/** How far a stone moves per frame, in units. */
const speed = 0.25;

export class Belt {
  constructor(count) {
    this.count = count;
    /** As in an InstancedMesh: 16 numbers per stone. */
    this.matrices = new Float32Array(16 * count);
    /** The radius of the belt's middle. It is a quarter as wide, and a twentieth as high. */
    this.radius = 3 * Math.sqrt(count);
    /** The next stone to move. */
    this.turn = 0;
    const random = seeded(7);
    const matrix = new Matrix4();
    const [place, size, turned] = [new Vector3(), new Vector3(), new Quaternion()];
    for (let id = 0; id < count; id++) {
      const angle = 2 * Math.PI * random();
      const radius = this.radius * (1 + 0.125 * (random() + random() - 1) * 2);
      place.set(radius * Math.cos(angle), this.radius * 0.05 * (random() - 0.5), radius * Math.sin(angle));
      turned.setFromEuler(new Euler(6 * random(), 6 * random(), 6 * random()));
      size.setScalar(0.6 + 2.4 * random() ** 4);
      matrix.compose(place, turned, size).toArray(this.matrices, 16 * id);
    }
  }

  /** Moves a share of the stones by one frame, different ones each time. Returns the first and the number of them. */
  move(share) {
    const many = Math.round(share * this.count);
    const first = this.turn;
    for (let k = 0; k < many; k++) {
      const id = 16 * ((first + k) % this.count);
      const [x, z] = [this.matrices[id + 12], this.matrices[id + 14]];
      const angle = speed / Math.hypot(x, z);
      this.matrices[id + 12] = x * Math.cos(angle) - z * Math.sin(angle);
      this.matrices[id + 14] = x * Math.sin(angle) + z * Math.cos(angle);
    }
    this.turn = (first + many) % this.count;
    return { first, many };
  }
}
