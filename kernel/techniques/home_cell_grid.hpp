// Home-cell grid: each box in one cell of one grid; the search visits neighbouring cells.
//
// Idea: a box is in the cell of its minimum corner, and is sorted like a point; boxes it can overlap start in its cell
// or in one beside it. A box searches only cells that it extends into, so that every pair is found from one side. The
// few boxes larger than a cell do not enlarge the cells for all: they are kept separately, sorted along one axis; each
// searches the cells under it, row by row, and a sweep finds the pairs among them. Cells are as large as 98 % of the
// boxes, larger if boxes are far apart, and may be longer along one axis.
// Cost: update O(n), pairs O(n * 3^(D - 1) + candidates + rows of cells under large boxes); memory about 75 (2D) or
// 100 (3D) bytes a box.
// Wins on boxes of one size, dense ones above all: nothing is stored twice. Loses on boxes of all sizes at once, and
// when boxes are long and thin along different axes.
// From: A. Petersen, "Broad Phase Collision Detection Using Spatial Partitioning", 2012, future expansion; the cell
// lists of molecular dynamics (R. Hockney & J. Eastwood, "Computer Simulation Using Particles", 1981).
#pragma once
#include "base/radix_sort.hpp"
#include "search/cell_table.hpp"
#include "search/quantized_sweep.hpp"
#include "search/options.hpp"
#include "search/stats.hpp"

template <int D> class HomeCellGrid {
  static constexpr f64 crowd = 1.2;    // boxes per cell, at least; measured: times are nearly flat from 1 to 3
  static constexpr f64 common = 0.98;  // the share of boxes that fit in a cell
  // Runs are swept when there are this many.
  static constexpr u32 enough_runs = 2048;
  // A row of cells costs as much as this many boxes: a large box with too many rows under it is tested against all
  // boxes in one run.
  static constexpr u32 row_cost = 8;

  CellTable<D> table_ = {};
  Buffer<u32> cells_;   // per slot its cell; large boxes have the one after the last
  Buffer<u32> starts_;  // per cell
  Buffer<u32> large_;   // slots
  Items<D> ordered_;    // by cell, then large boxes in the order of the sweep
  Lanes<D> lanes_;
  Buffer<Run> runs_;
  RadixSort sort_;
  QuantizedSweep<D> sweep_;  // of the large ones
  u32 home_ = 0;  // boxes that are not large

 public:
  void update(const Scene<D>& scene, const Options& options, Pairs& pairs, Stats& stats) {
    u32 n = scene.count;
    if (n < 2) return;
    SceneItems<D> items{scene, AxisOrder<D>::make(0)};
    SceneSample<D> world = measure<D>(items, n);
    u32 total = choose(world, n, options);
    u32* cells = cells_.reserve(n);
    u32* large = large_.reserve(n);
    u32* starts = starts_.reserve(total + 1);
    __builtin_memset(starts, 0, (total + 1) * sizeof(u32));
    u32* ends = starts + 1;
    u32 large_count = 0;
    for (u32 k = 0; k < n; k++) {
      Item<D> item = items[k];
      Place place = table_.place(item);
      bool fits = table_.is_counted(item);
      for (int a = 0; a < D; a++) fits &= place.reach[a] < 2;
      cells[k] = table_.index(place);
      ends[cells[k]] += fits;
      large[large_count] = k;
      if (!fits) cells[k] = total;
      large_count += !fits;
    }
    u32 at = 0;
    for (u32 c = 0; c < total; c++) {
      u32 size = ends[c];
      ends[c] = at;
      at += size;
      stats.cells += size > 0;
    }
    stats.entries = n;

    u32 home = home_ = n - large_count;
    ordered_.grow(n, 0);
    lanes_.reserve(n);
    ItemsAt<D> ordered(ordered_, 0);
    for (u32 k = 0; k < n; k++) {
      if (cells[k] < total) ordered.put(ends[cells[k]]++, items[k]);
    }
    // ends[c] is now where cell c ends, and starts[c] where it begins.
    if (large_count > 0) {
      sort_.begin(large_count);
      for (u32 k = 0; k < large_count; k++) sort_.put(k, items[large[k]].lo(0));
      sort_.sort(large_count);
      for (u32 k = 0; k < large_count; k++) ordered.put(home + k, items[large[sort_.index(k)]]);
    }
    lanes_.fill(ordered, n);
    Run* runs = runs_.reserve(enough_runs + home / row_cost * 2 + 32);
    Run* out = runs;
    for (u32 i = 0; i < n; i++) {
      Item<D> item = ordered[i];
      out = i < home ? table_.peers(out, starts, item, i) : below(out, item, i, home);
      if (out < runs + enough_runs) continue;
      stats.tests += sweep_runs<D>(lanes_, runs, out, pairs);
      out = runs;
    }
    stats.tests += sweep_runs<D>(lanes_, runs, out, pairs);
    stats.tests += f64(sweep_.find(lanes_, world, home, n, pairs));
  }

  /// The cells with boxes in them.
  SMALL void structure(Buffer<f32>& boxes, u32& count, const Stats& stats) const {
    count = 0;
    boxes.reserve(u64(stats.entries) * 2 * D);
    if (stats.entries == 0) return;
    f32* end = table_.draw(boxes.data(), ItemsAt<D>(ordered_, 0), 0, home_);
    count = u32(end - boxes.data()) / (2 * D);
  }

  SMALL void release() {
    cells_.release();
    starts_.release();
    large_.release();
    ordered_.release();
    lanes_.release();
    runs_.release();
    sort_.release();
    sweep_.release();
  }

 private:
  using Place = typename CellTable<D>::Place;

  /// The items of the cells under a large item.
  Run* below(Run* out, const Item<D>& item, u32 i, u32 home) const {
    Place place = table_.place(item);
    u64 rows = 1;
    for (int a = 1; a < D; a++) rows *= table_.around(place, a);
    if (rows * row_cost > home || !table_.is_counted(item)) return add(out, i, 0, home);
    return table_.block(out, starts_.data(), place, i);
  }

  /// Chooses the cells; returns their number.
  SMALL u32 choose(const SceneSample<D>& world, u32 count, const Options& options) {
    f64 size[D], extent[D];
    f64 share = world.crowding * count;  // boxes in a cell
    for (int a = 0; a < D; a++) {
      extent[a] = world.high[a] - world.low[a];
      // A little larger than the boxes, so that rounding cannot make them cross two borders.
      size[a] = larger(common_size(a, D, count, common) * 1.001, extent[a] * 1e-6);
      if (extent[a] > size[a]) share *= size[a] / extent[a];
    }
    f64 factor = larger(1.0, crowd / share);
    factor = D == 2 ? __builtin_sqrt(factor) : cube_root(factor);
    f64 wanted[D];
    for (int a = 0; a < D; a++) {
      size[a] = options.cell_size[a] > 0 ? options.cell_size[a] : size[a] * factor;
      f32 scale = size[a] > 0 ? f32(smaller(1 / size[a], 1e30)) : 0;
      table_.scale[a] = scale;
      if (D == 2) table_.scale[2 + a] = scale;
      wanted[a] = extent[a] * f64(scale);
    }
    return table_.shape(wanted, 0, u64(count) * 4);
  }
};
