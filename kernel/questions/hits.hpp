// The answers of a query that ranks boxes: first hits of moving boxes, or nearest neighbours.
#pragma once
#include "base/heap.hpp"

struct Hit {
  f64 rank;  // how far the box has moved, or the distance
  u32 id;  // may have the flag `corner`
  i32 side;  // for moving boxes: axis + 1 of the face that is hit, negative if its normal is; 0: none

  /// A flag on the ids of boxes that are met only at a corner, so that faces met at the same time come first: a box
  /// sliding over a floor of boxes touches the one below and does not stop at the next.
  static constexpr u32 corner = 0x80000000;

  bool operator<(const Hit& other) const { return rank < other.rank || (rank == other.rank && id < other.id); }
};

/// The `most` smallest hits after a given one: few are kept in order, many in a heap with the largest on top. Each level of
/// a heap takes an unpredictable branch, so moving half of a few hundred hits is faster.
class Hits {
  static constexpr u32 most_in_order = 256;

  Buffer<Hit> list_;
  u32 count_ = 0, most_ = 0;
  bool after_ = false;
  Hit last_ = {};

  SMALL void sift_down(u32 at, u32 count, Hit hit) {
    for (u32 child; (child = 2 * at + 1) < count; at = child) {
      if (child + 1 < count && list_[child] < list_[child + 1]) child++;
      if (!(hit < list_[child])) break;
      list_[at] = list_[child];
    }
    list_[at] = hit;
  }

  SMALL void sift_up(u32 at, Hit hit) {
    for (u32 above; at > 0 && list_[above = (at - 1) / 2] < hit; at = above) list_[at] = list_[above];
    list_[at] = hit;
  }

  void insert(u32 at, Hit hit) {
    for (; at > 0 && hit < list_[at - 1]; at--) list_[at] = list_[at - 1];
    list_[at] = hit;
  }

 public:
  f64 limit = 0;  // hits of a larger rank are rejected

  const Hit* data() const { return list_.data(); }

  void begin(u32 most, f64 most_rank, const Hit* after) {
    count_ = 0;
    most_ = most;
    limit = most_rank;
    after_ = after;
    if (after) last_ = *after;
  }

  NOINLINE void offer(Hit hit) {
    if (!(hit.rank <= limit) || (after_ && !(last_ < hit))) return;
    bool ordered = most_ <= most_in_order;
    if (count_ < most_) {
      list_.grow(u64(count_) + 1, count_);
      u32 at = count_++;
      if (ordered) insert(at, hit);
      else sift_up(at, hit);
    } else if (ordered) {
      if (hit < list_[most_ - 1]) insert(most_ - 1, hit);
    } else if (hit < list_[0]) {
      sift_down(0, count_, hit);
    }
    if (count_ == most_) limit = smaller(limit, list_[ordered ? most_ - 1 : 0].rank);
  }

  /// Sorts the hits, smallest first; returns how many.
  SMALL u32 finish() {
    for (u32 n = most_ <= most_in_order ? 0 : count_; n-- > 1;) {
      Hit least = list_[n];
      list_[n] = list_[0];
      sift_down(0, n, least);
    }
    return count_;
  }

  SMALL void release() { list_.release(); }
};
