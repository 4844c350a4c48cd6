// A sample of the pairs, which tells how many of them a new list would settle.
// Boxes at rest are often denser than others, as in a heap, or in a pool of bullets that wait at one place. The share of
// boxes that rest then says little about the share of pairs that do.
// Cost: two or three cache misses per sampled pair.
#pragma once
#include "coherence/origins.hpp"
#include "pairs/pairs.hpp"

class PairSample {
  static constexpr u32 most = 64;  // pairs

  Buffer<u64> pairs_;
  u32 count_ = 0;

 public:
  SMALL void take(const Pairs& from) {
    u64 step = from.count / most + 1;
    pairs_.reserve(most);
    count_ = 0;
    for (u64 k = 0; k < from.count; k += step) pairs_[count_++] = from.list[k];
  }

  /// The share of the pairs of which neither box has moved.
  template <int D> SMALL f64 resting(const Scene<D>& scene, const Origins<D>& origins) const {
    u32 found = 0;
    for (u32 k = 0; k < count_; k++) {
      u32 a = u32(pairs_[k]), b = u32(pairs_[k] >> 32);
      if (larger(a, b) >= smaller(scene.count, origins.count())) continue;
      found += origins.has_rested(scene, a) && origins.has_rested(scene, b);
    }
    return f64(found) / larger(1u, count_);
  }

  SMALL void release() { pairs_.release(); }
};
