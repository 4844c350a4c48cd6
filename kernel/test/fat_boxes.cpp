// Boxes at rest in blocks of four, and the pairs that are found in them.
#include "candidates.hpp"

#include "check.hpp"

TEST("fat boxes end with one that overlaps nothing, and a mover meets all of them, however many") {
  using Movers = FatBoxes<2, 3>;
  using Stills = FatBoxes<2, 0>;
  constexpr u32 most = 150;
  const f32 low[4] = {}, high[4] = {100, 100, 0, 0};
  Stills stills;
  Movers movers;
  Candidates<2> candidates{};
  Candidates<2>::Room room;
  f32 boxes[4 * (most + 1) + 4] = {};
  u64 found[most + 8];
  f32 mover[4] = {1, 1, 2, 2};
  __builtin_memcpy(boxes + 4 * most, mover, sizeof(mover));
  movers.put(mover, most);
  auto check = [&](u32 count) {
    CHECK(stills.count == count);
    CHECK(stills.numbers(count)[0] != stills.numbers(count)[0]);  // NaN
    CHECK(stills.slot(count) == slot_mask);
    candidates.clear(room);
    candidates.meet(room, movers, 0, 1, stills);
    u64* end = candidates.report(boxes, low, high, found);
    CHECK(u32(end - found) == count);
  };
  for (u32 count = 0; count < most; count++) {
    stills.put(mover, count);
    check(count + 1);
  }
  for (u32 gone = 1; gone <= most; gone++) {
    u32 slot = gone * 7 % most;  // each once
    stills.take(stills.find(slot));
    CHECK(stills.find(slot) == Stills::nowhere);
    check(most - gone);
  }
  stills.release();
  movers.release();
  candidates.clear(room);
}
