// Worlds that wrap around, with every technique. Coordinates are integers, so that the model can compute exactly which
// boxes meet: those of which one, shifted by some number of worlds, overlaps the other.
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
  // Boxes anywhere, or most of them in a world whose middle is the origin.
  for (auto [count, worlds] : {std::pair{0, 4}, {1, 4}, {2, 4}, {7, 4}, {30, 4}, {200, 4}, {7, 1}, {30, 1}, {200, 1}}) {
    testing::Where where(std::to_string(count) + " boxes in " + std::to_string(worlds) + " worlds");
    Boxes<D> boxes{size_t(count)};
    for (i32 k = 0; k < count; k++) {
      for (u32 a = 0; a < D; a++) {
        boxes[k][a] = f64(random.below(u32(worlds * world[a]))) - worlds * world[a] / 2;
        boxes[k][D + a] = boxes[k][a] + random.below(k % 10 ? 6 : 2 * u32(world[a]));
      }
    }
    PairList expected = wrapped_pairs<D>(boxes, world);
    each_technique([&](Technique technique) {
      for (bool doubles : {false, true}) {
        auto instance = open<D>(technique);
        for (u32 a = 0; a < D; a++) instance->options.wrap[a] = world[a];
        replace(instance->space, boxes, doubles);
        check_pairs(instance->space, expected);
      }
    });
  }
}

/// What a query with planes sees of a box and its copies one world away: 0 nothing, 1 a part of one, 2 a whole one.
template <int D> u32 seen(const std::array<f64, 2 * D>& box, const Planes<D>& planes, const std::array<i32, 3>& world) {
  u32 best = 0;
  for (u32 turn = 0, turns = D == 2 ? 9 : 27; turn < turns; turn++) {
    std::array<f64, 2 * D> copy = box;
    for (u32 a = 0, n = turn; a < D; a++, n /= 3) {
      f64 size = world[a];
      bool full = box[D + a] - box[a] >= size;
      f64 moved = (f64(n % 3) - 1 - std::floor(box[a] / size)) * size;
      copy[a] = full ? -INFINITY : box[a] + moved;
      copy[D + a] = full ? INFINITY : box[D + a] + moved;
    }
    bool some = true, all = true;
    for (u32 p = 0; p < planes.count; p++) {
      f64 foremost = planes.offset[p], hindmost = planes.offset[p];
      for (u32 a = 0; a < D; a++) {
        f64 normal = planes.normal[p][a];
        if (normal != 0) foremost += normal * copy[normal > 0 ? D + a : a];
        if (normal != 0) hindmost += normal * copy[normal > 0 ? a : D + a];
      }
      some &= foremost >= 0;
      all &= hindmost >= 0;
    }
    best = larger(best, some ? all ? 2u : 1u : 0u);
  }
  return best;
}

template <int D> void check_views() {
  Random random(32);
  const std::array<i32, 3> world{40, 25, 33};
  for (u32 count : {1, 7, 30, 200, 900}) {
    testing::Where where(std::to_string(count) + " boxes");
    Boxes<D> boxes(count);
    for (u32 k = 0; k < count; k++) {
      for (u32 a = 0; a < D; a++) {
        boxes[k][a] = f64(random.below(4 * u32(world[a]))) - 2 * world[a];
        boxes[k][D + a] = boxes[k][a] + random.below(k % 10 ? 6 : 2 * u32(world[a]));
      }
    }
    for (bool doubles : {false, true}) {
      auto instance = open<D>(Technique::brute_force);
      Space<D>& space = instance->space;
      auto& questions = space.questions;
      for (u32 a = 0; a < D; a++) instance->options.wrap[a] = world[a];
      replace(space, boxes, doubles);
      CHECK(space.update() == -1);
      for (u32 asked = 0; asked < 40; asked++) {
        questions.asked.mask = questions.asked.ignored = ~0u;
        questions.planes.count = random.below(5);
        for (u32 p = 0; p < questions.planes.count; p++) {
          for (f64& normal : questions.planes.normal[p]) normal = f64(random.below(5)) - 2;
          questions.planes.offset[p] = f64(random.below(120)) - 40;
        }
        std::vector<u32> found(count, 0);
        u32 from = 0, part;
        do {
          part = questions.ask_planes(from, 64);
          for (u32 k = 0; k < part; k++) {
            u32 id = questions.answers[k] & ~PlaneQuery<D>::inside;
            CHECK(found[id] == 0);
            found[id] = questions.answers[k] & PlaneQuery<D>::inside ? 2 : 1;
          }
        } while (part == 64);
        for (u32 id = 0; id < count; id++) CHECK(found[id] == seen<D>(boxes[id], questions.planes, world));
      }
    }
  }
}

template <int D> void list_wrap_tests() {
  testing::list({{"spaces find the pairs of a world that wraps around", D, check_wrapped<D>},
                 {"planes see boxes of a world that wraps around once", D, check_views<D>}});
}
