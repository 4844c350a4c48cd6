// Hierarchical grid: a grid for each size of box, each box in one cell of the grid that fits it.
//
// Idea: cell sizes are powers of two, and a box is in the cell of its minimum corner, at a level whose cells are larger
// than it; boxes it overlaps then start in the same cell or in one next to it. Within a level it searches only cells
// that it extends into, so that every pair is found from one side; it also searches the cells around it in the levels
// of larger boxes, never of smaller ones. A level whose cells would be nearly empty is merged into the next: cells are
// no finer than the spacing of boxes, and there are few levels to search. The grids are unbounded: cells wrap around,
// modulo a power of two that depends on the number of boxes in the level, and boxes tell apart cells that coincide.
// Rows of cells are contiguous, so neighbours along a row are one run.
// Cost: update O(n), pairs O(n * levels * 3^(D - 1) + candidates); memory about 60 (2D) or 90 (3D) bytes a box.
// Wins on boxes of mixed sizes in any world, clustered and endless ones too. Loses a little to grids of one level on
// boxes of one size, and when boxes are long and thin: their cells are as wide as they are long.
// From: F. Schornbaum, "Hierarchical Hash Grids for Coarse Collision Detection", 2009.
#pragma once
#include "search/cell_table.hpp"
#include "search/options.hpp"
#include "search/stats.hpp"

