// Which boxes have changed, as the space is told.
#include "changes.hpp"

#include "check.hpp"
#include "inbox.hpp"

TEST("changes have room for as many as they say, and name each once") {
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

template <int D> void check_inbox() {
  constexpr u32 width = 2 * D;
  constexpr u32 slots = 40, rounds = 500;
  f32 boxes[slots * width] = {}, expected[slots * width] = {};
  Inbox<D> inbox;
  Changes changes;
  changes.make_room(slots);
  for (u32 round = 0; round < rounds; round++) {
    changes.clear(slots);
    bool noted[slots] = {};
    for (u32 k = 0; !inbox.full() && k < round; k++) {
      u32 slot = k * 7 % slots;
      f32 box[width];
      for (u32 a = 0; a < width; a++) box[a] = f32(k % 3 == 0 ? 0 : round + a);
      inbox.put(slot, load<f32x4>(box), load<f32x4>(box + width - 4));
      for (u32 a = 0; a < width; a++) {
        if (expected[slot * width + a] < box[a] || box[a] < expected[slot * width + a]) noted[slot] = true;
        expected[slot * width + a] = box[a];
      }
    }
    CHECK(inbox.full() == (round >= 64));
    inbox.empty(boxes, changes);
    CHECK(!inbox.full());
    CHECK(__builtin_memcmp(boxes, expected, sizeof(boxes)) == 0);
    u32 count = 0;
    for (bool one : noted) count += one;
    CHECK(changes.count() == count);
    for (u32 k = 0; k < changes.count(); k++) CHECK(noted[changes.list()[k]]);
  }
}

TEST("of boxes on their way the last counts, and those are noted that are not what stood there") {
  check_inbox<2>();
  check_inbox<3>();
}
