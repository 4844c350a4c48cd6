// How boxes move, and the fat boxes that hold them for some updates to come.
// Idea: a fat box reaches as far as the motion of its box will take it, and a little to all sides.
// From: candidates kept with a margin, L. Verlet, "Computer Experiments on Classical Fluids", 1967; fat boxes, as in
// the dynamic trees of Bullet and Box2D.
#pragma once
#include "pairs.hpp"
#include "settings.hpp"

/// Of a vector: the largest of the lanes that are axes.
template <int D> f32 widest(f32x4 v) { return D == 2 ? larger(v[0], v[1]) : larger(larger(v[0], v[1]), v[2]); }

/// How far a box moved in an update, as a share of its size, at most 1, given where its lower corner was so many ago.
/// Of `low`, as of all boxes here, four floats may be read.
template <int D> f32 pace(const f32* box, const f32* low, u32 updates) {
  f32x4 at = load<f32x4>(box), step = (at - load<f32x4>(low)) * splat(1 / f32(updates));
  step = max(step, -step);
  f32x4 share = min(step / (load<f32x4>(box + D) - at), splat(1.0f));
  return widest<D>(bits<f32x4>(bits<i32x4>(share) & (step > splat(0.0f))));
}

/// The fat box of a box: what its motion will cover in so many updates, given where it was so many ago, and `slack`
/// motions of one update to all sides; or just the margin that is asked for. Writes two floats more than a box has.
template <int D> void fatten(const f32* box, const f32* low, u32 updates, f32 until, f32 slack, f64 margin, f32* out) {
  f32x4 first = load<f32x4>(box), last = load<f32x4>(box + D), size = last - first, none = splat(0.0f);
  f32x4 step = (first - load<f32x4>(low)) * splat(1 / f32(updates));
  step = bits<f32x4>(bits<i32x4>(step) & (step <= size) & (-step <= size));  // a jump says nothing about what comes
  f32 fastest = widest<D>(max(step, -step));
  f32x4 aside = splat(margin > 0 ? f32(margin) : slack * fastest), reach = step * splat(margin > 0 ? 0 : until);
  store(out, min(first + min(reach, none) - aside, first));
  store(out + D, max(last + max(reach, none) + aside, last));
}

/// Of a box in 2D with the signs of its maxima turned round: then tests of two boxes are four comparisons of one kind.
inline f32x4 turned(i32x4 box) { return bits<f32x4>(box ^ i32x4{0, 0, i32(1u << 31), i32(1u << 31)}); }

template <int D> bool touch(const f32* one, const f32* other) {
  if constexpr (D == 2) {
    i32x4 its = load<i32x4>(other);
    return bitmask(turned(load<i32x4>(one)) <= turned(__builtin_shufflevector(its, its, 2, 3, 0, 1))) == 15;
  } else {
    u32 both = bitmask((load<f32x4>(one) <= load<f32x4>(other + D)) & (load<f32x4>(other) <= load<f32x4>(one + D)));
    return !(~both & 7);
  }
}

/// Along which sides a box is in another; in all lanes: it is.
template <int D> i32x4 sides_inside(const f32* box, const f32* other) {
  if constexpr (D == 2) {
    return turned(load<i32x4>(other)) <= turned(load<i32x4>(box));
  } else {
    i32x4 sides = (load<f32x4>(other) <= load<f32x4>(box)) & (load<f32x4>(box + D) <= load<f32x4>(other + D));
    return sides | i32x4{0, 0, 0, -1};
  }
}

/// Along which axes no minimum is above the maximum, and none is NaN.
template <int D> i32x4 axes_in_order(const f32* box) {
  return (load<f32x4>(box) <= load<f32x4>(box + D)) | (D == 2 ? i32x4{0, 0, -1, -1} : i32x4{0, 0, 0, -1});
}

/// Whether a box is in another.
template <int D> bool inside(const f32* box, const f32* other) { return bitmask(sides_inside<D>(box, other)) == 15; }
