// The area of a query in float32: which boxes of a block touch it, and which are within it.
#pragma once
#include "base/rounding.hpp"
#include "questions/index.hpp"

template <int D> struct AreaAim {
  f32x4 lo[D], hi[D];  // each number in all lanes

  /// Sets its bounds along an axis; `closed`: touching them counts. They are rounded inward, which is exact, since they
  /// are compared with float32 numbers.
  SMALL void set(int axis, f64 low, f64 high, bool closed) {
    lo[axis] = splat(closed ? round_up(low) : next_above(low));
    hi[axis] = splat(closed ? round_down(high) : next_below(high));
  }

  /// For four boxes: whether they touch it.
  i32x4 reaches(const typename Index<D>::Block& block, u32 half) const {
    i32x4 all = bits<i32x4>(u32x4{} == u32x4{});
    for (int a = 0; a < D; a++) {
      all &= load<f32x4>(block.lo[a] + half) <= hi[a];
      all &= load<f32x4>(block.hi[a] + half) >= lo[a];
    }
    return all;
  }

  /// One bit for each of eight boxes that touch it.
  NOINLINE u32 touched(const typename Index<D>::Block& block) const {
    u32 found = 0;
    ROLLED for (u32 half = 0; half < 8; half += 4) found |= bitmask(reaches(block, half)) << half;
    return found;
  }

  /// One bit for each of eight boxes that lie within it.
  u32 within(const typename Index<D>::Block& block) const {
    u32 found = 0;
    ROLLED for (u32 half = 0; half < 8; half += 4) {
      i32x4 all = bits<i32x4>(u32x4{} == u32x4{});
      for (int a = 0; a < D; a++) {
        all &= load<f32x4>(block.lo[a] + half) >= lo[a];
        all &= load<f32x4>(block.hi[a] + half) <= hi[a];
      }
      found |= bitmask(all) << half;
    }
    return found;
  }
};
