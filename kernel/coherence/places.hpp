// Where regions stand, to be searched when boxes leave theirs.
// Idea: grids whose cells are twice as wide from one to the next. A region stands once, in the finest grid in which it
// spans no more than two cells along each axis, in the cell of its lower corner. So a search looks one cell back.
// Cost: about 3 ns to put one in, and in a search 2 ns for each region that stands near; 8 bytes a region, 3 for cells.
// From: F. Schornbaum, "Hierarchical Hash Grids for Coarse Collision Detection", 2009.
#pragma once
#include "boxes/cell_map.hpp"
#include "boxes/scene_sample.hpp"

template <int D> class Places {
  static constexpr u32 boxes_a_cell = 2, most_grids = 13;

  struct Range {
    u32x4 low, high;  // cells along the axes, and in the other lanes 0
  };
  struct Grid {
    Axes axes;
    u32 side, first;  // cells along an axis; its first one
    bool used;
  };

  Grid grids_[most_grids] = {};
  u32 grid_count_ = 0;
  Buffer<u32> heads_;  // per cell: the slot that stands at the head of its chain, counted from 1
  Buffer<u32> next_;  // per slot: the one behind it
  Buffer<u32> cells_;  // per slot

 public:
  /// Empty grids for so many boxes, whose lower corners have these bounds.
  SMALL void divide(const f64* low, const f64* high, u32 boxes) {
    f64 cells = f64(boxes) / boxes_a_cell;
    u32 side = u32(larger(1.0, D == 2 ? __builtin_sqrt(cells) : cube_root(cells))), all = 0;
    for (grid_count_ = 0; side > 0; side /= 2) {
      Axis along[4];
      for (int a = 0; a < 4; a++) along[a] = Axis::make(low[a % D], high[a % D], side);
      grids_[grid_count_++] = {Axes(along[0], along[1], along[2], along[3]), side, all, false};
      all += D == 2 ? side * side : side * side * side;
    }
    __builtin_memset(heads_.reserve(all), 0, all * sizeof(u32));
  }

  void make_room(u64 slots, u64 had) {
    next_.grow(slots, had);
    cells_.grow(slots, had);
  }

  void put(const f32* region, u32 slot) {
    for (u32 g = 0;; g++) {
      Grid& grid = grids_[g];
      Range range = range_of(grid, region);
      u32x4 apart = range.high - range.low;
      if (any(bits<i32x4>(apart > splat(1u)))) continue;  // the last grid has one cell
      grid.used = true;
      u32 cell = cell_of(grid, range.low);
      cells_[slot] = cell;
      next_[slot] = heads_[cell];
      heads_[cell] = slot + 1;
      return;
    }
  }

  void remove(u32 slot) {
    u32* link = &heads_[cells_[slot]];
    while (*link != slot + 1) link = &next_[*link - 1];
    *link = next_[slot];
  }

  /// Calls `what` with each slot whose region may touch this one.
  template <class What> void each_near(const f32* region, What what) const {
    for (u32 g = 0; g < grid_count_; g++) {
      const Grid& grid = grids_[g];
      if (!grid.used) continue;
      Range range = range_of(grid, region);
      range.low -= bits<u32x4>(range.low > u32x4{}) & splat(1u);
      u32x4 at = {};
      auto row = [&] {
        at[D - 1] = range.low[D - 1];
        u32 cell = cell_of(grid, at), last = cell + range.high[D - 1] - range.low[D - 1];
        for (; cell <= last; cell++) {
          for (u32 k = heads_[cell]; k > 0; k = next_[k - 1]) what(k - 1);
        }
      };
      for (at[0] = range.low[0]; at[0] <= range.high[0]; at[0]++) {
        if constexpr (D == 2) row();
        else
          for (at[1] = range.low[1]; at[1] <= range.high[1]; at[1]++) row();
      }
    }
  }

  SMALL void release() {
    heads_.release();
    next_.release();
    cells_.release();
  }

 private:
  static u32 cell_of(const Grid& grid, u32x4 at) {
    u32 cell = at[0];
    for (int a = 1; a < D; a++) cell = cell * grid.side + at[a];
    return grid.first + cell;
  }

  static Range range_of(const Grid& grid, const f32* region) {
    u32x4 low = grid.axes(load<f32x4>(region));
    constexpr u32 all = ~0u;
    if constexpr (D == 2) return {low & u32x4{all, all, 0, 0}, __builtin_shufflevector(low, u32x4{}, 2, 3, 4, 4)};
    u32x4 along = {all, all, all, 0};
    return {low & along, grid.axes(load<f32x4>(region + D)) & along};
  }
};
