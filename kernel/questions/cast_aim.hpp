// The path of a ray or a moving box in float32: which boxes it may meet before a given time, and when at the earliest.
// Idea: per axis, it enters the range of a box at one time and leaves it at another. It may meet the box if it enters the
// last range before it leaves the first. Bounds are rounded outward and times have slack, so that nothing is missed.
// From: T. Kay and J. Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986.
#pragma once
#include "questions/index.hpp"
#include "questions/ranks.hpp"

template <int D> struct CastAim {
  f32 enter[D], leave[D];  // its sides: per axis the one that meets a box first, and the one that leaves it last
  f32 slowness[D];  // time per unit of distance
  u32 front[D];  // where in a block the sides are that it meets first
  f32 most;  // the time when the search ends

  /// Takes the path of a box; false where float32 overflows or loses digits.
  SMALL bool take(const f64* lo, const f64* hi, const f64* along) {
    constexpr f64 tame = 1e30;
    bool is_tame = true;
    for (int a = 0; a < D; a++) {
      f64 far = __builtin_fabs(along[a]);
      is_tame &= lo[a] > -tame && hi[a] < tame && (far == 0 || (far > 1 / tame && far < tame));
      f32 low = round_down(lo[a]), high = round_up(hi[a]);
      bool forth = along[a] >= 0;
      enter[a] = forth ? high : low;
      leave[a] = forth ? low : high;
      slowness[a] = far == 0 ? __builtin_inff() : f32(1 / along[a]);
      front[a] = 8 * (forth ? a : D + a);
    }
    return is_tame;
  }

  /// For four boxes: whether it may meet them in time. `times`: lower bounds for when it does; perhaps a little below 0.
  i32x4 reaches(const typename Index<D>::Block& block, u32 half, f32x4& times) const {
    constexpr f32 slack = 2e-6f, least_slack = 2e-37f;
    const f32* sides = block.lo[0] + half;
    f32x4 begin = {}, end = splat(most);
    for (int a = 0; a < D; a++) {
      u32 back = 8 * (D + 2 * a) - front[a];
      // NaN is ignored: at a side along which it slides, 0 times infinity.
      begin = max((load<f32x4>(sides + front[a]) - splat(enter[a])) * splat(slowness[a]), begin);
      end = min((load<f32x4>(sides + back) - splat(leave[a])) * splat(slowness[a]), end);
    }
    times = begin * splat(1 - slack) - splat(least_slack);
    i32x4 is_box = load<f32x4>(sides) == load<f32x4>(sides);
    return is_box & (times <= end);
  }
  i32x4 reaches(const typename Index<D>::Block& block, u32 half) const {
    f32x4 times;
    return reaches(block, half, times);
  }

  /// Ranks the eight boxes of a block by these times.
  NOINLINE void rank(const typename Index<D>::Block& block, Ranks& to) const {
    ROLLED for (u32 half = 0; half < 8; half += 4) {
      f32x4 times;
      i32x4 here = reaches(block, half, times);
      to.set(half, max(f32x4{}, times), here);
    }
  }
};
