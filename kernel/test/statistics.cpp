// The sample of a frame (scene_sample.hpp), and the maps from coordinates to cells derived from it.
#include "boxes/scene_sample.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "check.hpp"
#include "scenes.hpp"

namespace {

using Limits = std::numeric_limits<f32>;

/// Coordinates of all magnitudes, and those around the borders of a range.
std::vector<f32> probes(Random& random, f64 low, f64 high) {
  std::vector<f32> all = {0.0f,
                          -0.0f,
                          Limits::infinity(),
                          -Limits::infinity(),
                          Limits::max(),
                          Limits::lowest(),
                          Limits::denorm_min(),
                          -Limits::denorm_min(),
                          Limits::min()};
  for (int k = 0; k < 300; k++) {
    f32 any = bits<f32>(u32(random.bits64()));
    if (any == any) all.push_back(any);
    all.push_back(outward(low + (high - low) * (1.5 * random.fraction() - 0.25), false));
  }
  for (f64 border : {low, high, (low + high) / 2}) {
    if (border != border) continue;
    f32 at = outward(border, false);
    all.push_back(at);
    all.push_back(std::nextafter(at, Limits::infinity()));
    all.push_back(std::nextafter(at, -Limits::infinity()));
  }
  std::sort(all.begin(), all.end());
  return all;
}

u32 cell_of(const Axis& axis, f32 x) { return Axes(axis, axis, axis, axis)(splat(x))[0]; }

void check_axis(Random& random, f64 low, f64 high, u32 cells) {
  testing::Where where(std::to_string(low) + " to " + std::to_string(high) + " in " + std::to_string(cells));
  Axis axis = Axis::make(low, high, cells);
  Axes axes(axis, axis, axis, axis);
  u32 before = 0;
  bool monotone = true, clamped = true, alike = true;
  for (f32 x : probes(random, low, high)) {
    u32x4 four = axes(splat(x));
    u32 cell = four[0];
    monotone &= cell >= before;
    clamped &= cell < cells;
    for (int lane = 1; lane < 4; lane++) alike &= four[lane] == cell;
    before = cell;
  }
  CHECK(monotone);
  CHECK(clamped);
  CHECK(alike);
}

}  // namespace

TEST("axis is monotone and clamped for any range") {
  Random random(4);
  const f64 ends[] = {0,   -0.0, 1,    -1,    1000,   1e-45,   -1e-45, 1e-38,  1e-300,  5e-324,
                      1e9, -1e9, 1e30, -1e38, 3.4e38, -3.4e38, 1e300,  -1e300, 1.7e308, -1.7e308};
  for (f64 low : ends) {
    for (f64 high : ends) {
      for (u32 cells : {1u, 2u, 3u, 255u, 4096u, 1u << 20, (1u << 23) + 1, 1u << 24}) {
        check_axis(random, low, high, cells);
      }
    }
  }
  for (int k = 0; k < 2000; k++) {
    f64 scale = std::ldexp(1, int(random.below(300)) - 150), low = (random.fraction() - 0.5) * scale;
    check_axis(random, low, low + random.fraction() * scale, 1 + random.below(5000));
  }
  f64 nan = std::nan(""), infinity = std::numeric_limits<f64>::infinity();
  check_axis(random, nan, nan, 10);
  check_axis(random, infinity, -infinity, 10);
  check_axis(random, -infinity, infinity, 10);
  CHECK(cell_of(Axis::make(0, 10, 11), Limits::quiet_NaN()) == 0);
}

TEST("axis puts whole steps in the middle of cells") {
  Axis axis = Axis::make(-5, 5, 11);
  for (int k = 0; k <= 10; k++) CHECK(cell_of(axis, f32(k - 5)) == u32(k));
  CHECK(cell_of(axis, -4.51f) == 0 && cell_of(axis, -4.49f) == 1);
  CHECK(cell_of(axis, 99) == 10 && cell_of(axis, -99) == 0);
}

TEST("samples are taken from all boxes, the last ones too") {
  for (u32 count : {16u, 47u, 511u, 2000u, 4095u, 70000u}) {
    u32 n = count < 64 ? 16 : detail::samples_of(count), behind = 0, largest_gap = 0;
    Sampling sampling(count, n);
    for (u32 k = 0; k < n; k++) {
      u32 slot = sampling.next();
      CHECK(slot >= behind && slot < count);
      largest_gap = larger(largest_gap, slot - behind);
      behind = slot + 1;
    }
    CHECK(larger(largest_gap, count - behind) <= 2 * (count / n + 1));
  }
}

