// Brute force: every box against every other, four at a time.
//
// Idea: the article's first approach: the inner loop starts after the outer one's box, so no pair is met twice.
// Cost: n (n - 1) / 2 tests, nothing to build, 20 (2D) or 28 (3D) bytes a box.
// Wins for a handful of boxes. Loses otherwise; it serves as the reference for all other techniques.
// From: A. Petersen, "Broad Phase Collision Detection Using Spatial Partitioning", 2012, approach 1.
#pragma once
#include "search/options.hpp"
#include "search/stats.hpp"
#include "search/sweep.hpp"

template <int D> class BruteForce {
  Items<D> items_;
  Lanes<D> lanes_;
  Buffer<u32> end_;

 public:
  static constexpr bool notes_doubts = true;

  void update(const Scene<D>& scene, const Options&, Pairs& pairs, Stats& stats) {
    u32 n = scene.count;
    if (n < 2) return;
    lanes_.reserve(n);
    items_.grow(n, 0);
    end_.reserve(n + 4);
    SceneItems<D> plain{scene, AxisOrder<D>::make(0)};
    ItemsAt<D> items(items_, 0);
    for (u32 k = 0; k < n; k++) {
      items.put(k, plain[k]);
      end_[k] = n;
    }
    lanes_.fill(items, n);
    sweep<D>(lanes_, end_.data(), n, pairs);
    stats.tests = f64(n) * (n - 1) / 2;
    stats.cells = 1;
    stats.entries = n;
  }

  /// One cell, which is everything.
  SMALL void structure(Buffer<f32>& boxes, u32& count, const Stats& stats) const {
    count = u32(stats.cells);
    boxes.reserve(2 * D);
    for (int k = 0; k < 2 * D; k++) boxes[k] = k < D ? -__builtin_inff() : __builtin_inff();
  }

  SMALL void release() {
    items_.release();
    lanes_.release();
    end_.release();
  }
};
