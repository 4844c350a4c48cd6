// Worlds that wrap around, with every technique. Coordinates are whole, so that the model can say with whole numbers
// which boxes meet: those of which one, moved by some number of worlds, overlaps the other.
#pragma once
#include "spaces.hpp"

template <int D> PairList wrapped_pairs(const Boxes<D>& boxes, const std::array<i32, 3>& world) {
  PairList found;
  auto floor = [](i32 a, i32 b) { return a >= 0 || a % b == 0 ? a / b : a / b - 1; };
  for (u32 a = 0; a < boxes.size(); a++) {
    for (u32 b = a + 1; b < boxes.size(); b++) {
      bool meet = true;
      for (u32 k = 0; k < D; k++) {
        i32 most = floor(i32(boxes[b][D + k] - boxes[a][k]), world[k]);
        i32 least = -floor(i32(boxes[a][D + k] - boxes[b][k]), world[k]);
        meet &= least <= most;
      }
      if (meet) found.push_back(u64(a) | u64(b) << 32);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

template <int D> void check_wrapped() {
  Random random(31);
  const std::array<i32, 3> world{40, 25, 33};
  for (u32 count : {0, 1, 2, 7, 30, 200}) {
    testing::Where where(std::to_string(count) + " boxes");
    Boxes<D> boxes(count);
    for (u32 k = 0; k < count; k++) {
      for (u32 a = 0; a < D; a++) {
        boxes[k][a] = f64(random.below(4 * u32(world[a]))) - 2 * world[a];
        boxes[k][D + a] = boxes[k][a] + random.below(k % 10 ? 6 : 2 * u32(world[a]));
      }
    }
    PairList expected = wrapped_pairs<D>(boxes, world);
    each_technique([&](Technique technique) {
      for (bool doubles : {false, true}) {
        auto instance = open<D>(technique);
        for (u32 a = 0; a < D; a++) instance->settings.wrap[a] = world[a];
        replace(instance->space, boxes, doubles);
        check_pairs(instance->space, expected);
      }
    });
  }
}

template <int D> void list_wrap_tests() {
  testing::list({{"spaces find the pairs of a world that wraps around", D, check_wrapped<D>}});
}
