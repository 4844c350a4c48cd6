// Spatial grid: uniform cells, every box in every cell it overlaps, rebuilt each update.
//
// Idea: the article's second approach, with two of its problems solved. Boxes are put into cells by a counting
// sort, so nothing is allocated per cell. A pair is reported only in the cell that holds the larger of the two
// minimum corners, so no table of tested pairs is needed: a box is marked, per axis, in the cells it continues
// into, and two boxes with a common mark have met in an earlier cell. Boxes outside the grid stand in its border
// cells. Where no cell size is given it follows from the mean size and the crowding of the boxes.
// Cost: build O(n + entries + cells), pairs O(sum over cells of their squared number of boxes).
// Wins where boxes are of one size and evenly spread. Loses on mixed sizes: no cell size is right for them.
// From: A. Petersen, "Broad Phase Collision Detection Using Spatial Partitioning", 2012, approach 2; the
// reference cell is from Dittrich & Seeger, "Data Redundancy and Duplicate Detection in Spatial Join
// Processing", ICDE 2000.
#pragma once
#include "settings.hpp"
#include "statistics.hpp"
#include "stats.hpp"
#include "sweep.hpp"

template <int D> class SpatialGrid {
  static constexpr f64 boxes_per_cell = 3;  // aimed at; measured to be nearly flat from 2 to 5
  static constexpr u32 most_cells = 1u << 24;
  // A cell size so small that boxes would have more entries than this (or 16 each) is doubled until they do not.
  static constexpr u64 most_entries = 1u << 22;

  Items<D> ordered_;
  Lanes<D> lanes_;
  Buffer<u32> starts_;  // per cell, where its entries begin, later: end
  Buffer<u32> end_;     // per entry, the end of its cell
  Axis axis_[D];
  u32 cells_[D] = {};
  f64 low_[D] = {}, size_[D] = {};

 public:
  void update(const Scene<D>& scene, const Settings& options, Pairs& pairs, Stats& stats) {
    if (scene.count == 0) return;
    SceneItems<D> items{scene, AxisOrder<D>::make(0)};
    u64 total = choose(items, scene.count, options);
    u32 cells = cell_total();
    u32* starts = starts_.reserve(cells);
    __builtin_memset(starts, 0, u64(cells) * sizeof(u32));
    for (u32 k = 0; k < scene.count; k++) {
      visit(items[k], [&](u32 cell, u32) { starts[cell]++; });
    }
    u32 at = 0;
    for (u32 c = 0; c < cells; c++) {
      u32 size = starts[c];
      starts[c] = at;
      at += size;
      stats.tests += f64(size) * (size - 1.0) / 2;
      stats.cells += size > 0;
    }
    stats.entries = f64(total);

    ordered_.grow(total, 0);
    lanes_.reserve(u32(total));
    u32* end = end_.reserve(total);
    ItemsAt<D> ordered(ordered_, 0);
    for (u32 k = 0; k < scene.count; k++) {
      Item<D> item = items[k];
      visit(item, [&](u32 cell, u32 continues) { ordered.put(starts[cell]++, with_tag(item, continues)); });
    }
    lanes_.fill(ordered, u32(total));
    // starts[c] is now where cell c ends.
    u32 k = 0;
    for (u32 c = 0; c < cells; c++) {
      for (u32 until = starts[c]; k < until; k++) end[k] = until;
    }
    sweep<D, true>(lanes_, end, 0, u32(total), pairs);
  }

  /// The cells with boxes in them.
  COLD void structure(Buffer<f32>& boxes, u32& count, const Stats& stats) const {
    count = 0;
    boxes.reserve(u64(stats.cells) * 2 * D);
    if (stats.cells == 0) return;
    u32 begin = 0;
    for (u32 c = 0; c < cell_total(); c++) {
      if (starts_[c] == begin) continue;
      begin = starts_[c];
      u32 rest = c;
      for (int a = D - 1; a >= 0; a--) {
        f64 low = low_[a] + rest % cells_[a] * size_[a];
        rest /= cells_[a];
        boxes[u64(count) * 2 * D + a] = f32(low);
        boxes[u64(count) * 2 * D + D + a] = f32(low + size_[a]);
      }
      count++;
    }
  }

  COLD void release() {
    ordered_.release();
    lanes_.release();
    starts_.release();
    end_.release();
  }

 private:
  u32 cell_total() const {
    u32 total = 1;
    for (int a = 0; a < D; a++) total *= cells_[a];
    return total;
  }

  /// Sets the grid; returns the number of entries the boxes will have in it.
  u64 choose(const SceneItems<D>& items, u32 count, const Settings& options) {
    Statistics<D> world = measure<D>(items, count);
    f64 extent[D], chosen[D];
    bool bounded = false;
    for (int a = 0; a < D; a++) bounded |= options.bounds[a] < options.bounds[D + a];
    f64 share = world.crowding * count;  // boxes in a cell as large as the mean box
    for (int a = 0; a < D; a++) {
      low_[a] = bounded ? options.bounds[a] : world.low[a];
      extent[a] = bounded ? options.bounds[D + a] - low_[a] : world.high[a] - low_[a];
      f64 spread = world.high[a] - world.low[a];
      chosen[a] = larger(world.size[a], spread * 1e-3 / count);
      if (spread > 0) share *= chosen[a] / spread;
    }
    f64 factor = share > 0 ? boxes_per_cell / share : 1;
    factor = larger(1.0, D == 2 ? __builtin_sqrt(factor) : cube_root(factor));
    for (int a = 0; a < D; a++) {
      bool given = options.cell_size[a] > 0;
      size_[a] = given ? options.cell_size[a] : chosen[a] * factor;
      f64 wanted = size_[a] > 0 ? extent[a] / size_[a] : 1;
      cells_[a] = u32(larger(1.0, smaller(f64(most_cells), __builtin_ceil(wanted))));
      if (!given) size_[a] = extent[a] / cells_[a];
    }
    for (;;) {
      f64 cells = 1;
      for (int a = 0; a < D; a++) {
        // Axis rounds to the nearest: cell 0 is centred half a cell in.
        f64 first = low_[a] + size_[a] / 2;
        axis_[a] = Axis::make(first, first + (cells_[a] - 1) * size_[a], cells_[a]);
        cells *= cells_[a];
      }
      if (cells <= most_cells) {
        u64 limit = larger(most_entries, u64(count) * 16), total = 0;
        for (u32 k = 0; k < count && total <= limit; k++) {
          Item<D> item = items[k];
          u64 covered = 1;
          for (int a = 0; a < D; a++) covered *= axis_[a](item.hi(a)) - axis_[a](item.lo(a)) + 1;
          total += covered;
        }
        if (total <= limit || cells == 1) return total;
      }
      for (int a = 0; a < D; a++) {
        if (cells_[a] == 1) continue;
        cells_[a] = (cells_[a] + 1) / 2;
        size_[a] *= 2;
      }
    }
  }

  /// Calls `at(cell, continues)` for every cell an item overlaps.
  template <class At> void visit(const Item<D>& item, At at) const {
    u32 first[D], last[D];
    for (int a = 0; a < D; a++) {
      first[a] = axis_[a](item.lo(a));
      last[a] = axis_[a](item.hi(a));
    }
    for (u32 x = first[0]; x <= last[0]; x++) {
      u32 marks_x = x > first[0] ? u32(continues_1) : 0;
      for (u32 y = first[1]; y <= last[1]; y++) {
        u32 cell = x * cells_[1] + y;
        u32 marks = marks_x | (y > first[1] ? u32(continues_2) : 0);
        if constexpr (D == 2) {
          at(cell, marks);
        } else {
          for (u32 z = first[2]; z <= last[2]; z++) {
            at(cell * cells_[2] + z, marks | (z > first[2] ? u32(continues_3) : 0));
          }
        }
      }
    }
  }
};
