// One list of items, ordered along axis 0 and swept.
// Idea: items are put into as many cells along the sweep axis as there are items, by one counting sort; they are not
// sorted further, since the sweep tests four at a time and a few more candidates cost nothing, while the branches of a
// sort do. If the cells turn out uneven (outliers, clusters), the list is radix-sorted instead.
// Cost: about 10 ns per item, then the tests; 40 (2D) or 64 (3D) bytes an item of the longest list.
#pragma once
#include "base/radix_sort.hpp"
#include "search/quantized_sweep.hpp"

template <int D> class SweepList {
  // Cells hold one item on average. Above this mean of the squared counts, which is twice the tests per item within
  // cells, the list is sorted. That takes as long as about 50 tests per item: docs/decisions/0006-one-inner-loop.md.
  static constexpr u64 uneven = 64;
  // The share of tests that would hit is estimated from this many items, and this many blocks of four for each.
  static constexpr u32 sampled_items = 32, sampled_blocks = 8;

  Items<D> ordered_;
  Lanes<D> lanes_;  // the same items, as the sweep reads them
  Buffer<u32> cells_;  // per item, its cell
  Buffer<u32> starts_;  // per cell, where its items begin; later, where they end
  Buffer<u32> end_;  // per ordered item, the end of its candidates
  RadixSort sort_;
  QuantizedSweep<D> quantized_sweep_;
  // Items that there is memory for. It grows by more than needed, since lists differ in length and using new memory for
  // the first time is slow.
  u32 room_ = 0;

 public:
  /// Room for lists of `count` items.
  void reserve(u32 count) {
    if (count > room_) make_room(count);
  }

  /// Orders the items; returns the number of tests that `find` will make. `world`: where most boxes are, if known; `all`:
  /// the items are all of these boxes.
  u64 order(const ItemsAt<D>& items, u32 count, const SceneSample<D>* world = nullptr, bool all = false) {
    if (count > room_) make_room(room_ ? count + count / 4 : count);
    u32* cells = cells_.data();
    u32* starts = starts_.data();
    __builtin_memset(starts, 0, (count + 1) * sizeof(u32));
    Axis axis = all ? Axis::make(world->low[0], world->high[0], count) : axis_of(items, count, world);
    Axes axes(axis, axis, axis, axis);
    u32 whole = count & ~3u;
    for (u32 k = 0; k < whole; k += 4) {
      u32x4 at = axes(f32x4{items[k].lo(0), items[k + 1].lo(0), items[k + 2].lo(0), items[k + 3].lo(0)});
      store(cells + k, at);
      for (int lane = 0; lane < 4; lane++) starts[at[lane]]++;
    }
    for (u32 k = whole; k < count; k++) starts[cells[k] = axes(splat(items[k].lo(0)))[0]]++;
    u32 at = 0;
    u64 crowd = 0;  // the sum of squared counts: the tests within unsorted cells
    for (u32 c = 0; c < count; c++) {
      u32 size = starts[c];
      starts[c] = at;
      at += size;
      crowd += u64(size) * size;
    }
    ItemsAt<D> ordered(ordered_, 0);
    for (u32 k = 0; k < count; k++) ordered.put(starts[cells[k]]++, items[k]);
    lanes_.fill(ordered, count);

    // starts[c] is now where cell c ends.
    const f32* hi = lanes_.hi(0);
    u32* end = end_.data();
    u64 tests = 0;
    for (u32 k = 0; k < count; k += 4) {
      u32x4 at = axes(load<f32x4>(hi + k));  // past the last item: NaN, for which any cell will do
      u32x4 until = {starts[at[0]], starts[at[1]], starts[at[2]], starts[at[3]]};
      store(end + k, until);
      tests += u64(until[0]) + until[1] + until[2] + until[3];
    }
    // Each item k has end[k] - k - 1. What was added past the last item does not count.
    for (u32 k = count; k % 4 > 0; k++) tests -= end[k];
    tests -= u64(count) * (count + 1) / 2;
    if (crowd > uneven * count && 3 * crowd > tests) return order_by_sorting(items, count);
    return tests;
  }

  /// Puts the items that were ordered last into that order where they came from.
  void put_back(const ItemsAt<D>& items, u32 count) const {
    ItemsAt<D> ordered(ordered_, 0);
    __builtin_memcpy(items.boxes, ordered.boxes, count * (D - 1) * sizeof(f32x4));
    if constexpr (D == 2) __builtin_memcpy(items.tags, ordered.tags, count * sizeof(u32));
  }
  /// The items that were ordered last.
  LaneView<D> view() const { return lanes_.view(); }

  /// Appends the pairs of the items that were ordered last.
  void find(u32 count, Pairs& pairs) const { sweep<D>(lanes_, end_.data(), count, pairs); }

  /// The same for items with many candidates, few of which overlap. `world`: a sample of all items.
  SMALL void find_few(SceneSample<D> world, u32 count, Pairs& pairs)
    requires(D == 3)
  {
    for (int a = 1; a < D; a++) {
      const f32* from = lanes_.lo(a);
      f32x4 least = splat(from[0]), most = least;
      for (u32 k = 0; k < count; k += 4) {
        least = min(load<f32x4>(from + k), least);  // past the last item: NaN, which is ignored
        most = max(load<f32x4>(from + k), most);
      }
      world.low[a] = larger(world.low[a], f64(-largest(-least)));
      world.high[a] = smaller(world.high[a], f64(largest(most)));
    }
    quantized_sweep_.template find<false>(lanes_, world, 0, count, pairs, end_.data());
  }

  /// Estimates, from a sample, which share of the coming sweep's tests would hit.
  SMALL f64 hits(u32 count) const {
    LaneView<D> view = lanes_.view();
    u64 hits = 0, tried = 0;
    u32 stride = larger(1u, count / sampled_items);
    for (u32 i = stride / 2; i < count; i += stride) {
      Probe<D> probe(view, i);
      u32 until = end_[i], step = larger(4u, (until - i) / sampled_blocks);
      for (u32 j = i + 1; j + 4 <= until; j += step) {
        hits += u64(step) * bits_set[bitmask(probe.hits(view, j, load<u32x4>(view.tag + j)))];
        tried += u64(step) * 4;
      }
    }
    return f64(hits) / larger(f64(tried), 1.0);
  }

  SMALL void release() {
    ordered_.release();
    lanes_.release();
    cells_.release();
    starts_.release();
    end_.release();
    sort_.release();
    quantized_sweep_.release();
    room_ = 0;
  }

 private:
  SMALL void make_room(u32 count) {
    room_ = 0;
    lanes_.reserve(count);
    ordered_.grow(count, 0);
    end_.reserve(count + 4);
    cells_.reserve(count);
    starts_.reserve(count + 1);
    room_ = count;
  }

  /// The same by a full sort: for strips where no single cell size fits.
  SMALL u64 order_by_sorting(const ItemsAt<D>& items, u32 count) {
    sort_.begin(count);
    for (u32 k = 0; k < count; k++) sort_.put(k, items[k].lo(0));
    sort_.sort(count);
    ItemsAt<D> ordered(ordered_, 0);
    for (u32 k = 0; k < count; k++) ordered.put(k, items[sort_.index(k)]);
    lanes_.fill(ordered, count);
    const f32* lo = lanes_.lo(0);
    const f32* hi = lanes_.hi(0);
    u32* end = end_.data();
    u64 tests = 0;
    for (u32 k = 0; k < count; k++) {
      // The first item that starts past this one's end: found by doubling steps, then by halving them.
      u32 step = 1, from = k + 1;
      while (from + step <= count && lo[from + step - 1] <= hi[k]) {
        from += step;
        step *= 2;
      }
      u32 to = smaller(from + step, count);
      while (from < to) {
        u32 middle = (from + to) / 2;
        if (lo[middle] <= hi[k]) from = middle + 1;
        else to = middle;
      }
      end[k] = from;
      tests += from - k - 1;
    }
    return tests;
  }

  /// Cells along the sweep axis, as many as there are items, over the range of those that are finite, and in the world.
  NOINLINE static Axis axis_of(const ItemsAt<D>& items, u32 count, const SceneSample<D>* world) {
    f32x4 least = items[0].first(), most = least;
    for (u32 k = 1; k < count; k++) {
      f32x4 x = items[k].first();
      least = min(least, x);
      most = max(most, x);
    }
    f32 low = least[0], high = most[0];
    if (!is_finite(low) || !is_finite(high)) {
      low = __builtin_inff();
      high = -low;
      for (u32 k = 0; k < count; k++) {
        f32 x = items[k].lo(0);
        if (!is_finite(x)) continue;
        low = smaller(low, x);
        high = larger(high, x);
      }
    }
    if (!world || low > world->high[0] || high < world->low[0]) return Axis::make(low, high, count);
    return Axis::make(larger(f64(low), world->low[0]), smaller(f64(high), world->high[0]), count);
  }
};
