// The numbers that decide when retaining pairs pays. `npm run bench -- --motions --set tune --count 10000 --dimensions
// 2 --by boxes` measures them; docs/decisions/0007-coherence.md shows the effect of halving and doubling most.
#pragma once
#include "base/simd.hpp"

/// Work is counted in tests of strip sweep: one box against another in its inner loop. Checking whether a box is in its
/// region counts as one too.
template <int D> struct Tuning {
  f64 candidate = 2;  // tests: to test a candidate
  f64 planning = 3000;  // tests: to choose a margin
  f64 late = D == 2 ? 200 : 270;  // tests: to give a box that has left its region a new one
  f64 far = 5e4;  // boxes: among this many, that takes twice as long, since caches do not hold them all
  f64 late_margin = 0.5;  // of a box's size: the margin of that new region, or the list's if larger
  f64 burst = 0.5;  // of a rebuild: the most work for late boxes that a plan may expect in one update
  f64 spike = 2;  // of an update's mean work, making the list included: if late boxes take more in one, the list ends
  f64 ahead = 0.85;  // of a rebuild, or of a plan that is safer: what a plan may cost at most
  f64 build = 2;  // of a rebuild: a list that would cost more is not made
  // In updates: after this many it is known whether a list pays, and the next one is made in two; the first pause; and
  // the time over which late work is averaged.
  u32 watched = 8;
  f64 apart = 8;  // boxes count as no smaller than their spacing divided by this

  /// The work for a late box among n: at most three times `late`.
  constexpr f64 late_among(f64 n) const { return late * (1 + 2 * n / (n + far)); }
};
