// When boxes that move are sorted again for the index, which is otherwise rebuilt in its previous order.
// Idea: in an order that is out of date, queries visit more blocks than they did right after boxes were sorted. Sorting
// pays once those visits have taken as long. If that is so after a single update, as where boxes keep crossing the
// border of a world that wraps around, it will be so again: for a while, all visits count.
// Cost: two additions for each call.
#pragma once
#include "base/simd.hpp"

class Wear {
  static constexpr f64 boxes_per_look = 2;  // that are sorted in the time that a query visits a block
  static constexpr u32 wary_sorts = 32;

  u64 looks_ = 0, queries_ = 0;  // blocks visited since the index was built, and by how many queries
  u64 all_looks_ = 0;  // before that, since boxes were sorted
  f64 usual_ = 0;  // blocks per query right after boxes were sorted; 0: not known yet
  f64 wasted_ = 0;  // blocks visited since then beyond those
  u32 kept_ = 0;  // builds since boxes were sorted
  u32 wary_ = 0;  // sorts left for which all visits count

 public:
  /// Records that queries have visited this many blocks.
  void looked_at(u64 blocks, u32 queries) {
    looks_ += blocks;
    queries_ += queries;
  }

  /// Before the index of `boxes` boxes is built again: whether to sort them.
  SMALL bool is_worn(u32 boxes) {
    if (queries_ > 0 && usual_ == 0) usual_ = f64(looks_) / f64(queries_);
    wasted_ += larger(0.0, f64(looks_) - usual_ * f64(queries_));
    all_looks_ += looks_;
    looks_ = queries_ = 0;
    kept_++;
    if ((wary_ ? f64(all_looks_) : wasted_ * boxes_per_look) < boxes) return false;
    if (wary_) wary_--;
    else if (kept_ == 2) wary_ = wary_sorts;
    return true;
  }

  /// Boxes have been sorted.
  void restart() {
    looks_ = queries_ = all_looks_ = kept_ = 0;
    usual_ = wasted_ = 0;
  }
};
