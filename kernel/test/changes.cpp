// Which boxes are recorded as changed.
#include "boxes/changes.hpp"

#include "check.hpp"
#include "model.hpp"

TEST("changes have the room they report, and list each slot once") {
  Changes changes;
  changes.make_room(33);
  changes.clear(33);
  changes.make_room(60);
  for (u32 round = 0; round < 2; round++) {
    for (u32 slot = 0; slot < 60; slot++) changes.note(slot);
  }
  CHECK(changes.count() == 60);
  for (u32 k = 0; k < 60; k++) CHECK(changes.list()[k] == k);
}

/// Boxes that come through the ring, some of which differ from the previous ones: the last entry of a box counts.
template <int D> void check_ring() {
  constexpr u32 width = 2 * D, slots = 40, rounds = 600;
  auto instance = open<D>(Technique::strip_sweep);
  Space<D>& space = instance->space;
  auto ring = std::make_unique<Ring<D>>();
  std::vector<Box<D>> expected;
  for (u32 round = 1; round < rounds; round++) {
    u32 count = smaller(round, Ring<D>::most_entries);
    for (u32 k = 0; k < count; k++) {
      f64* entry = ring->entries + k * Ring<D>::step;
      u32 id = k * 7 % slots;
      Box<D> box;
      for (u32 a = 0; a < width; a++) box[a] = k % 3 == 0 ? 0 : round + a + (round > 300 ? 0.1 : 0);
      entry[0] = id;
      std::copy(box.begin(), box.end(), entry + 1);
      if (round == 1) expected.resize(1);
      if (id >= expected.size()) expected.resize(id + 1);
      expected[id] = box;
    }
    space.store.take(*ring, count);
    if (instance->ids.same()) CHECK(ring->dense == instance->ids.count() && ring->pages == 0);
    else CHECK(ring->dense == 0 && ring->room == 0 && ring->pages > 0);
    for (u32 id = 0; id < expected.size(); id++) {
      Box<D> held;
      if (instance->ids.slot(id) == Ids::none) continue;
      CHECK(space.store.get(id, held.data()) && held == expected[id]);
    }
  }
}

TEST("the last entry of a box in the ring counts, and the ring says what may wait") {
  check_ring<2>();
  check_ring<3>();
}
