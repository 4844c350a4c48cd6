// Retained grid: the cells of the spatial grid, retained between updates.
//
// Idea: each box is compared with its copy from the previous update. An unchanged box costs nothing more; a changed one
// makes its cells dirty, and only if it overlaps other cells than before is it removed from the old ones and added to
// the new. Then the dirty cells are searched for pairs with a changed box; pairs of unchanged boxes are retained. A
// cell is a short list of slots with room to grow. When much has changed at once, or boxes have drifted until the cells
// no longer suit them, the grid is rebuilt.
// Cost: update O(n + entries of the boxes that changed cells), pairs O(dirty cells * their squared number of boxes);
// memory about 100 (2D) or 200 (3D) bytes per box, and the pairs, which are retained too.
// Wins when most boxes are at rest. Loses when all move: then change detection saves little.
// From: A. Petersen, "Broad Phase Collision Detection Using Spatial Partitioning", 2012, future expansion.
#pragma once
#include "pairs/pair_order.hpp"
#include "search/grid.hpp"
#include "search/stats.hpp"
#include "search/sweep.hpp"

template <int D> class RetainedGrid {
  // If moving boxes visits more entries than this per box, a full rebuild is cheaper.
  static constexpr u32 most_effort = 8;
  // A full rebuild when there are `most_worse` times as many entries, or tests, as after the last one, or room for
  // `most_room` times the entries in use.
  static constexpr u32 most_worse = 2, most_room = 4, worse_anyway = 64;

  struct Cell {
    u32 at, size, room;  // its entries
    u32 dirty;
  };

  Grid<D> grid_;
  Buffer<Cell> cells_;
  Buffer<u32> entries_;  // slots with their marks
  u32 entries_end_ = 0;
  Buffer<f32> boxes_;  // of the last update
  Buffer<u32> tags_;
  Buffer<u8> moved_;  // per slot, whether it changed with this update
  u32 count_ = 0;  // boxes in the cells; 0: a full rebuild is due
  f64 placed_ = 0, tests_ = 0;  // the entries, and the tests if all cells were dirty
  f64 built_placed_ = 0, built_tests_ = 0;  // the same when the cells were built
  f64 effort_ = 0;  // entries visited while boxes were moved
  Buffer<u64> found_;  // the pairs of the last update, in the order of their slots
  u64 found_count_ = 0;
  Pairs fresh_;  // the pairs of the dirty cells
  PairOrder pair_order_;
  // For the search of dirty cells.
  Buffer<u32> picked_, end_;
  Lanes<D> lanes_;

  using Range = typename Grid<D>::Range;

 public:
  void update(const Scene<D>& scene, const Options& options, Pairs& pairs, Stats& stats) {
    SceneItems<D> items{scene, AxisOrder<D>::make(0)};
    if (scene.count == 0 || count_ == 0 || !follow(items)) {
      count_ = 0;
      if (scene.count == 0) return;
      build(items, options);
    }
    stats.entries = placed_;
    search(items, pairs, stats);
  }

  /// The cells with boxes in them.
  SMALL void structure(Buffer<f32>& boxes, u32& count, const Stats& stats) const {
    count = 0;
    boxes.reserve(u64(stats.cells) * 2 * D);
    if (stats.cells == 0) return;
    for (u32 c = 0; c < grid_.total(); c++) {
      if (cells_[c].size > 0) grid_.draw(c, boxes.data() + u64(count++) * 2 * D);
    }
  }

  SMALL void release() {
    cells_.release();
    entries_.release();
    boxes_.release();
    tags_.release();
    moved_.release();
    found_.release();
    fresh_.list.release();
    pair_order_.release();
    found_count_ = 0;
    picked_.release();
    end_.release();
    lanes_.release();
    count_ = 0;
  }

 private:
  /// Copies a box, for comparison in the next update.
  void keep(const Scene<D>& scene, u32 slot) {
    __builtin_memcpy(&boxes_[u64(slot) * 2 * D], scene.boxes + u64(slot) * 2 * D, 2 * D * sizeof(f32));
    tags_[slot] = scene.excluded_of(slot);
  }

  /// Puts all boxes into new cells, with room for more.
  SMALL void build(const SceneItems<D>& items, const Options& options) {
    u32 n = items.scene.count;
    u64 total = grid_.choose(items, n, options, smaller(n, max_slots / 4) * 4);
    u32 cells = grid_.total();
    Axes axes = grid_.axes();
    found_count_ = 0;
    cells_.reserve(cells);
    __builtin_memset(cells_.data(), 0, u64(cells) * sizeof(Cell));
    for (u32 k = 0; k < n; k++) {
      grid_.visit(grid_.range(axes, items[k]), [&](u32 cell, u32) { cells_[cell].room++; });
    }
    u32 at = 0;
    for (u32 c = 0; c < cells; c++) {
      Cell& cell = cells_[c];
      cell.at = at;
      cell.dirty = 1;
      cell.room += cell.room / 2 + 2;
      at += cell.room;
    }
    entries_.reserve(at);
    entries_end_ = at;
    boxes_.reserve(u64(n) * 2 * D + 4);
    tags_.reserve(n);
    __builtin_memset(moved_.reserve(n), 1, n);
    tests_ = 0;
    for (u32 k = 0; k < n; k++) {
      put(grid_.range(axes, items[k]), k);
      keep(items.scene, k);
    }
    built_placed_ = placed_ = f64(total);
    built_tests_ = tests_;
    count_ = n;
  }

  /// Updates the cells for what has changed since the last update; false if a full rebuild is cheaper.
  bool follow(const SceneItems<D>& items) {
    const Scene<D>& scene = items.scene;
    u32 n = scene.count, had = count_;
    if (n > 2 * had || had > 2 * n) return false;
    boxes_.grow(u64(n) * 2 * D + 4, u64(smaller(n, had)) * 2 * D);
    tags_.grow(n, smaller(n, had));
    moved_.reserve(larger(n, had));
    SceneItems<D> old{{boxes_.data(), had, tags_.data()}, items.order};
    Axes axes = grid_.axes();
    effort_ = 0;
    for (u32 k = n; k < had; k++) {
      take(grid_.range(axes, old[k]), k);
      moved_[k] = 1;
    }
    for (u32 k = 0; k < n; k++) {
      Item<D> item = items[k];
      moved_[k] = 1;
      if (k < had) {
        Item<D> before = old[k];
        if (same(item, before)) {
          moved_[k] = 0;
          continue;
        }
        Range range = grid_.range(axes, item), left = grid_.range(axes, before);
        if (!any(bits<i32x4>((range.first ^ left.first) | (range.last ^ left.last)))) {
          grid_.visit(range, [&](u32 cell, u32) { cells_[cell].dirty = 1; });
        } else {
          take(left, k);
          put(range, k);
        }
      } else {
        put(grid_.range(axes, item), k);
      }
      keep(scene, k);
      if (effort_ > most_effort * n || entries_end_ > larger(most_worse * built_placed_, f64(n)) * most_room)
        return false;
    }
    count_ = n;
    return placed_ <= most_worse * built_placed_ + worse_anyway && tests_ <= most_worse * built_tests_ + n;
  }

  /// Puts a slot into its cells.
  NOINLINE void put(const Range& range, u32 slot) {
    grid_.visit(range, [&](u32 c, u32 continues) {
      Cell& cell = cells_[c];
      if (cell.size == cell.room) move(cell);
      cell.dirty = 1;
      tests_ += cell.size;
      entries_[cell.at + cell.size++] = slot | continues;
      placed_++;
      effort_++;
    });
  }

  /// Takes a slot out of its cells.
  NOINLINE void take(const Range& range, u32 slot) {
    grid_.visit(range, [&](u32 c, u32) {
      Cell& cell = cells_[c];
      cell.dirty = 1;
      u32* entries = entries_.data() + cell.at;
      u32 k = 0;
      while ((entries[k] & slot_mask) != slot) k++;
      entries[k] = entries[--cell.size];
      tests_ -= cell.size;
      placed_--;
      effort_ += k;
    });
  }

  /// Moves a full cell behind all others, with twice the room.
  SMALL void move(Cell& cell) {
    u32 room = cell.room * 2;
    entries_.grow(u64(entries_end_) + room, entries_end_);
    __builtin_memcpy(entries_.data() + entries_end_, entries_.data() + cell.at, cell.size * sizeof(u32));
    cell.at = entries_end_;
    cell.room = room;
    entries_end_ += room;
  }

  /// Finds the pairs in the dirty cells.
  void search(const SceneItems<D>& items, Pairs& pairs, Stats& stats) {
    u32 cells = grid_.total();
    u32 picked = 0;
    for (u32 c = 0; c < cells; c++) {
      stats.cells += cells_[c].size > 0;
      picked += cells_[c].dirty ? cells_[c].size : 0;
    }
    picked_.reserve(picked);
    end_.reserve(picked + 4);
    lanes_.reserve(picked);
    picked = 0;
    for (u32 c = 0; c < cells; c++) {
      const Cell& cell = cells_[c];
      if (!cell.dirty) continue;
      u32 end = picked + cell.size;
      stats.tests += f64(cell.size) * (f64(cell.size) - 1) / 2;
      for (u32 k = 0; k < cell.size; k++, picked++) {
        picked_[picked] = entries_[cell.at + k];
        end_[picked] = end;
      }
    }
    lanes_.fill(PickedItems<D>{items, picked_.data()}, picked);
    fresh_.count = 0;
    sweep<D, true>(lanes_, end_.data(), picked, fresh_);
    merge(items.scene.count, pairs);
    for (u32 c = 0; c < cells; c++) cells_[c].dirty = 0;
  }

  /// Merges the previous pairs of boxes at rest with the new pairs of boxes that moved; both are sorted.
  void merge(u32 slots, Pairs& pairs) {
    auto moves = [&](u64 pair) { return bool(moved_[u32(pair)] | moved_[pair >> 32]); };
    u64* fresh = fresh_.list.data();
    u64 count = 0, k = 0, next = 0;
    for (u64 p = 0; p < fresh_.count; p++) {
      fresh[count] = fresh[p];
      count += moves(fresh[p]);
    }
    pair_order_.sort(fresh, count, slots);
    u64* out = pairs.list.grow(found_count_ + count + Pairs::slack, 0);
    while (k < found_count_ && next < count) {
      u64 old = found_[k];
      bool first = PairOrder::key(old) < PairOrder::key(fresh[next]);  // no branch: it would be mispredicted
      *out = first ? old : fresh[next];
      out += !first | !moves(old);
      k += first;
      next += !first;
    }
    for (; k < found_count_; k++) {
      *out = found_[k];
      out += !moves(found_[k]);
    }
    for (; next < count; next++) *out++ = fresh[next];
    pairs.end_at(out);
    found_.reserve(pairs.count);
    if (pairs.count) __builtin_memcpy(found_.data(), pairs.list.data(), pairs.count * sizeof(u64));
    found_count_ = pairs.count;
  }
};