TEST("statistics leave out outliers") {
  Random random(5);
  Boxes<2> boxes = spread<2>(random, 2000, 0, 100, 4);
  SceneSample<2> found;
  auto measured = [&] {
    std::vector<f32> floats;
    for (const auto& box : boxes) floats.insert(floats.end(), box.begin(), box.end());
    Scene<2> scene{floats.data(), u32(boxes.size()), nullptr};
    return measure<2>(SceneItems<2>{scene, AxisOrder<2>::make(0)}, scene.count);
  };
  found = measured();
  CHECK(found.low[0] < 2 && found.high[0] > 98 && std::abs(found.size[0] - 2) < 0.3 && found.crowding < 1.5);
  for (int k = 0; k < 10; k++) boxes[random.below(2000)] = {1e9, -1e30, 1e9, 1e30};
  found = measured();
  CHECK(found.low[0] >= 0 && found.high[0] < 101 && found.low[1] >= 0 && found.high[1] < 101);
}

// Objects of a pool that wait somewhere, or another room: the extents, and how crowded the world is, are those of most.
TEST("statistics leave out a group far from the others") {
  Random random(8);
  for (u32 count : {100u, 300u, 1000u, 5000u}) {
    for (u32 share : {1u, 3u, 5u}) {
      for (f64 far : {-5000.0, 1e5, 1e9, -1e30}) {
        testing::Where where(std::to_string(share) + " % of " + std::to_string(count) + " at " + std::to_string(far));
        std::vector<f32> floats;
        for (const auto& box : spread<2>(random, count, 0, 100, 4)) {
          bool is_far = random.below(100) < share;
          for (f64 x : box) floats.push_back(f32(is_far ? x + far : x));
        }
        Scene<2> scene{floats.data(), count, nullptr};
        SceneItems<2> items{scene, AxisOrder<2>::make(0)};
        for (const auto& one : {measure<2>(items, count), glance<2>(items, count)}) {
          CHECK(one.low[0] >= 0 && one.high[0] < 105 && one.high[1] - one.low[1] > 80 && one.crowding < 4);
        }
      }
    }
  }
}

TEST("a glance is not misled by the size of a box around the world") {
  Random random(9);
  for (f32 end : {1e6f, Limits::infinity()}) {
    std::vector<f32> floats = {-end, -end, end, end, 50, 50, end, end};
    for (const auto& box : spread<2>(random, 298, 0, 100, 4)) {
      for (f64 x : box) floats.push_back(f32(x));
    }
    Scene<2> scene{floats.data(), 300, nullptr};
    SceneSample<2> seen = glance<2>(SceneItems<2>{scene, AxisOrder<2>::make(0)}, 300);
    CHECK(seen.low[0] >= 0 && seen.high[0] < 101 && seen.size[0] > 1 && seen.size[0] < 5);
  }
}

TEST("values that are all alike but one are a range of nothing") {
  for (u32 one : {0u, 99u}) {
    std::vector<f32> values(100, 0.0f);
    values[one] = 1e30f;
    f64 low = 0, high = 1e30;
    detail::narrow_to_most(values.data(), 100, 100, low, high);
    CHECK(low == 0 && high == 0);
  }
}

TEST("cube roots are close") {
  Random random(6);
  for (int k = 0; k < 10000; k++) {
    f64 x = std::ldexp(1 + random.fraction(), int(random.below(600)) - 300);
    CHECK(std::abs(cube_root(x) / std::cbrt(x) - 1) < 1e-6);
  }
}

TEST("quickselect finds every rank") {
  Random random(7);
  for (i32 n : {1, 2, 3, 10, 100}) {
    for (i32 k = 0; k < n; k++) {
      std::vector<f32> values(static_cast<size_t>(n));
      for (auto& value : values) value = f32(random.below(30));
      std::vector<f32> ordered = values;
      std::sort(ordered.begin(), ordered.end());
      CHECK(kth_smallest(values.data(), n, k) == ordered[size_t(k)]);
    }
  }
}
