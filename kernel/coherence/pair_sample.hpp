// A sample of the pairs, which tells how many of them a new list would settle, and how many it would test.
// Boxes at rest are often where the density is another than elsewhere, such as in a heap, or in a pool of bullets that
// wait at one place. So the share of pairs of two boxes at rest cannot be told from the share of boxes that rest.
// Cost: a cache miss per sampled pair.
#pragma once
#include "boxes/box.hpp"
#include "pairs/pairs.hpp"

class PairSample {
  static constexpr u32 most = 64;  // pairs

  Buffer<u64> pairs_;
  u32 count_ = 0;

 public:
  struct Shares {
    f64 resting = 0;  // of two boxes at rest
    f64 open = 0;  // of the others, unless rules or groups forbid them
  };

  SMALL void take(const Pairs& from) {
    u64 step = from.count / most + 1;
    pairs_.reserve(most);
    count_ = 0;
    for (u64 k = 0; k < from.count; k += step) pairs_[count_++] = from.list[k];
  }

  /// `rests`: whether the box of a slot is at rest.
  template <int D, class Rests> SMALL Shares shares(const Scene<D>& scene, Rests rests) const {
    u32 resting = 0, open = 0;
    for (u32 k = 0; k < count_; k++) {
      u32 a = u32(pairs_[k]), b = u32(pairs_[k] >> 32);
      if (larger(a, b) >= scene.count) continue;
      bool rest = rests(a) && rests(b);
      resting += rest;
      open += !rest && !scene.are_apart(a, b);
    }
    f64 all = larger(1u, count_);
    return {resting / all, open / all};
  }

  SMALL void release() { pairs_.release(); }
};
