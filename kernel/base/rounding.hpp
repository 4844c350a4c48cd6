// Rounds doubles outward to float32, for bounds that must contain them: rounded down is never above, rounded up never
// below.
#pragma once
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

/// The ends of a range in float32, inward, so that each float32 is within as it was; `closed`: the ends are.
SMALL inline void round_inward(f64 lo, f64 hi, bool closed, f32& to_lo, f32& to_hi) {
  to_lo = closed ? round_up(lo) : next_above(lo);
  to_hi = closed ? round_down(hi) : next_below(hi);
}

/// Two doubles as float32, in the lower lanes: down, or up where `sign` is -0.
inline f32x4 round_down(f64x2 x, f64x2 sign) {
  f64x2 at = bits<f64x2>(bits<u64x2>(x) ^ bits<u64x2>(sign));
  f32x4 near = narrow(at);
  i32x4 above = bits<i32x4>(widen(near) > at), b = bits<i32x4>(near);
  above = __builtin_shufflevector(above, above, 0, 2, 0, 2);
  b -= (b >> 31 | 1) & above;
  return bits<f32x4>(bits<u32x4>(b) ^ bits<u32x4>(narrow(sign)));
}

/// A box rounded outward.
template <int D> void round_outward(const f64* box, f32* to) {
  for (u32 a = 0; a < D; a++) {
    f64x2 numbers = load<f64x2>(box + 2 * a);
    f32x4 pair = round_down(numbers, f64x2{2 * a < D ? 0.0 : -0.0, 2 * a + 1 < D ? 0.0 : -0.0});
    __builtin_memcpy(to + 2 * a, &pair, 2 * sizeof(f32));
  }
}
