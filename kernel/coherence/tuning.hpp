// The numbers that decide when retaining pairs pays. `npm run bench -- --motions --set tune --count 10000 --dimensions
// 2 --by boxes` measures them; docs/decisions/0007-coherence.md shows the effect of halving and doubling each.
#pragma once
#include "base/simd.hpp"

/// Work is counted in tests of strip sweep: one box against another in its inner loop.
template <int D> struct Tuning {
  f64 entry = D == 2 ? 16 : 20;      // tests: to put a box into a strip and order it there
  f64 look = 1;                      // tests: to see whether a box is in its region
  f64 candidate = D == 2 ? 2 : 3;    // tests: to test one
  f64 late = 500;                    // tests: to give a box that has left its region a new one
  f64 late_margin = 0.5;             // of a box's size: the margin of that
  f64 burst = 0.5;                   // of a rebuild: in one update boxes may be late for as much
  f64 spike = 2;  // of what being late and making lists costs an update on average: so many late in one end the list
  f64 ahead = 0.85;  // of a list with a margin alone: one that reaches ahead must promise to cost less
  f64 build = 2;  // of a rebuild: a list that would cost more is not made
  f64 worth = 0.9;  // of a rebuild: a list must promise to cost less, and have cost less, to go on
  u32 few = 32;  // boxes: fewer are not worth keeping anything
  u32 watched = 8;  // updates: after which it is known what is worth keeping; the first pause is as long
  u32 longest_pause = 512;  // updates
  f64 smoothing = 0.4;  // of an update's lateness: what counts in the running mean
  f64 least_pairs = 0.02;  // pairs a box: fewer are taken for as many, so that nothing is divided by 0
  f64 apart = 8;  // where sizes are not known: they are what boxes are apart, divided by this
};
