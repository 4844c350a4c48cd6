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
  ring->place(nullptr);
  std::vector<Box<D>> expected;
  for (u32 round = 1; round < rounds; round++) {
    u32 count = smaller(round, Ring<D>::usual_entries);
    for (u32 k = 0; k < count; k++) {
      f64* entry = ring->first() + k * Ring<D>::step;
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

/// Frames in which every box moves, written as JavaScript does. `frames`: how many boxes each has. In the second frame of
/// as many boxes, all wait until the update, unless there are too many, or the first one, as every third, had no memory.
template <int D> void check_larger_ring(std::vector<u32> frames) {
  auto instance = open<D>(Technique::strip_sweep);
  Space<D>& space = instance->space;
  auto ring = std::make_unique<Ring<D>>();
  ring->place(nullptr);
  space.store.take(*ring, 0);
  u32 had = 0;
  bool full = false;
  for (u32 frame = 0; frame < frames.size(); frame++) {
    const u32 count = frames[frame], usual = Ring<D>::usual_entries;
    while (instance->ids.count() > count) CHECK(space.store.remove(instance->ids.count() - 1));
    space.store.take(*ring, 0);
    const u32 usable = u32(ring->usable);
    const u64 limit = heap::limit;
    u32 waiting = 0, flushes = 0;
    auto box = [&](u32 id, u32 k) { return f64(id % 100) * 5 + (k < D ? 0 : 3) + frame * 0.1; };
    for (u32 id = 0; id < count; id++) {
      f64* entry = ring->first() + waiting++ * Ring<D>::step;
      entry[0] = id;
      for (u32 k = 0; k < 2 * D; k++) entry[1 + k] = box(id, k);
      if (waiting < ring->usable && id < ring->dense + ring->room) continue;
      space.store.take(*ring, waiting);
      waiting = 0;
      flushes++;
    }
    if (frame % 3 == 2) heap::limit = heap::used;
    space.store.take_for_update(*ring, waiting);
    heap::limit = limit;
    CHECK(space.update() == -1);
    if (count == had && !full) CHECK(count > Seen<D>::spared || count < usual || (flushes == 0 && usable > count));
    if (count > Seen<D>::spared) CHECK(ring->usable == usual);
    for (u32 id = 0; id < count; id++) {
      for (u32 k = 0; k < 2 * D; k++) CHECK(space.store.numbers.number(id, k) == box(id, k));
    }
    had = count;
    full = frame % 3 == 2;
  }
}

TEST("a ring that was too small for a frame gets larger, and its boxes stay") {
  std::vector<u32> frames = {100, 100, 700, 700, 700, 5000, 5000, 5000, 5000, 17000, 17000, 5000, 6500, 6500, 6500, 20};
  check_larger_ring<2>(frames);
  check_larger_ring<3>(frames);
}
