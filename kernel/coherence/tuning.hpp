// The numbers that say when it pays to keep pairs.
#pragma once
#include "../simd.hpp"

/// Work is counted in tests of strip sweep: one box against another in its inner loop.
template <int D> struct Tuning {
  f64 entry = D == 2 ? 16 : 20;  // to put a box into a strip and order it there
  f64 look = 1;                  // to see whether a box is in its region
  f64 candidate = D == 2 ? 2 : 3;
  f64 late = 700;                // to give a box that has left its region a new one
  f64 far = 400'000;             // so many boxes make the last two twice as much, since caches do not hold them
  f64 build = 1.45, widen = 0.15; // of a rebuild: to make a list; and more where its candidates are twice the pairs
  f64 worth = 0.9, proven = 0.95; // of a rebuild: a list must promise to cost less; and have cost less, to go on
  u32 few = 32;                  // fewer boxes are not worth keeping anything
  u32 first_pause = 8, longest_pause = 512;  // updates
  u32 watched = 8;               // updates after which it is known whether anything is worth keeping, and who rests
  u32 again = 2, wild = 3;       // a box that is late so many times, each within so many updates, is wild
};
