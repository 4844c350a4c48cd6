// Late boxes: their new regions, in grids that are searched when another box is late, their bases, and marks.
// Idea: grids whose cells double in width from one to the next. A region is stored once, in the finest grid in which it
// spans no more than two cells along each axis, in the cell of its lower corner. So a search begins one cell before its
// range. The boxes of a cell form a chain. Grids repeat themselves, so that boxes may be anywhere, also in clusters far
// from one another; the coarsest has one cell for all.
// Cost: 10 to 20 ns to insert or remove a box; in a search 1 ns for each cell, 2 for each region nearby. 8 bytes per box,
// up to 11 (2D) or 18 (3D) for cells, and the base of each late box.
// From: F. Schornbaum, "Hierarchical Hash Grids for Coarse Collision Detection", 2009.
#pragma once
#include "base/box_tests.hpp"
#include "base/heap.hpp"

template <int D> class Places {
  static constexpr u32 most_grids = 13, width = 2 * D, padding = 4;
  static constexpr u32 finest = D == 2 ? 2 : 4;  // cells per box, at most; with fewer, distant boxes share them
  static constexpr u32 work = 12;  // tests of strip sweep: to test a region, with its share of the cells
  static constexpr f32 whole = 8388608;  // 2^23: added to a number, it leaves the nearest integer in the low bits

  struct Range {
    u32x4 low, high;  // cells along the axes, before the grid repeats itself; 0 in the other lanes
  };
  struct Grid {
    f32 scale;  // cells in a unit of length
    u32 side, first;  // cells along each axis, a power of two, after which the grid repeats itself; its first cell
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
  Buffer<u8> marks_;  // per slot

 public:
  /// Forgets all late boxes.
  void forget() { base_count_ = 0; }
  bool has_room() const { return base_count_ > 0; }

  /// Makes room for late boxes among this many boxes, of this spacing.
  SMALL void clear(u32 boxes, f64 spacing) {
    u32 cells = divide(boxes, f32(larger(1e-30, smaller(1e30, spacing))));
    __builtin_memset(heads_.reserve(cells), 0, cells * sizeof(u32));
    make_room(boxes, 0);
    for (u32 k = 0; k < width; k++) bases_.reserve(width + padding)[k] = __builtin_nanf("");
    base_count_ = 1;
  }
  void make_room(u64 slots, u64 had) {
    next_.grow(slots, had);
    base_of_.grow(slots, had);
  }

  /// Removes the marks of the first slots.
  SMALL void unmark(u32 slots) { __builtin_memset(marks_.reserve(slots), 0, slots); }
  /// Marks a box that is late in this update.
  void mark(u32 slot) { marks_[slot] = 1; }
  u32 is_marked(u32 slot) const { return marks_[slot]; }

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

  /// Writes the slots of the boxes in the grids whose regions touch this one; returns how many. `regions`: by slot; adds
  /// the work to `met`.
  NOINLINE u32 near(const f32* region, const f32* regions, u32* out, u64& met) const {
    const u32* next = next_.data();
    u32 found = 0, tested = 0;
    for (u32 g = 0; g < grid_count_; g++) {
      const Grid& grid = grids_[g];
      if (!grid.used) continue;
      Range range = range_of(grid, region);
      range.low -= bits<u32x4>(range.low > u32x4{}) & splat(1u);
      u32 end[D], mask = grid.side - 1;
      for (int a = 0; a < D; a++) end[a] = smaller(range.high[a] + 1, range.low[a] + grid.side);  // each cell once
      auto row = [&](u32 before) {
        const u32* heads = heads_.data() + grid.first + before * grid.side;
        for (u32 z = range.low[D - 1]; z < end[D - 1]; z++) {
          for (u32 k = heads[z & mask]; k > 0; k = next[k - 1]) {
            out[found] = k - 1;
            found += boxes_touch<D>(region, regions + u64(k - 1) * width);
            tested++;
          }
        }
      };
      for (u32 x = range.low[0]; x < end[0]; x++) {
        if constexpr (D == 2) row(x & mask);
        else
          for (u32 y = range.low[1]; y < end[1]; y++) row((x & mask) * grid.side + (y & mask));
      }
    }
    met += work * tested;
    return found;
  }

  SMALL void release() {
    heads_.release();
    next_.release();
    base_of_.release();
    bases_.release();
    marks_.release();
    forget();
  }

 private:
  /// Makes empty grids for this many boxes, the finest with cells of this width; returns how many cells they have.
  SMALL u32 divide(u32 boxes, f32 cell) {
    u32 side = 1, all = 0;
    while (in_all(2 * side) <= finest * boxes && side < 1u << (most_grids - 1)) side *= 2;
    for (grid_count_ = 0; side > 0; side /= 2, cell *= 2) {
      grids_[grid_count_++] = {1 / cell, side, all, false};
      all += in_all(side);
    }
    return all;
  }
  static u32 in_all(u32 side) { return D == 2 ? side * side : side * side * side; }

  /// The grid and the cell in which a region is stored.
  NOINLINE Spot spot_of(const f32* region) const {
    for (u32 g = 0;; g++) {
      Range range = range_of(grids_[g], region);
      bool spans = any(bits<i32x4>((range.high - range.low) > splat(1u)));
      if (spans && g + 1 < grid_count_) continue;  // the last grid has one cell
      return {g, cell_of(grids_[g], range.low)};
    }
  }

  static u32 cell_of(const Grid& grid, u32x4 at) {
    u32 cell = 0;
    for (int a = 0; a < D; a++) cell = cell * grid.side + (at[a] & (grid.side - 1));
    return grid.first + cell;
  }

  static Range range_of(const Grid& grid, const f32* region) {
    u32x4 low = cells_of(grid, load<f32x4>(region));
    constexpr u32 all = ~0u;
    if constexpr (D == 2) return {low & u32x4{all, all, 0, 0}, __builtin_shufflevector(low, u32x4{}, 2, 3, 4, 4)};
    u32x4 along = {all, all, all, 0};
    return {low & along, cells_of(grid, load<f32x4>(region + D)) & along};
  }

  /// The cells of four coordinates, from 0 to 2^23 - 1. Monotone; what is further away is in the first or the last.
  static u32x4 cells_of(const Grid& grid, f32x4 x) {
    f32x4 at = x * splat(grid.scale) + splat(1.5f * whole);
    return bits<u32x4>(min(max(at, splat(whole)), splat(2 * whole - 1))) - splat(bits<u32>(whole));
  }
};
