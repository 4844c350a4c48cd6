// Hierarchical grid: a grid for each size of box, each box in one cell of the grid that fits it.
//
// Idea: cells are powers of two, and a box stands in the cell of its minimum corner, at a level whose cells are larger
// than it; what it overlaps then starts in the same cell or in one next to it. Within a level it looks only at cells
// that it reaches into, so that every pair is met from one side; besides it looks at the cells around it in the
// levels of larger boxes, never of smaller ones. A level whose cells would be nearly empty is merged into the next:
// cells are no finer than the boxes are apart, and there are few levels to look at. The grids are endless: cells are
// counted round and round, modulo a power of two that follows the number of boxes in the level, and those that fall
// together are told apart by the boxes. Rows of cells are contiguous, so neighbours along a row are one run.
// Cost: update O(n), pairs O(n * levels * 3^(D - 1) + candidates); memory about 60 (2D) or 90 (3D) bytes a box.
// Wins on boxes of mixed sizes in any world, clustered and endless ones too. Loses a little to grids of one level on
// boxes of one size, and where boxes are long and thin: their cells are as wide as they are long.
// From: F. Schornbaum, "Hierarchical Hash Grids for Coarse Collision Detection", 2009.
#pragma once
#include "settings.hpp"
#include "statistics.hpp"
#include "stats.hpp"
#include "sweep.hpp"

