// A strip sweep in parts, as generations make it.
#include "techniques/strip_sweep.hpp"

#include <algorithm>
#include <set>

#include "check.hpp"
#include "random.hpp"

namespace {

/// Boxes that stand the closer the further along each axis, so that strips have different lengths.
template <int D> std::vector<f32> crowd(Random& random, u32 count) {
  std::vector<f32> boxes(count * 2 * D + 4);
  for (u32 k = 0; k < count; k++) {
    for (u32 a = 0; a < D; a++) {
      f64 at = random.fraction();
      boxes[k * 2 * D + a] = f32(400 * (1 - at * at));
      boxes[k * 2 * D + D + a] = boxes[k * 2 * D + a] + f32(3 * random.fraction());
    }
  }
  return boxes;
}

template <int D> void check_parts(u32 count) {
  Random random(17);
  std::vector<f32> boxes = crowd<D>(random, count);
  Scene<D> scene{boxes.data(), count, nullptr};
  StripSweep<D> whole, parts;
  Pairs expected, found;
  Stats stats, stats_of_parts;
  whole.update(scene, Settings{}, expected, stats);
  parts.begin(scene, 1, stats_of_parts);
  parts.count(scene, 0, count);
  CHECK(parts.add_up());
  parts.touch(0, u32(stats_of_parts.entries));
  parts.enter(scene, 0, count / 2);
  parts.enter(scene, count / 2, count);
  u32 all = u32(stats_of_parts.entries), left = all, longest = 0;
  std::vector<u32> lengths;
  for (u32 before = all; left > 0; before = left) {
    left = parts.sweep(1, found);  // a strip each time
    CHECK(left < before);
    lengths.push_back(before - left);
    longest = std::max(longest, before - left);
  }
  CHECK(lengths.size() > 8);
  auto sorted = [](const Pairs& pairs) {
    return std::set<u64>(pairs.list.data(), pairs.list.data() + pairs.count);
  };
  CHECK(sorted(found) == sorted(expected));
  CHECK(found.count == expected.count);

  // Again, with room in each part for some strips: what is swept is as near to that as whole strips can be.
  u32 room = 2 * longest, at = 0;
  Pairs again;
  parts.begin(scene, 1, stats_of_parts);
  parts.count(scene, 0, count);
  CHECK(parts.add_up());
  parts.enter(scene, 0, count);
  for (u32 before = all; before > 0; before = left) {
    left = parts.sweep(room, again);
    u32 last = 0, sum = 0;
    while (sum < before - left) sum += last = lengths[at++];
    CHECK(sum == before - left);
    CHECK(sum <= room || sum - room <= room - (sum - last));
    CHECK(left == 0 || sum >= room || room - sum < sum + lengths[at] - room);
  }
  CHECK(again.count == expected.count);
}

}  // namespace

TEST("a strip sweep in parts sweeps whole strips, as many as come nearest to what it may, and finds the same pairs") {
  check_parts<2>(6000);
  check_parts<3>(6000);
}
