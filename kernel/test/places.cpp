// Finding regions in the grids of places.hpp.
#include "coherence/places.hpp"

#include <algorithm>

#include "base/box_tests.hpp"
#include "check.hpp"
#include "crowd.hpp"

namespace {

template <int D> void check_near(u32 count, bool in_a_row, f64 huge, f64 spacing) {
  Random random(17);
  std::vector<f32> boxes = crowd<D>(random, count, in_a_row, huge), others = crowd<D>(random, count, in_a_row, huge);
  Places<D> places;
  places.clear(count, spacing);
  CHECK(places.has_room());
  std::vector<bool> stands(count, true);
  const std::vector<f32> bases = boxes;
  for (u32 slot = 0; slot < count; slot++) {
    places.keep_base(boxes.data() + slot * 2 * D, slot);
    places.put(boxes.data() + slot * 2 * D, slot);
  }
  for (u32 slot = 0; slot < count; slot += 3) {
    places.remove(boxes.data() + slot * 2 * D, slot);
    stands[slot] = slot % 2;
    if (!stands[slot]) continue;  // the others are put where they have moved to, and half of them leave that place too
    auto go_to = [&](u32 other) {
      std::copy_n(others.data() + other * 2 * D, 2 * D, boxes.data() + slot * 2 * D);
      places.put(boxes.data() + slot * 2 * D, slot);
    };
    go_to(slot);
    if (slot % 4 == 1) {
      places.remove(boxes.data() + slot * 2 * D, slot);
      go_to(count - slot);
    }
  }
  for (u32 k = 0; k < 200; k++) {
    const f32* box = others.data() + k * 2 * D;
    u64 met = 0;
    std::vector<u32> near(count + 1), touching;
    near.resize(places.near(box, boxes.data(), near.data(), met));
    CHECK(met >= near.size());
    for (u32 slot = 0; slot < count; slot++) {
      if (stands[slot] && boxes_touch<D>(box, boxes.data() + slot * 2 * D)) touching.push_back(slot);
    }
    std::sort(near.begin(), near.end());
    CHECK(near == touching);
  }
  for (u32 slot = 0; slot < count; slot++) {
    CHECK(std::equal(bases.data() + slot * 2 * D, bases.data() + (slot + 1) * 2 * D, places.base(slot)));
  }
  places.forget_base(0);
  CHECK(!boxes_touch<D>(places.base(0), bases.data()));
}

}  // namespace

TEST("each region that touches another is found in the places, once") {
  for (bool in_a_row : {false, true}) {
    for (f64 huge : {0.0, 0.01, 1.0}) {
      for (f64 spacing : {0.0, 10.0, 1e-3, 1e9, __builtin_inf()}) {
        check_near<2>(1500, in_a_row, huge, spacing);
        check_near<3>(1500, in_a_row, huge, spacing);
        check_near<2>(300, in_a_row, huge, spacing);
      }
    }
  }
}
