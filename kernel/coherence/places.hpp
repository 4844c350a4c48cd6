// Late boxes: their new regions, in grids that are searched when another box is late, and their bases.
// Idea: grids whose cells double in width from one to the next. A region is stored once, in the finest grid in which it
// spans no more than two cells along each axis, in the cell of its lower corner. So a search begins one cell before its
// range. The boxes of a cell form a chain.
// Cost: 10 to 20 ns to insert or remove a box; in a search 1 ns for each cell, 2 for each region nearby. 8 bytes per box,
// 3 for cells, and the base of each late box.
// From: F. Schornbaum, "Hierarchical Hash Grids for Coarse Collision Detection", 2009.
#pragma once
#include "base/box_tests.hpp"
#include "boxes/cell_map.hpp"
#include "boxes/scene_sample.hpp"

template <int D> class Places {
  static constexpr u32 boxes_a_cell = 2, most_grids = 13, width = 2 * D, padding = 4;

  struct Range {
    u32x4 low, high;  // cells along the axes; 0 in the other lanes
  };
  struct Grid {
    Axes axes;
    u32 side, first;  // number of cells along each axis; its first cell
    bool used;
  };

  struct Spot {
    u32 grid, cell;
  };

  Grid grids_[most_grids] = {};
  u32 grid_count_ = 0;
  Buffer<u32> heads_;  // per cell: 1 + the first slot of its chain; 0: the chain is empty
  Buffer<u32> next_;  // per slot: 1 + the next slot of its chain; 0: it is the last
  Buffer<u32> base_of_;  // per slot: the number of its base
  Buffer<f32> bases_;  // the first touches nothing
  u32 base_count_ = 0;  // 0: there is no room for late boxes

 public:
  /// Forgets all late boxes.
  void forget() { base_count_ = 0; }
  bool has_room() const { return base_count_ > 0; }

  /// Makes room for late boxes among so many. `low` and `high` bound the lower corners of most regions.
  SMALL void clear(u32 boxes, const f64* low, const f64* high) {
    u32 cells = divide(low, high, boxes);
    __builtin_memset(heads_.reserve(cells), 0, cells * sizeof(u32));
    make_room(boxes, 0);
    for (u32 k = 0; k < width; k++) bases_.reserve(width + padding)[k] = __builtin_nanf("");
    base_count_ = 1;
  }
  void make_room(u64 slots, u64 had) {
    next_.grow(slots, had);
    base_of_.grow(slots, had);
  }

  /// The base of a late box.
  const f32* base(u32 slot) const { return bases_.data() + u64(base_of_[slot]) * width; }
  /// Retains a region as the base of a late box.
  void keep_base(const f32* region, u32 slot) {
    u64 place = u64(base_count_) * width;
    bases_.grow(place + width + padding, place);
    __builtin_memcpy(bases_.data() + place, region, width * sizeof(f32));
    base_of_[slot] = base_count_++;
  }
  /// Makes the base of a late box touch nothing.
  void forget_base(u32 slot) { base_of_[slot] = 0; }

  /// Adds a box that is not in the grids, with this region.
  void put(const f32* region, u32 slot) {
    Spot spot = spot_of(region);
    grids_[spot.grid].used = true;
    next_[slot] = heads_[spot.cell];
    heads_[spot.cell] = slot + 1;
  }

  /// Removes a box, which has this region.
  void remove(const f32* region, u32 slot) {
    u32* link = &heads_[spot_of(region).cell];
    while (*link != slot + 1) link = &next_[*link - 1];
    *link = next_[slot];
  }

  /// Writes the slots of the boxes in the grids whose regions touch this one; returns how many. `regions`: by slot; `met`
  /// counts the ones tested.
  NOINLINE u32 near(const f32* region, const f32* regions, u32* out, u64& met) const {
    u32 found = 0;
    for (u32 g = 0; g < grid_count_; g++) {
      const Grid& grid = grids_[g];
      if (!grid.used) continue;
      Range range = range_of(grid, region);
      range.low -= bits<u32x4>(range.low > u32x4{}) & splat(1u);
      u32x4 at = {};
      auto row = [&] {
        at[D - 1] = range.low[D - 1];
        u32 cell = cell_of(grid, at), end = cell + range.high[D - 1] - range.low[D - 1] + 1;
        for (; cell < end; cell++) {
          for (u32 k = heads_[cell]; k > 0; k = next_[k - 1]) {
            out[found] = k - 1;
            found += boxes_touch<D>(region, regions + u64(k - 1) * width);
            met++;
          }
        }
      };
      for (at[0] = range.low[0]; at[0] <= range.high[0]; at[0]++) {
        if constexpr (D == 2) row();
        else
          for (at[1] = range.low[1]; at[1] <= range.high[1]; at[1]++) row();
      }
    }
    return found;
  }

  SMALL void release() {
    heads_.release();
    next_.release();
    base_of_.release();
    bases_.release();
    forget();
  }

 private:
  /// Makes empty grids for this many boxes; returns how many cells they have.
  SMALL u32 divide(const f64* low, const f64* high, u32 boxes) {
    f64 cells = f64(boxes) / boxes_a_cell;
    u32 side = u32(larger(1.0, D == 2 ? __builtin_sqrt(cells) : cube_root(cells))), all = 0;
    for (grid_count_ = 0; side > 0; side /= 2) {
      Axis along[4];
      for (int a = 0; a < 4; a++) along[a] = Axis::make(low[a % D], high[a % D], side);
      grids_[grid_count_++] = {Axes(along[0], along[1], along[2], along[3]), side, all, false};
      all += D == 2 ? side * side : side * side * side;
    }
    return all;
  }

  /// The grid and the cell in which a region is stored.
  NOINLINE Spot spot_of(const f32* region) const {
    for (u32 g = 0;; g++) {
      Range range = range_of(grids_[g], region);
      if (any(bits<i32x4>((range.high - range.low) > splat(1u)))) continue;  // the last grid has one cell
      return {g, cell_of(grids_[g], range.low)};
    }
  }

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
