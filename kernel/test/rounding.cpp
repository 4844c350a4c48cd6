// Boxes rounded outward contain the numbers given, whether these are read themselves or as they were rounded for the
// search: rounding.hpp and seen_boxes.hpp.
#include "base/rounding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "boxes/gap_map.hpp"
#include "check.hpp"
#include "random.hpp"

namespace {

constexpr f64 infinite = std::numeric_limits<f64>::infinity();
constexpr f64 special[] = {0,      -0.0,    5e-324, -5e-324, 1e-46, -1e-46, 0x1p-149, -0x1p-149, 0x1p-126,
                           1e-30,  0.1,     -0.1,   1,       -1,    0x1p24, 16777217, 1e38,      -1e38,
                           3.5e38, -3.5e38, 1e39,   -1e39,   1e300, -1e300, infinite, -infinite};

f64 some_number(Random& random) {
  if (random.below(3) == 0) return special[random.below(std::size(special))];
  f64 size = std::ldexp(random.fraction() - 0.5, i32(random.below(280)) - 150);
  return random.below(2) ? f64(f32(size)) : size;
}

/// Whether the float32 bounds contain the numbers, and are no more than four steps of float32 away from them.
void check_bounds(f64 low, f64 high, f32 to_low, f32 to_high) {
  CHECK(f64(to_low) <= low);
  CHECK(f64(to_high) >= high);
  auto steps_down = [](f64 x) {
    f32 near = f32(std::clamp(x, -f64(__FLT_MAX__), f64(__FLT_MAX__)));
    for (u32 k = 0; k < 4; k++) near = std::nextafterf(near, -__builtin_inff());
    return near;
  };
  CHECK(to_low >= steps_down(low));
  CHECK(-to_high >= steps_down(-high));
}

template <int D> void check_rounding() {
  Random random(17);
  for (u32 k = 0; k < 20000; k++) {
    f64 box[2 * D];
    for (u32 a = 0; a < D; a++) {
      f64 one = some_number(random), other = some_number(random);
      box[a] = std::min(one, other);
      box[D + a] = std::max(one, other);
    }
    f32 direct[2 * D], nearest[2 * D], through[2 * D];
    round_outward<D>(box, direct);
    GapMap<D>().round(box, nearest);
    loosen<D>(load<f32x4>(nearest), load<f32x4>(nearest + 2 * D - 4), through);
    for (u32 a = 0; a < D; a++) {
      check_bounds(box[a], box[D + a], direct[a], direct[D + a]);
      check_bounds(box[a], box[D + a], through[a], through[D + a]);
    }
  }
}

}  // namespace

TEST("boxes rounded outward contain the numbers given, 2D") { check_rounding<2>(); }
TEST("boxes rounded outward contain the numbers given, 3D") { check_rounding<3>(); }
