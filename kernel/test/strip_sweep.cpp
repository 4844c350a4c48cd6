// What a strip sweep answers once it has found the pairs.
#include "techniques/strip_sweep.hpp"

#include <algorithm>
#include <set>

#include "box_tests.hpp"
#include "check.hpp"
#include "random.hpp"

namespace {

/// Boxes that stand the closer the further along each axis, so that strips have different lengths; or all in a row.
template <int D> std::vector<f32> crowd(Random& random, u32 count, bool in_a_row, bool huge = false) {
  std::vector<f32> boxes(count * 2 * D + 4);
  for (u32 k = 0; k < count; k++) {
    for (u32 a = 0; a < D; a++) {
      f64 at = random.fraction(), size = k % 500 == 0 || huge ? 390 : 3;
      boxes[k * 2 * D + a] = in_a_row && a > 0 ? 0 : f32(400 * (1 - at * at));
      boxes[k * 2 * D + D + a] = boxes[k * 2 * D + a] + f32(size * random.fraction());
    }
  }
  return boxes;
}

template <int D> void check_near(u32 count, bool in_a_row, bool huge = false) {
  Random random(17);
  std::vector<f32> boxes = crowd<D>(random, count, in_a_row, huge);
  Scene<D> scene{boxes.data(), count, nullptr};
  StripSweep<D> plain, searched;
  Pairs expected, found;
  Stats stats, stats_searched;
  plain.update(scene, Settings{}, expected, stats);
  searched.update_searched(scene, found, stats_searched);
  auto sorted = [](const Pairs& pairs) {
    return std::set<u64>(pairs.list.data(), pairs.list.data() + pairs.count);
  };
  CHECK(sorted(found) == sorted(expected));
  CHECK(found.count == expected.count);
  std::vector<f32> askers = crowd<D>(random, 200, in_a_row);
  for (u32 k = 0; k < 200; k++) {
    const f32* box = askers.data() + k * 2 * D;
    std::vector<u32> near, touching;
    searched.each_near(box, [&](u32 slot) { near.push_back(slot); });
    for (u32 slot = 0; slot < count; slot++) {
      if (boxes_touch<D>(box, scene.box(slot))) touching.push_back(slot);
    }
    std::sort(near.begin(), near.end());
    CHECK(near == touching);
  }
}

}  // namespace

TEST("a strip sweep that is searched finds the same pairs, and each box that touches one, once") {
  for (bool in_a_row : {false, true}) {
    check_near<2>(6000, in_a_row);
    check_near<3>(6000, in_a_row);
    check_near<2>(300, in_a_row);
  }
  check_near<2>(2500, false, true);  // so large that cutting them does not pay
  check_near<3>(2500, false, true);
}