template <int D> class HierarchicalGrid {
  // A level has at least so many boxes in each cell of the world, or it is merged into the next: measured to be
  // nearly flat from 1 to 3.
  static constexpr f64 crowd = 1.2;
  // When so few large boxes are left, all others are tested against them.
  static constexpr u32 few = 24;
  // A class is a float's exponent: boxes of class c are smaller than 2^(c - 126). Those above the last one, infinite
  // ones among them, have a level of one cell.
  static constexpr u32 last_class = 252, classes = 256;

  /// Where a box lies in a level: its first cell, and whether it reaches into the next.
  struct Place {
    u32x4 at, reach;
  };

  struct Level {
    u32x4 mask;    // per lane of an item's vectors: the number of cells, a power of two but not 2, less 1
    f32 scale;     // cells per unit; 0: one cell for all
    u32 first;     // cell
    u32 shift[D];  // of the number of a cell along each axis
    Place last;    // the last place that was looked around
    Run near[D == 2 ? 6 : 18];  // what was found there
    u32 near_count;
  };
  // Runs are swept when there are this many.
  static constexpr u32 enough_runs = 2048;

  Buffer<Level> levels_;
  u8 level_of_[classes] = {};  // class
  u32 level_count_ = 0;
  Buffer<Run> runs_;
  Buffer<u32> cells_;   // per slot its class, then its cell
  Buffer<u32> starts_;  // per cell
  Items<D> ordered_;
  Lanes<D> lanes_;

 public:
  void update(const Scene<D>& scene, const Settings&, Pairs& pairs, Stats& stats) {
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
      const Level& level = levels_[level_of_[cells[k]]];
      u32 cell = index(level, places(level, items[k].first()));
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
    Run* runs = runs_.reserve(enough_runs + level_count_ * 18);
    Run* out = runs;
    for (u32 l = 0; l < level_count_; l++) {
      for (u32 i = starts[levels_[l].first], last = last_of(l, n); i < last; i++) {
        Item<D> item = ordered[i];
        out = peers(out, levels_[l], item, i);
        for (u32 upper = l + 1; upper < level_count_; upper++) out = elders(out, levels_[upper], item, i);
        if (out < runs + enough_runs) continue;
        stats.tests += sweep_runs<D>(lanes_, runs, out, pairs);
        out = runs;
      }
    }
    stats.tests += sweep_runs<D>(lanes_, runs, out, pairs);
  }

  /// The cell of each box, but not the same one twice in a row.
  COLD void structure(Buffer<f32>& boxes, u32& count, const Stats& stats) const {
    count = 0;
    boxes.reserve(u64(stats.entries) * 2 * D);
    if (stats.entries == 0) return;
    for (u32 l = 0; l < level_count_; l++) {
      const Level& level = levels_[l];
      for (u32 i = starts_[level.first], last = last_of(l, u32(stats.entries)); i < last; i++) {
        f32* box = boxes.data() + u64(count) * 2 * D;
        bool another = i == starts_[level.first];
        for (int a = 0; a < D; a++) {
          f32 cell = level.scale > 0 ? lanes_.lo(a)[i] * level.scale + magic - magic : 0;
          box[a] = (cell - 0.5f) / level.scale;
          box[D + a] = (cell + 0.5f) / level.scale;
          another |= box[a] != box[a - 2 * D];
        }
        count += another;
      }
    }
  }

  COLD void release() {
    levels_.release();
    runs_.release();
    cells_.release();
    starts_.release();
    ordered_.release();
    lanes_.release();
  }

 private:
  // Added to a float below 2^22 it leaves the nearest integer in the low bits, two's complement.
  static constexpr f32 magic = 12582912;

  /// The end of the items of a level, of `count` in all.
  u32 last_of(u32 level, u32 count) const {
    return level + 1 < level_count_ ? starts_[levels_[level + 1].first] : count;
  }

  /// The exponent of a box's longest side, or larger where its cells would be too many to be counted.
  static u32 class_of(const Item<D>& item) {
    f32x4 tiny = splat(0x1p-22f);
    u32x4 most;
    if constexpr (D == 2) {
      f32x4 turned = __builtin_shufflevector(item.box, item.box, 2, 3, 0, 1);
      most = max(magnitude(turned - item.box), magnitude(item.box * tiny));
    } else {
      most = max(magnitude(item.high - item.low), max(magnitude(item.high * tiny), magnitude(item.low * tiny)));
      most &= u32x4{~0u, ~0u, ~0u, 0};
    }
    most = max(most, __builtin_shufflevector(most, most, 2, 3, 0, 1));
    return larger(most[0], most[1]) >> 23;
  }
  static u32x4 magnitude(f32x4 v) { return bits<u32x4>(v) & splat(0x7fffffffu); }

  /// The cells of a level in which coordinates lie, along each axis.
  static u32x4 places(const Level& level, f32x4 x) {
    return bits<u32x4>(x * splat(level.scale) + splat(magic)) & level.mask;
  }

  static u32 index(const Level& level, u32x4 cell) {
    u32 at = level.first + cell[0];
    for (int a = 1; a < D; a++) at += cell[a] << level.shift[a];
    return at;
  }

  /// Makes the levels for boxes of these classes; returns the number of cells.
  COLD u32 choose(const Statistics<D>& world, const u32* sizes, u32 rest) {
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
      level.scale = endless ? 0 : bits<f32>((253 - c) << 23);
      u64 need[D], most = u64(waiting) * 4;
      f64 spread = 1;
      for (int a = 0; a < D; a++) {
        f64 across = smaller(larger(1.0, (world.high[a] - world.low[a]) * f64(level.scale)), 1e9);
        spread *= across;
        need[a] = u64(across) + 1;
      }
      if (!endless && waiting * world.crowding < crowd * spread) continue;
      u32 log[D], sum = 0;
      for (int a = 0; a < D; a++) {
        log[a] = need[a] > 1 ? smaller(22u, larger(2u, 64 - u32(__builtin_clzll(need[a])))) : 0;
        sum += log[a];
      }
      while (u64(1) << sum > most) {
        int widest = 0;
        for (int a = 1; a < D; a++) widest = log[a] > log[widest] ? a : widest;
        u32 less = log[widest] > 2 ? 1 : 2;
        log[widest] -= less;
        sum -= less;
      }
      level.first = cells;
      level.mask = u32x4{};
      u32 shift = 0;
      for (int a = 0; a < D; a++) {
        level.mask[a] = (1u << log[a]) - 1;
        if (D == 2) level.mask[2 + a] = level.mask[a];
        level.shift[a] = shift;
        shift += log[a];
      }
      cells += 1u << sum;
      rest -= waiting;
      waiting = 0;
      level_count_++;
    }
    return cells;
  }

  static Place place_of(const Level& level, const Item<D>& item) {
    u32x4 at = places(level, item.first()), behind;
    if constexpr (D == 2) behind = __builtin_shufflevector(at, at, 2, 3, 2, 3);
    else behind = places(level, item.high);
    return {at, (behind - at) & level.mask};
  }

  /// The items of `count` cells of a row, from cell x on; the row begins with cell `row` and closes on itself.
  /// `from`: the first item of these cells to be taken.
  Run* run(Run* out, const Level& level, u32 item, u32 from, u32 row, u32 x, u32 count) const {
    u32 width = level.mask[0] + 1, behind = x + count;
    out = add(out, item, from, starts_[row + smaller(behind, width)]);
    return add(out, item, starts_[row], starts_[row + larger(behind, width) - width]);
  }

  /// Cells around a place along an axis: from the one before it to the last it reaches, but none twice.
  static u32 before(const Level& level, const Place& place, int axis) {
    return (place.at[axis] - 1) & level.mask[axis];
  }
  static u32 around(const Level& level, const Place& place, int axis) {
    return smaller(place.reach[axis] + 2, level.mask[axis] + 1);
  }

  /// All items around a place in a layer of rows.
  Run* layer(Run* out, const Level& level, const Place& place, u32 item, u32 first) const {
    u32 x = before(level, place, 0), count = around(level, place, 0);
    u32 y = before(level, place, 1);
    for (u32 high = around(level, place, 1); high > 0; high--) {
      u32 row = first + (y << level.shift[1]);
      out = run(out, level, item, starts_[row + x], row, x, count);
      y = (y + 1) & level.mask[1];
    }
    return out;
  }

  /// The items of its own level that an item meets: those behind it in its cell, and those of the cells that it
  /// reaches into or that lie beside these.
  Run* peers(Run* out, const Level& level, const Item<D>& item, u32 i) const {
    Place place = place_of(level, item);
    u32 first = level.first;
    if constexpr (D == 3) first += place.at[2] << level.shift[2];
    u32 x = place.at[0];
    out = run(out, level, i, i + 1, first + (place.at[1] << level.shift[1]), x, place.reach[0] + 1);
    if (place.reach[1]) {
      u32 row = first + (((place.at[1] + 1) & level.mask[1]) << level.shift[1]);
      u32 left = before(level, place, 0);
      out = run(out, level, i, starts_[row + left], row, left, around(level, place, 0));
    }
    if constexpr (D == 3) {
      if (place.reach[2]) {
        u32 next = level.first + (((place.at[2] + 1) & level.mask[2]) << level.shift[2]);
        out = layer(out, level, place, i, next);
      }
    }
    return out;
  }

  /// The items of a level above that an item meets: all around it. Kept for the next item, which stands near it.
  Run* elders(Run* out, Level& level, const Item<D>& item, u32 i) const {
    Place place = place_of(level, item);
    if (any(bits<i32x4>((place.at ^ level.last.at) | (place.reach ^ level.last.reach)))) {
      level.last = place;
      Run* to = level.near;
      if constexpr (D == 2) {
        to = layer(to, level, place, 0, level.first);
      } else {
        u32 z = before(level, place, 2);
        for (u32 deep = around(level, place, 2); deep > 0; deep--) {
          to = layer(to, level, place, 0, level.first + (z << level.shift[2]));
          z = (z + 1) & level.mask[2];
        }
      }
      level.near_count = u32(to - level.near);
    }
    for (u32 k = 0; k < level.near_count; k++) *out++ = {i, level.near[k].from, level.near[k].until};
    return out;
  }
};
