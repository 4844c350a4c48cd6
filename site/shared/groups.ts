// A colour for every box: boxes that touch, directly or through others, form a group and share its hue; the more
// partners a box has, the deeper its shade. Groups are found by union-find over the pairs, once per frame.

/** Slot 0 is a box that touches nothing; the slots after it run through the hues, each in all its shades. */
export const hues = 12;
export const shades = 4;

/** After these come the colours of the structure of a technique: a cell, of which only the outline is drawn, */
export const cellSlot = 1 + hues * shades;
/** cells that hold more and more boxes, */
export const heatSlot = cellSlot + 1;
export const heats = 4;
/** and a box that was chosen, and its partners. */
export const chosenSlot = heatSlot + heats;
export const partnerSlot = chosenSlot + 1;
export const slotCount = partnerSlot + 1;

/** The shade of a box by its number of partners: 1 or 2, 3 or 4, 5 to 8, more. */
const shadeOf = Uint8Array.of(0, 0, 0, 1, 1, 2, 2, 2, 2, 3);

export class Groups {
  /** The colour slot of every box. */
  slots = new Uint8Array();
  /** How many boxes touch another. */
  touching = 0;
  #parent = new Int32Array();
  #partners = new Uint8Array();

  update(pairs: Uint32Array, pairCount: number, boxCount: number): void {
    if (this.slots.length < boxCount) {
      this.slots = new Uint8Array(boxCount);
      this.#parent = new Int32Array(boxCount);
      this.#partners = new Uint8Array(boxCount);
    }
    const slots = this.slots;
    const parent = this.#parent;
    const partners = this.#partners;
    for (let id = 0; id < boxCount; id++) parent[id] = id;
    partners.fill(0, 0, boxCount);

    const most = shadeOf.length - 1;
    for (let k = 0; k < 2 * pairCount; k += 2) {
      let a = pairs[k];
      let b = pairs[k + 1];
      if (partners[a] < most) partners[a]++;
      if (partners[b] < most) partners[b]++;
      while (parent[a] !== a) a = parent[a] = parent[parent[a]];
      while (parent[b] !== b) b = parent[b] = parent[parent[b]];
      // The smallest id leads its group, so a group keeps its hue while that box stays in it.
      if (a < b) parent[b] = a;
      else parent[a] = b;
    }

    let touching = 0;
    for (let id = 0; id < boxCount; id++) {
      const count = partners[id];
      if (count === 0) {
        slots[id] = 0;
        continue;
      }
      touching++;
      // Parents have smaller ids, so by now they point at their leader.
      const leader = parent[parent[id]];
      parent[id] = leader;
      slots[id] = 1 + ((Math.imul(leader, 0x9e3779b1) >>> 8) % hues) * shades + shadeOf[count];
    }
    this.touching = touching;
  }
}
