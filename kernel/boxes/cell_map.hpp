// From coordinates to cells. The map is monotone, so the cells of overlapping boxes overlap too.
#pragma once
#include "base/heap.hpp"

/// A monotone map from a coordinate to a cell index in [0, cells): the distance from `low`, scaled and clamped.
/// Adding 2^23 leaves the nearest integer in the low bits of the float. That is one addition; a conversion that must
/// not trap takes many instructions. `shrink` is a power of two that brings the extent near 1, so that neither denormal
/// nor huge extents overflow.
struct Axis {
  static constexpr f32 whole = 8388608;  // 2^23
  f32 low = 0, shrink = 0, scale = 0, last = 0;

  SMALL static Axis make(f64 low, f64 high, u32 cells) {
    Axis axis{f32(low), 1, 0, whole};
    f64 extent = high - low;
    if (!(extent > 0) || cells < 2) return axis;
    i32 exponent = i32(bits<u64>(extent) >> 52) - 1023;
    exponent = larger(-126, smaller(126, exponent));
    axis.shrink = bits<f32>(u32(127 - exponent) << 23);
    axis.scale = f32((cells - 1) / (extent * f64(axis.shrink)));
    axis.last = whole + f32(cells - 1);
    return axis;
  }
};

/// The cells of four coordinates at once; each lane has its own axis.
struct Axes {
  f32x4 low, shrink, scale, last;

  Axes() = default;
  Axes(const Axis& a, const Axis& b, const Axis& c, const Axis& d)
      : low{a.low, b.low, c.low, d.low},
        shrink{a.shrink, b.shrink, c.shrink, d.shrink},
        scale{a.scale, b.scale, c.scale, d.scale},
        last{a.last, b.last, c.last, d.last} {}

  u32x4 operator()(f32x4 x) const {
    f32x4 at = (x - low) * shrink * scale + splat(Axis::whole);
    at = min(max(at, splat(Axis::whole)), last);  // NaN, from infinity times a scale of 0, becomes cell 0
    return bits<u32x4>(at) - splat(bits<u32>(Axis::whole));
  }
};
