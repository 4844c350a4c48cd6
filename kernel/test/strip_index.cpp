// Strips that are filled first and swept later, and the search for boxes in them: strip_sweep.hpp, strip_index.hpp.
#include "search/strip_index.hpp"

#include <algorithm>
#include <cmath>

#include "check.hpp"
#include "crowd.hpp"
#include "techniques/strip_sweep.hpp"

namespace {

std::vector<u64> sorted(const Pairs& pairs) {
  std::vector<u64> list(pairs.list.data(), pairs.list.data() + pairs.count);
  std::sort(list.begin(), list.end());
  return list;
}

template <int D> void check_swept(const Scene<D>& scene, StripSweep<D>& parts) {
  StripSweep<D> whole;
  Pairs all, some;
  Stats stats, of_swept;
  whole.update(scene, Options{}, all, stats);
  parts.fill(scene, of_swept, true);
  CHECK(parts.sweep(some, 1e9));
  CHECK(sorted(some) == sorted(all));
  // In 3D, columns are made for the search even if the sweep alone takes less time without.
  CHECK(D == 2 ? of_swept.entries == stats.entries : of_swept.entries >= scene.count);
  whole.release();
  all.list.release();
  some.list.release();
}

template <int D> void check_near(u32 count, bool in_a_row, f64 huge, bool uneven = false) {
  Random random(23);
  std::vector<f32> boxes = crowd<D>(random, count, in_a_row, huge), others = crowd<D>(random, 200, in_a_row, huge);
  // A world in which each quarter of the boxes is a hundred times as small as the one before.
  for (u32 k = 0; uneven && k < count * 2 * D; k++) boxes[k] *= f32(std::pow(100, k / (2 * D) % 4));
  Scene<D> scene{boxes.data(), count, nullptr};
  StripSweep<D> parts;
  check_swept(scene, parts);
  for (u32 k = 0; k < 200; k++) {
    const f32* box = others.data() + k * 2 * D;
    u64 met = 0;
    std::vector<u32> near(count + 1), touching;
    near.resize(parts.near(box, near.data(), met));
    CHECK(met >= near.size());
    for (u32 slot = 0; slot < count; slot++) {
      if (boxes_touch<D>(box, boxes.data() + slot * 2 * D)) touching.push_back(slot);
    }
    std::sort(near.begin(), near.end());
    CHECK(near == touching);
  }
  parts.release();
}

}  // namespace

TEST("strips filled first and swept later give the same pairs; each box that touches another is found in them, once") {
  for (bool in_a_row : {false, true}) {
    for (f64 huge : {0.0, 0.01, 1.0}) {
      for (u32 count : {2u, 17u, 300u, 1500u}) {
        check_near<2>(count, in_a_row, huge);
        check_near<3>(count, in_a_row, huge);
      }
    }
  }
  check_near<2>(6000, false, 0.001, true);
  check_near<3>(6000, false, 0.001, true);
}
