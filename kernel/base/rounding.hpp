// Rounds doubles outward to float32, for bounds that must contain them: rounded down is never above, rounded up never
// below.
#pragma once
#include "base/box_tests.hpp"
#include "base/heap.hpp"

inline f32 next_toward(f32 x, bool up) {
  i32 b = bits<i32>(x == 0 ? (up ? 0.0f : -0.0f) : x);
  return bits<f32>((b >= 0) == up ? b + 1 : b - 1);
}
// Without a branch, since it would be unpredictable. If the nearest float is 0, it has the sign of x.
inline f32 round_down(f64 x) {
  f32 near = f32(x);
  i32 b = bits<i32>(near);
  return bits<f32>(b - (f64(near) > x ? b >> 31 | 1 : 0));
}
inline f32 round_up(f64 x) { return -round_down(-x); }

/// Twice the rounding error of a sum of two doubles, relative to them.
inline constexpr f64 sum_rounding = 0x1p-52;

/// The smallest double above x; NaN above infinity.
inline f64 next_up(f64 x) {
  u64 b = bits<u64>(x);
  return x == 0 ? 0x1p-1074 : bits<f64>(x > 0 ? b + 1 : b - 1);
}

/// The largest below x, and the smallest above; NaN where there is none.
inline f32 next_below(f64 x) {
  f32 least = round_down(x);
  return f64(least) < x ? least : next_toward(least, false);
}
inline f32 next_above(f64 x) { return -next_below(-x); }

/// Numbers below these, which were rounded to float32; above them where `sign` is -0. A bound that is too loose by a
/// last place or two costs less than asking which way each was rounded.
inline f32x4 loosened(f32x4 x, f32x4 sign) {
  auto turned = [&](f32x4 v) { return bits<f32x4>(bits<u32x4>(v) ^ bits<u32x4>(sign)); };
  f32x4 low = min(turned(x), splat(__FLT_MAX__));
  f32x4 most = bits<f32x4>(bits<u32x4>(low) & splat(0x7fffffffu));
  return turned(low - (most * splat(0x1p-23f) + splat(0x1p-149f)));
}

/// Loosens boxes that were rounded to the nearest float32, so that they contain what was rounded.
template <int D> void loosen(f32x4 first, f32x4 last, f32* to) {
  store_box<D>(to, loosened(first, f32x4{0.0f, 0.0f, D == 2 ? -0.0f : 0.0f, -0.0f}),
               loosened(last, f32x4{0.0f, -0.0f, -0.0f, -0.0f}));
}

/// A box rounded outward.
template <int D> void round_outward(const f64* box, f32* to) {
  f32x4 pairs[D], first, last;
  for (u32 k = 0; k < D; k++) pairs[k] = narrow(load<f64x2>(box + 2 * k));
  join(pairs, first, last);
  loosen<D>(first, last, to);
}
