// Spatial grid: uniform cells, every box in every cell it overlaps, rebuilt each update.
//
// Idea: the article's second approach, with two of its problems solved. Boxes are put into cells by a counting
// sort, so nothing is allocated per cell. A pair is reported only in the cell that holds the larger of the two
// minimum corners, so no table of tested pairs is needed: a box is marked, per axis, in the cells it continues
// into, and two boxes with a common mark have met in an earlier cell.
// Cost: build O(n + entries + cells), pairs O(sum over cells of their squared number of boxes).
// Wins when boxes are of one size and evenly spread. Loses on mixed sizes: no cell size is right for them.
// From: A. Petersen, "Broad Phase Collision Detection Using Spatial Partitioning", 2012, approach 2; the
// reference cell is from Dittrich & Seeger, "Data Redundancy and Duplicate Detection in Spatial Join
// Processing", ICDE 2000.
#pragma once
#include "search/grid.hpp"
#include "search/stats.hpp"
#include "search/sweep.hpp"

template <int D> class SpatialGrid {
  /// Each update visits all cells, so few boxes must not get many.
  static u32 most_cells(u32 count) { return u32(smaller(u64(1) << 24, (u64(1) << 16) + 128 * u64(count))); }

  Items<D> ordered_;
  Lanes<D> lanes_;
  Buffer<u32> starts_;  // per cell, where its entries begin, later: end
  Buffer<u32> end_;     // per entry, the end of its cell
  Grid<D> grid_;

 public:
  void update(const Scene<D>& scene, const Options& options, Pairs& pairs, Stats& stats) {
    if (scene.count == 0) return;
    SceneItems<D> items{scene, AxisOrder<D>::make(0)};
    u64 total = grid_.choose(items, scene.count, options, most_cells(scene.count));
    u32 cells = grid_.total();
    Axes axes = grid_.axes();
    u32* starts = starts_.reserve(cells);
    __builtin_memset(starts, 0, u64(cells) * sizeof(u32));
    for (u32 k = 0; k < scene.count; k++) {
      grid_.visit(grid_.range(axes, items[k]), [&](u32 cell, u32) { starts[cell]++; });
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
    u32* end = end_.reserve(total + 4);
    ItemsAt<D> ordered(ordered_, 0);
    for (u32 k = 0; k < scene.count; k++) {
      Item<D> item = items[k];
      grid_.visit(grid_.range(axes, item),
                  [&](u32 cell, u32 continues) { ordered.put(starts[cell]++, with_tag(item, continues)); });
    }
    lanes_.fill(ordered, u32(total));
    // starts[c] is now where cell c ends.
    u32 k = 0;
    for (u32 c = 0; c < cells; c++) {
      u32 until = starts[c];
      do {
        store(end + k, splat(until));  // may write past the cell's end: the next cells overwrite that
        k += 4;
      } while (k < until);
      k = until;
    }
    sweep<D, true>(lanes_, end, u32(total), pairs);
  }

  /// The cells with boxes in them.
  SMALL void structure(Buffer<f32>& boxes, u32& count, const Stats& stats) const {
    count = 0;
    boxes.reserve(u64(stats.cells) * 2 * D);
    if (stats.cells == 0) return;
    u32 begin = 0;
    for (u32 c = 0; c < grid_.total(); c++) {
      if (starts_[c] == begin) continue;
      begin = starts_[c];
      grid_.draw(c, boxes.data() + u64(count) * 2 * D);
      count++;
    }
  }

  SMALL void release() {
    ordered_.release();
    lanes_.release();
    starts_.release();
    end_.release();
  }
};
