// The map from doubles to the float32 that are searched: monotone whatever it was chosen from, and made of pieces only
// where that helps.
#include "boxes/gap_map.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "check.hpp"
#include "random.hpp"

namespace {

/// Boxes in groups: `far` apart, with a share of them in the second and so on.
template <int D> std::vector<f64> grouped(Random& random, u32 count, u32 groups, f64 share, f64 far) {
  std::vector<f64> boxes;
  for (u32 k = 0; k < count; k++) {
    f64 offset = random.fraction() < share ? far * (1 + random.below(groups - 1)) : 0;
    f64 box[2 * D];
    for (int a = 0; a < D; a++) box[a] = random.fraction() * 1000 + offset;
    for (int a = 0; a < D; a++) box[D + a] = box[a] + 10;
    boxes.insert(boxes.end(), box, box + 2 * D);
  }
  return boxes;
}

template <int D> bool stays_plain(u32 groups, f64 share, f64 far) {
  Random random(3);
  std::vector<f64> boxes = grouped<D>(random, 1000, groups, share, far);
  GapMap<D> map;
  map.choose(boxes.data(), 1000, nullptr, 0);
  return map.is_plain();
}

template <int D> void check_monotone(Random& random) {
  u32 count = 64 + random.below(200), groups = 2 + random.below(8);
  f64 far = std::ldexp(1 + random.fraction(), int(random.below(600)) - 100);
  std::vector<f64> boxes = grouped<D>(random, count, groups, random.fraction(), far), probes = boxes;
  GapMap<D> map;
  map.choose(boxes.data(), count, nullptr, 0);
  for (u32 k = 0; k < 300; k++) probes.push_back((random.fraction() - 0.2) * far * groups);
  for (f64 x : {-__builtin_inf(), -1e308, -1.0, -0.0, 0.0, 1e308, __builtin_inf()}) probes.push_back(x);
  std::sort(probes.begin(), probes.end());
  f64 before[D];
  std::fill(before, before + D, -__builtin_inf());
  bool monotone = true, alike = true;
  for (f64 x : probes) {
    f64 point[2 * D];
    f32 rounded[2 * D], many[2 * D];
    std::fill(point, point + 2 * D, x);
    map.round(point, rounded);
    map.round_all(point, 1, many);
    for (int a = 0; a < D; a++) {
      f64 mapped = map.map(x, u32(a));
      monotone &= mapped >= before[a];
      before[a] = mapped;
      f64 low = std::clamp(mapped, -f64(__FLT_MAX__), f64(__FLT_MAX__));
      bool endless = std::isinf(x);
      alike &= endless || (rounded[a] == f32(low) && rounded[D + a] == f32(low));
      alike &= many[a] == (f64(f32(x)) == x ? f32(x) : rounded[a]);
    }
  }
  CHECK(monotone);
  CHECK(alike);
}

}  // namespace

TEST("maps are monotone, and many boxes are rounded as one is") {
  Random random(21);
  for (u32 k = 0; k < 500; k++) {
    check_monotone<2>(random);
    check_monotone<3>(random);
  }
}

TEST("gaps are removed unless few boxes are far, and not too far for float32") {
  CHECK(stays_plain<2>(2, 0.05, -1e5) && stays_plain<3>(2, 0.05, -1e5));
  CHECK(stays_plain<2>(2, 0.001, 1e12) && stays_plain<3>(2, 0.001, 1e12));
  CHECK(!stays_plain<2>(2, 0.1, 1e7) && !stays_plain<3>(2, 0.1, 1e7));
  CHECK(!stays_plain<2>(2, 0.5, 1e5) && !stays_plain<3>(2, 0.5, 1e5));
  CHECK(!stays_plain<2>(8, 0.9, 1e12) && !stays_plain<3>(8, 0.9, 1e12));
}
