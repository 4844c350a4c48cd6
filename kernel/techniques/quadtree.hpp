// Quadtree, in 3D an octree: loose, rebuilt each update over the extent of the boxes.
//
// Idea: a box is in the cell that contains its centre, on the finest level whose cells are no smaller than it, and may
// extend beyond it by half a cell; a cell with few boxes is not divided. A node stores not its cell but the bounds of
// its boxes. Nodes are in one flat array, each before its descendants, with the index after the last of them: from each
// node all later ones are visited in order, and a subtree that does not overlap it is skipped.
// Cost: build O(n), one radix sort; pairs O(nodes log nodes + candidates); about 80 (2D) or 110 (3D) bytes a box.
// Nothing is updated.
// Wins nowhere by much; steady on all sizes, since large boxes stay near the root. Loses when there are many of these:
// each is tested against everything below it.
// From: R. Finkel and J. L. Bentley, "Quad Trees", 1974; loose cells from T. Ulrich, "Loose Octrees", Game
// Programming Gems, 2000.
#pragma once
#include "search/hilbert.hpp"
#include "search/options.hpp"
#include "search/stats.hpp"
#include "search/sweep.hpp"

template <int D> class Quadtree {
  using Curve = HilbertCurve<D>;
  static constexpr u32 few = 24;  // a cell with at most this many boxes is not divided

  /// In the first D lanes.
  struct Bounds {
    f32x4 low, high;

    void add(const Bounds& other) {
      low = min(low, other.low);
      high = max(high, other.high);
    }
    bool meets(const Bounds& other) const {
      return !(bitmask((other.low > high) | (low > other.high)) & ((1 << D) - 1));
    }
  };

  struct Node {
    Bounds all;  // bounds of the boxes from here to `behind`
    Bounds own;
    u32 first, last;  // its own boxes
    u32 behind;  // the node after all its descendants
  };

  HilbertOrder<D> order_;
  Lanes<D> lanes_;
  Buffer<Node> nodes_;
  u32 count_ = 0;  // nodes

 public:
  void update(const Scene<D>& scene, const Options&, Pairs& pairs, Stats& stats) {
    u32 n = scene.count;
    count_ = 0;
    if (n == 0) return;
    lanes_.reserve(n);
    order_.make(scene, true, lanes_);
    divide(0, n, 0);
    for (u32 a = 0; a < count_; a++) walk(a, pairs, stats);
    stats.cells = count_;
    stats.entries = n;
  }

  SMALL void structure(Buffer<f32>& boxes, u32& count, const Stats&) const {
    count = count_;
    boxes.reserve(u64(count) * 2 * D);
    for (u32 k = 0; k < count; k++) {
      __builtin_memcpy(boxes.data() + k * 2 * D, &nodes_[k].all.low, D * sizeof(f32));
      __builtin_memcpy(boxes.data() + k * 2 * D + D, &nodes_[k].all.high, D * sizeof(f32));
    }
  }

  SMALL void release() {
    order_.release();
    lanes_.release();
    nodes_.release();
    count_ = 0;
  }

 private:
  u32 level(u32 k) const { return order_.key(k) & ((1u << Curve::level_bits) - 1); }
  u32 cell(u32 k, u32 level) const { return order_.key(k) >> (Curve::level_bits + D * (Curve::levels - level)); }

  /// Builds the node of the boxes from `first` to `end`, which are all those of one cell, and the nodes below it.
  void divide(u32 first, u32 end, u32 at) {
    // A cell that has no boxes of its own, and all others in one quarter, gets no node.
    while (end - first > few && at < Curve::levels && level(first) > at &&
           cell(first, at + 1) == cell(end - 1, at + 1)) {
      at++;
    }
    u32 last = end;
    if (end - first > few && at < Curve::levels) {
      for (last = first; last < end && level(last) <= at; last++) {
      }
    }
    u32 me = count_++;
    nodes_.grow(count_, me);
    Node node;
    node.own = bounds(first, last);
    node.all = node.own;
    for (u32 k = last; k < end;) {
      u32 begin = k, below = count_;
      k = end_of(cell(k, at + 1), k, end, at + 1);
      divide(begin, k, at + 1);
      node.all.add(nodes_[below].all);
    }
    node.first = first;
    node.last = last;
    node.behind = count_;
    nodes_[me] = node;
  }

  /// The end of a cell's boxes, among those from k to `end`, which are sorted.
  u32 end_of(u32 wanted, u32 k, u32 end, u32 level) const {
    while (k < end) {
      u32 middle = (k + end) / 2;
      if (cell(middle, level) == wanted) k = middle + 1;
      else end = middle;
    }
    return k;
  }

  Bounds bounds(u32 first, u32 last) const {
    ItemsAt<D> items = order_.items();
    f32x4 low = splat(__builtin_inff()), high = -low;
    for (u32 k = first; k < last; k++) {
      Item<D> item = items[k];
      if constexpr (D == 2) {
        low = min(low, item.box);
        high = max(high, item.box);
      } else {
        low = min(low, item.low);
        high = max(high, item.high);
      }
    }
    if constexpr (D == 2) high = __builtin_shufflevector(high, high, 2, 3, 2, 3);
    return {low, high};
  }

  /// Finds the pairs of a node's own boxes with each other and with those of all later nodes.
  void walk(u32 at, Pairs& pairs, Stats& stats) {
    const Node own = nodes_[at];
    if (own.first == own.last) return;
    f64 tests = 0;
    for (u32 b = at; b < count_;) {
      const Node& other = nodes_[b];
      if (!own.own.meets(other.all)) {
        b = other.behind;
        continue;
      }
      b++;
      if (own.own.meets(other.own)) tests += f64(test(own, other, pairs));
    }
    stats.tests += tests;
  }

  /// Tests the boxes of one node against those of another, or of the same, that come after them.
  NOINLINE u32 test(const Node& one, const Node& other, Pairs& pairs) const {
    const LaneView<D> lanes = lanes_.view();
    u64* out = pairs.list.data() + pairs.count;
    u32 tests = 0, until = other.last;
    for (u32 i = one.first; i < one.last; i++) {
      if (!bounds(i, i + 1).meets(other.own)) continue;
      u32 from = larger(other.first, i + 1);
      tests += until - from;
      out = sweep_run(lanes, {i, from, until}, pairs.room(out, until - from));
    }
    pairs.end_at(out);
    return tests;
  }
};