template <int D> class HierarchicalGrid {
  // A level with fewer boxes per cell of the world is merged into the next. Measured: times are nearly flat from 1 to
  // 3.
  static constexpr f64 crowd = 1.2;
  // When at most this many larger boxes are left, all others are tested against them.
  static constexpr u32 few = 24;
  // A class is a float's exponent: boxes of class c are smaller than 2^(c - 126). Those above the last one, infinite
  // ones among them, have a level of one cell.
  static constexpr u32 last_class = 252, classes = 256;

  using Place = typename CellTable<D>::Place;

  static constexpr u32 most_near = D == 2 ? 6 : 18;
  struct Level {
    CellTable<D> cells;
    Place last;  // the last place whose surroundings were searched
    Run near[most_near];  // the runs found there
    u32 near_count;
  };
  // Runs are swept when there are this many.
  static constexpr u32 enough_runs = 2048;

  Buffer<Level> levels_;
  u8 level_of_[classes] = {};  // class
  u32 level_count_ = 0;
  Buffer<Run> runs_;
  Buffer<u32> cells_;  // per slot its class, then its cell
  Buffer<u32> starts_;  // per cell
  Items<D> ordered_;
  Lanes<D> lanes_;

 public:
  void update(const Scene<D>& scene, const Options&, Pairs& pairs, Stats& stats) {
    u32 n = scene.count;
    if (n < 2) return;
    SceneItems<D> items{scene, AxisOrder<D>::make(0)};
    u32* cells = cells_.reserve(n);
    u32 sizes[classes] = {};
    for (u32 k = 0; k < n; k++) sizes[cells[k] = class_of(items[k])]++;
    u32 total = choose(measure<D>(items, n), sizes, n);

    u32* starts = starts_.reserve(total + 1);
    __builtin_memset(starts, 0, (total + 1) * sizeof(u32));
    u32* ends = starts + 1;
    for (u32 k = 0; k < n; k++) {
      const CellTable<D>& level = levels_[level_of_[cells[k]]].cells;
      u32 cell = level.index(level.place(items[k]));
      cells[k] = cell;
      ends[cell]++;
    }
    u32 at = 0;
    for (u32 c = 0; c < total; c++) {
      u32 size = ends[c];
      ends[c] = at;
      at += size;
      stats.cells += size > 0;
    }
    stats.entries = n;

    ordered_.grow(n, 0);
    lanes_.reserve(n);
    ItemsAt<D> ordered(ordered_, 0);
    for (u32 k = 0; k < n; k++) ordered.put(ends[cells[k]]++, items[k]);
    lanes_.fill(ordered, n);
    // ends[c] is now where cell c ends, and starts[c] where it begins.
    Run* runs = runs_.reserve(enough_runs + (level_count_ + 1) * most_near);
    Run* out = runs;
    for (u32 l = 0; l < level_count_; l++) {
      for (u32 i = starts[levels_[l].cells.first], last = last_of(l, n); i < last; i++) {
        Item<D> item = ordered[i];
        out = levels_[l].cells.peers(out, starts, item, i);
        for (u32 upper = l + 1; upper < level_count_; upper++) out = elders(out, levels_[upper], item, i);
        if (out < runs + enough_runs) continue;
        stats.tests += sweep_runs<D>(lanes_, runs, out, pairs);
        out = runs;
      }
    }
    stats.tests += sweep_runs<D>(lanes_, runs, out, pairs);
  }

  /// The cell of each box, but not the same one twice in a row.
  SMALL void structure(Buffer<f32>& boxes, u32& count, const Stats& stats) const {
    count = 0;
    boxes.reserve(u64(stats.entries) * 2 * D);
    if (stats.entries == 0) return;
    f32* to = boxes.data();
    u32 n = u32(stats.entries);
    for (u32 l = 0; l < level_count_; l++) {
      const CellTable<D>& level = levels_[l].cells;
      to = level.draw(to, ItemsAt<D>(ordered_, 0), starts_[level.first], last_of(l, n));
    }
    count = u32(to - boxes.data()) / (2 * D);
  }

  SMALL void release() {
    levels_.release();
    runs_.release();
    cells_.release();
    starts_.release();
    ordered_.release();
    lanes_.release();
  }

 private:
  /// The end of the items of a level, of `count` in all.
  u32 last_of(u32 level, u32 count) const {
    return level + 1 < level_count_ ? starts_[levels_[level + 1].cells.first] : count;
  }

  /// The exponent of a box's longest side, or larger if cells of that size would be too many to count.
  static u32 class_of(const Item<D>& item) {
    f32x4 tiny = splat(0x1p-22f);
    u32x4 most;
    if constexpr (D == 2) {
      f32x4 facing = __builtin_shufflevector(item.box, item.box, 2, 3, 0, 1);
      most = max(magnitude(facing - item.box), magnitude(item.box * tiny));
    } else {
      most = max(magnitude(item.size()), max(magnitude(item.high * tiny), magnitude(item.first() * tiny)));
    }
    most = max(most, __builtin_shufflevector(most, most, 2, 3, 0, 1));
    return larger(most[0], most[1]) >> 23;
  }
  static u32x4 magnitude(f32x4 v) { return bits<u32x4>(v) & splat(0x7fffffffu); }

  /// Sets up levels for the classes in use; returns the number of cells.
  SMALL u32 choose(const SceneSample<D>& world, const u32* sizes, u32 rest) {
    level_count_ = 0;
    u32 cells = 0, waiting = 0;
    for (u32 c = 0; c < classes; c++) {
      level_of_[c] = u8(level_count_);
      waiting += sizes[c];
      bool endless = c >= last_class || rest <= few;
      if (waiting == 0 || (endless && c + 1 < classes)) continue;
      levels_.grow(level_count_ + 1, level_count_);
      Level& level = levels_[level_count_];
      level.last.at = splat(~0u);
      f32 scale = endless ? 0 : bits<f32>((253 - c) << 23);
      f64 across[D], spread = 1;
      for (int a = 0; a < D; a++) {
        across[a] = larger(1.0, (world.high[a] - world.low[a]) * f64(scale));
        spread *= across[a];
      }
      if (!endless && waiting * world.crowding < crowd * spread) continue;
      level.cells.scale = splat(scale);
      cells += level.cells.shape(across, cells, u64(waiting) * 4);
      rest -= waiting;
      waiting = 0;
      level_count_++;
    }
    return cells;
  }

  /// The items of a higher level around an item. The result is cached for the next item, which is usually close by.
  Run* elders(Run* out, Level& level, const Item<D>& item, u32 i) const {
    Place place = level.cells.place(item);
    if (any(bits<i32x4>((place.at ^ level.last.at) | (place.reach ^ level.last.reach)))) {
      level.last = place;
      level.near_count = u32(level.cells.block(level.near, starts_.data(), place, i) - level.near);
    }
    for (u32 k = 0; k < level.near_count; k++) *out++ = {i, level.near[k].from, level.near[k].until};
    return out;
  }
};
