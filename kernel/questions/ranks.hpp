// The eight boxes of a block by how near they may be, to visit the nearest first.
// Idea: lower bounds of times or distances, as integers: floats from 0 on have the order of their bits, the last three of
// which are replaced by the lane. Most blocks are left after one or two of the eight. So these are not sorted, which
// takes unpredictable branches: the smallest is taken out again and again.
// Cost: about a dozen instructions for each box taken out.
#pragma once
#include "base/simd.hpp"

struct Ranks {
  static constexpr u32 lane_bits = 7, none = 0xffffffff;
  u32 of[8];

  /// Sets those of four boxes; `here`: whether they may be visited.
  void set(u32 half, f32x4 bounds, i32x4 here) {
    u32x4 lanes = u32x4{0, 1, 2, 3} + half;
    store(of + half, (bits<u32x4>(bounds) & ~lane_bits) | lanes | ~bits<u32x4>(here));
  }

  /// Takes out the nearest box, if it may be no further than `most`, and returns its lane; 8 if there is none.
  u32 take(f32 most) {
    u32 next = smallest(min(load<u32x4>(of), load<u32x4>(of + 4))), lane = next & lane_bits;
    if (next > (bits<u32>(most) | lane_bits)) return 8;
    of[lane] = none;
    return lane;
  }
};
