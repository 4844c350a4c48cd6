// The constructor's options for the techniques.
#pragma once
#include "base/simd.hpp"

struct Options {
  f64 cell_size[3] = {};  // per axis; 0: chosen from the boxes
  f64 margin = 0;         // by which fat boxes are enlarged; 0: chosen from the motion observed
  f64 wrap[3] = {};       // the size of a world that wraps around; all 0: it does not
  bool touching = true;   // whether boxes that only touch are pairs
  f64 bounds[6] = {};     // minima, then maxima, of the grid's world; all 0: chosen from the boxes
};
