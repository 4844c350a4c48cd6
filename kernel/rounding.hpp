// Doubles to float32, outward: what is rounded down is never above, what is rounded up never below.
#pragma once
#include "simd.hpp"

inline f32 next_toward(f32 x, bool up) {
  i32 b = bits<i32>(x == 0 ? (up ? 0.0f : -0.0f) : x);
  return bits<f32>((b >= 0) == up ? b + 1 : b - 1);
}
inline f32 round_down(f64 x) {
  f32 near = f32(x);
  return f64(near) > x ? next_toward(near, false) : near;
}
inline f32 round_up(f64 x) {
  f32 near = f32(x);
  return f64(near) < x ? next_toward(near, true) : near;
}
