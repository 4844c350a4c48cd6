// Boxes that are hard to search.
#pragma once
#include <vector>

#include "random.hpp"

/// Small and large boxes, which get denser along each axis; some are half outside the world.
template <int D> std::vector<f32> crowd(Random& random, u32 count, bool in_a_row, f64 huge) {
  std::vector<f32> boxes(count * 2 * D + 4);
  for (u32 k = 0; k < count; k++) {
    bool is_huge = random.fraction() < huge;
    for (u32 a = 0; a < D; a++) {
      f64 at = random.fraction();
      boxes[k * 2 * D + a] = in_a_row && a > 0 ? 0 : f32(440 * (1 - at * at) - 20);
      boxes[k * 2 * D + D + a] = boxes[k * 2 * D + a] + f32((is_huge ? 390 : 3) * random.fraction());
    }
    if (is_huge && random.fraction() < 0.1) boxes[k * 2 * D] = -__builtin_inff();
  }
  return boxes;
}
