// Boxes that have left the region they had when the list was made, to be searched, in a grid of chains.
// Idea: a stray stands in each cell that its region touches, and is found in the first that a search and it share.
// One that gets a new region is put in once more; where it stood before is known by an old stamp, and passed over.
// Cost: about 10 ns to put one in and a search a few; 12 bytes for each cell it stands in, 4 for each cell.
#pragma once
#include "../box_tests.hpp"
#include "../statistics.hpp"

template <int D> class Strays {
  static constexpr u32 boxes_a_cell = 8;

  struct Node {
    u32 slot, stamp, next;
  };
  struct Range {
    u32 low[D], high[D];
  };

  Buffer<u32> first_;  // per cell, counted from 1
  Buffer<Node> nodes_;
  u32 count_ = 0, side_ = 1;
  Axes axes_ = {};

 public:
  /// An empty grid for so many boxes in a world of these bounds.
  COLD void divide(const f64* low, const f64* high, u32 boxes) {
    f64 cells = f64(boxes) / boxes_a_cell;
    side_ = u32(larger(1.0, D == 2 ? __builtin_sqrt(cells) : cube_root(cells)));
    Axis along[4];
    for (int a = 0; a < 4; a++) along[a] = Axis::make(low[a % D], high[a % D], side_);
    axes_ = Axes(along[0], along[1], along[2], along[3]);
    u32 all = D == 2 ? side_ * side_ : side_ * side_ * side_;
    __builtin_memset(first_.reserve(all), 0, all * sizeof(u32));
    count_ = 0;
  }

  /// How many cells a region touches.
  u64 cells(const f32* region) const {
    Range range = range_of(region);
    u64 all = 1;
    for (int a = 0; a < D; a++) all *= range.high[a] - range.low[a] + 1;
    return all;
  }

  COLD void put(const f32* region, u32 slot, u32 stamp) {
    each_cell(range_of(region), [&](u32 cell, const u32*) {
      nodes_.grow(u64(count_) + 1, count_);
      nodes_[count_] = {slot, stamp, first_[cell]};
      first_[cell] = ++count_;
    });
  }

  /// Calls `what` with each slot whose region may touch this one, once. `region_of(slot, stamp)` gives the region, or null
  /// where the stamp is old.
  template <class RegionOf, class What> void each_near(const f32* region, RegionOf region_of, What what) const {
    if (count_ == 0) return;
    Range mine = range_of(region);
    each_cell(mine, [&](u32 cell, const u32* at) {
      for (u32 k = first_[cell]; k > 0; k = nodes_[k - 1].next) {
        const f32* its = region_of(nodes_[k - 1].slot, nodes_[k - 1].stamp);
        if (!its || !boxes_touch<D>(its, region)) continue;
        Range other = range_of(its);
        bool shared_first = true;
        for (int a = 0; a < D; a++) shared_first &= at[a] == larger(mine.low[a], other.low[a]);
        if (shared_first) what(nodes_[k - 1].slot);
      }
    });
  }

  COLD void release() {
    first_.release();
    nodes_.release();
    count_ = 0;
  }

 private:
  Range range_of(const f32* region) const {
    u32x4 low = axes_(load<f32x4>(region)), high = low;
    if constexpr (D == 3) high = axes_(load<f32x4>(region + D));
    Range range;
    for (int a = 0; a < D; a++) {
      range.low[a] = low[a];
      range.high[a] = D == 2 ? low[D + a] : high[a];
    }
    return range;
  }

  template <class What> void each_cell(const Range& range, What what) const {
    u32 at[D];
    for (at[0] = range.low[0]; at[0] <= range.high[0]; at[0]++) {
      for (at[1] = range.low[1]; at[1] <= range.high[1]; at[1]++) {
        if constexpr (D == 2) {
          what(at[0] * side_ + at[1], at);
        } else {
          for (at[2] = range.low[2]; at[2] <= range.high[2]; at[2]++) what((at[0] * side_ + at[1]) * side_ + at[2], at);
        }
      }
    }
  }
};
