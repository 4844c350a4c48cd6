// Tests of one box against another, in the scene's layout.
#pragma once
#include "base/heap.hpp"

/// A 2D box with the signs of its maxima flipped: the test of two boxes is then four comparisons of the same kind.
inline f32x4 turned(i32x4 box) { return bits<f32x4>(box ^ i32x4{0, 0, i32(1u << 31), i32(1u << 31)}); }

/// Whether two boxes overlap. If bounds of theirs that face each other are equal, lanes of `equal` are set, and perhaps its
/// last lane for no reason in 3D.
template <int D> bool boxes_touch(const f32* one, const f32* other, i32x4& equal) {
  if constexpr (D == 2) {
    i32x4 its = load<i32x4>(other);
    f32x4 mine = turned(load<i32x4>(one)), facing = turned(__builtin_shufflevector(its, its, 2, 3, 0, 1));
    equal |= mine == facing;
    return bitmask(mine <= facing) == 15;
  } else {
    f32x4 low = load<f32x4>(one), high = load<f32x4>(one + D), its_low = load<f32x4>(other);
    f32x4 its_high = load<f32x4>(other + D);
    equal |= (low == its_high) | (its_low == high);
    return !(~bitmask((low <= its_high) & (its_low <= high)) & 7);
  }
}
template <int D> bool boxes_touch(const f32* one, const f32* other) {
  i32x4 unused = {};
  return boxes_touch<D>(one, other, unused);
}

/// Whether `boxes_touch` has found equal bounds.
template <int D> bool any_equal(i32x4 equal) { return bitmask(equal) & (D == 2 ? 15 : 7); }

/// Whether some box lies at infinity along an axis, or as far away as float32 goes (see GapMap::bound). A difference of
/// such bounds is NaN or infinite instead of 0, so its pairs are not recorded as in doubt.
template <int D> NOINLINE bool some_nowhere(const f32* boxes, u32 count) {
  const f32x4 first = {1, 1, D == 2 ? -1 : 1, -1}, last = {1, D == 2 ? 1 : -1, -1, -1}, most = splat(__FLT_MAX__);
  i32x4 some = {};
  for (const f32* box = boxes; box < boxes + u64(count) * 2 * D; box += 2 * D)
    some |= (load<f32x4>(box) * first >= most) | (load<f32x4>(box + 2 * D - 4) * last >= most);
  return any(some);
}

/// Writes a box that is held as its first four numbers and its last four, which in 2D are the same.
template <int D> void store_box(f32* to, f32x4 first, f32x4 last) {
  store(to, first);
  if constexpr (D == 3) store(to + 2, last);
}

/// Makes these two of a box's numbers, given two at a time.
template <int D> void join(const f32x4 (&pairs)[D], f32x4& first, f32x4& last) {
  first = __builtin_shufflevector(pairs[0], pairs[1], 0, 1, 4, 5);
  last = __builtin_shufflevector(pairs[D - 2], pairs[D - 1], 0, 1, 4, 5);
}

/// The maxima of a box in the lanes of its minima.
template <int D> f32x4 maxima(f32x4 first, f32x4 last) {
  if constexpr (D == 2) return __builtin_shufflevector(first, first, 2, 3, 2, 3);
  else return __builtin_shufflevector(last, last, 1, 2, 3, 3);
}
