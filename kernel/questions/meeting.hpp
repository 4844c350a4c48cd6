// When a moving box hits a box at rest, and on which side: the rule of rays and sweeps.
// Idea: along each axis the moving box is before the other, past it, or over it. A hit needs a path that leads into a
// face, so that the two overlap from then on. A path along a face or away from it is no hit. Over it on all axes is
// inside. A ray is a moving box of zero size. A box of zero size along an axis also hits the edges there: otherwise it
// would slip between two boxes that touch. Rounding: a caller that stops at a hit computes its corners again, and may
// end up inside by a rounding error. So overlaps up to `touch` of the coordinates count as touching, and times are
// chosen so that no rounding leads deeper. A corner never ends beyond the face, and if the roundings on the way may
// exceed `touch` at its end, the time is earlier by as much. These roundings come from adding a size to a corner, which
// float32 numbers have not undergone.
#pragma once
#include "base/rounding.hpp"

struct Meeting {
  f64 time;  // as a share of the path
  i32 side;  // axis + 1 of the face, negative if its normal is; 0: inside
  bool corner;  // more than one face is met at that time
};

namespace detail {

inline constexpr f64 touch = 0x1p-48;  // relative to the coordinates: the overlap that still counts as touching
inline constexpr f64 roundings = 0x1p-51;  // relative to the numbers involved: bounds the sum of rounding errors

inline f64 size_of(f64 x) { return __builtin_isinf(x) ? 0 : __builtin_fabs(x); }
inline bool is_single(f64 x) { return f64(f32(x)) == x; }

/// Along one axis: the share of the path after which a box that starts at lo … hi touches a face.
inline f64 time_to(f64 lo, f64 hi, f64 face, f64 along, bool stops) {
  bool forth = along > 0;
  f64 near = forth ? hi : lo, speed = __builtin_fabs(along);
  f64 gap = larger(0.0, forth ? face - hi : lo - face);
  if (!stops || gap == __builtin_inf()) return gap / speed;
  if (lo < hi && !(is_single(lo) && is_single(hi) && is_single(face))) {
    f64 error = roundings * gap + roundings * size_of(lo) + roundings * size_of(hi) + roundings * size_of(face);
    f64 other = forth ? face - (hi - lo) : face + (hi - lo);
    if (error > touch * larger(size_of(face), size_of(other))) gap = larger(0.0, gap - error);
  }
  f64 time = gap / speed;
  while (time > 0 && time < __builtin_inf() && (forth ? near + along * time > face : near + along * time < face)) {
    time = bits<f64>(bits<u64>(time) - 1);
  }
  return time;
}

}  // namespace detail

/// Whether a box that moves by `along` meets another, and how. `stops`: the caller stops the box at that time; else it
/// is the double nearest to the true time.
template <int D> bool meets(const f64* lo, const f64* hi, const f64* along, const f64* box, bool stops, Meeting& met) {
  using namespace detail;
  bool edge = false;
  f64 leave[D];
  met = {0, 0, false};
  for (int a = 0; a < D; a++) {
    f64 from = box[a], to = box[D + a];
    f64 slack = smaller(touch * larger(size_of(lo[a]), size_of(hi[a])), (hi[a] - lo[a]) / 4);
    bool before = hi[a] < from || (hi[a] <= from + slack && !__builtin_isinf(hi[a]));
    bool past = lo[a] > to || (lo[a] >= to - slack && !__builtin_isinf(lo[a]));
    leave[a] = __builtin_inf();
    if (along[a] == 0) {
      if (!before && !past) continue;
      if (lo[a] < hi[a] || hi[a] < from || lo[a] > to) return false;
      edge = true;
      continue;
    }
    bool forth = along[a] > 0;
    if (forth ? past : before) return false;
    f64 last = (forth ? to - lo[a] : from - hi[a]) / along[a];
    if (last == last) leave[a] = last;  // NaN, when both sides are the same infinity: never left
    if (!before && !past) continue;
    f64 time = time_to(lo[a], hi[a], forth ? from : to, along[a], stops);
    if (met.side == 0 || time > met.time) met = {time, forth ? -(a + 1) : a + 1, false};
    else if (time == met.time) met.corner = true;
  }
  if (met.side == 0) return !edge;
  if (!(met.time < __builtin_inf())) return false;
  for (int a = 0; a < D; a++) {
    if (a + 1 == (met.side < 0 ? -met.side : met.side)) continue;
    if (lo[a] < hi[a] ? leave[a] <= met.time : leave[a] < met.time) return false;
  }
  return true;
}
