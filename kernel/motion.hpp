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

/// The bounds of all boxes. What moves towards them turns round there, more often than not.
struct Walls {
  static constexpr f32 inf = __builtin_inff();
  f32x4 least = {-inf, -inf, -inf, -inf}, most = {inf, inf, inf, inf};

  /// To hold boxes, of which there are none yet.
  static Walls empty() { return {splat(inf), splat(-inf)}; }

  template <int D> void hold(const f32* box) {
    least = min(load<f32x4>(box), least);
    most = max(load<f32x4>(box + D), most);
  }
};

inline constexpr Walls no_walls;

/// The fat box of a box: what its motion will cover between so many updates from now and so many, given where it was
/// `updates` ago, and `slack` motions of one update to all sides; or just the margin that is asked for. Where it would
/// reach beyond the walls it reaches as far back from them, and two motions, since not all turn in the same way.
/// Writes two floats more than a box has.
template <int D>
NOINLINE void fatten(const f32* box, const f32* low, u32 updates, f32 from, f32 until, const Walls& walls, f32 slack,
                     f64 margin, f32* out) {
  f32x4 first = load<f32x4>(box), last = load<f32x4>(box + D), size = last - first, none = splat(0.0f);
  f32x4 step = (first - load<f32x4>(low)) * splat(1 / f32(updates));
  f32x4 speed = max(step, -step);
  // A jump says nothing about what comes.
  i32x4 steady = (speed <= size) & (speed < splat(Walls::inf)) & bits<i32x4>(splat(margin > 0 ? 0u : ~0u));
  step = bits<f32x4>(bits<i32x4>(step) & steady);
  speed = bits<f32x4>(bits<i32x4>(speed) & steady);
  f32x4 aside = splat(margin > 0 ? f32(margin) : slack * widest<D>(speed));
  f32x4 begin = step * splat(from), end = step * splat(until), turn = size + speed + speed;
  f32x4 least = first + min(begin, end) - aside, most = last + max(begin, end) + aside;
  store(out, min(walls.most - turn - max(most - walls.most, none), least));
  store(out + D, max(walls.least + turn + max(walls.least - least, none), most));
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

/// In which numbers two boxes are the same; in all lanes: they are.
template <int D> i32x4 alike(const f32* one, const f32* other) {
  i32x4 same = load<f32x4>(one) == load<f32x4>(other);
  return D == 2 ? same : same & (load<f32x4>(one + 2) == load<f32x4>(other + 2));
}

/// Whether a box is in another.
template <int D> bool inside(const f32* box, const f32* other) { return bitmask(sides_inside<D>(box, other)) == 15; }
