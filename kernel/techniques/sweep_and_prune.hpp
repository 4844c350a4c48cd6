// Sweep and prune: boxes in order of their minima along one axis; each meets those that start before it ends.
//
// Idea: the axis along which the world is longest, measured in boxes, is swept. The order is retained: boxes move
// little between updates, so it is nearly right, and an insertion sort repairs it in one pass. If too much has changed,
// that stops early: a counting sort then distributes the boxes over as many cells as there are boxes, and an insertion
// sort repairs each cell. If cells are crowded, a radix sort is used. Boxes with equal minima are in the order of their
// slots, so that the order depends on the boxes alone. Few of the boxes that meet on one axis overlap on all, so
// sixteen are tested at a time (quantized_sweep.hpp).
// Cost: update O(n + moves in the order), at most that of one radix sort; pairs O(n * boxes that one meets along the
// axis), which grows with the square root (2D) or the power 2/3 (3D) of n; memory about 65 (2D) or 75 (3D) bytes a box.
// Wins in sparse and long worlds, and when few boxes move. Loses in large square worlds, and most of all in cubes: it
// uses only one axis.
// From: D. Baraff, "Dynamic Simulation of Non-Penetrating Rigid Bodies", 1992; the sweep along one axis with the
// tests of the others at once is C. Ericson, "Real-Time Collision Detection", 2005, 7.5.
#pragma once
#include "base/radix_sort.hpp"
#include "search/quantized_sweep.hpp"
#include "search/options.hpp"
#include "search/stats.hpp"

template <int D> class SweepAndPrune {
  // A repair stops when it has made more than `patience` moves per box it has passed, and `head_start` more.
  static constexpr u32 patience = 2, head_start = 256;

  Buffer<u32> order_;  // the slots 0 … count_ - 1, in the order of the last update
  Buffer<f32> keys_;  // per place in the order, the minimum
  Buffer<u32> cells_, starts_, dealt_order_;
  Buffer<f32> dealt_keys_;
  Lanes<D> lanes_;
  RadixSort sort_;
  QuantizedSweep<D> sweep_;
  u32 count_ = 0;
  int axis_ = 0;

 public:
  void update(const Scene<D>& scene, const Options&, Pairs& pairs, Stats& stats) {
    u32 n = scene.count;
    if (n < 2) return;
    SceneSample<D> world = measure<D>(SceneItems<D>{scene, AxisOrder<D>::make(0)}, n);
    axis_ = world.longest();
    AxisOrder<D> order = AxisOrder<D>::make(axis_);
    take(n);
    keys_.reserve(n + 4);
    lanes_.reserve(n);
    const f32* least = scene.boxes + axis_;
    for (u32 k = 0; k < n; k++) keys_[k] = least[size_t(order_[k]) * 2 * D];
    if (!repair(n) && !(deal(n, world), repair(n))) {
      sort_.begin(n);
      for (u32 k = 0; k < n; k++) sort_.put(k, least[size_t(k) * 2 * D]);
      sort_.sort(n);
      for (u32 k = 0; k < n; k++) order_[k] = sort_.index(k);
    }
    lanes_.fill(PickedItems<D>{{scene, order}, order_.data()}, n);
    stats.tests = f64(sweep_.find(lanes_, world.in(order), 0, n, pairs));
    stats.cells = stats.entries = n;
  }

  /// The interval of each box along the axis.
  SMALL void structure(Buffer<f32>& boxes, u32& count, const Stats& stats) const {
    count = u32(stats.cells);
    boxes.reserve(u64(count) * 2 * D);
    for (u64 k = 0; k < u64(count) * 2 * D; k++) boxes[k] = k % (2 * D) < D ? -__builtin_inff() : __builtin_inff();
    for (u64 k = 0; k < count; k++) {
      boxes[k * 2 * D + axis_] = lanes_.lo(0)[k];
      boxes[k * 2 * D + D + axis_] = lanes_.hi(0)[k];
    }
  }

  SMALL void release() {
    order_.release();
    keys_.release();
    cells_.release();
    starts_.release();
    dealt_order_.release();
    dealt_keys_.release();
    lanes_.release();
    sort_.release();
    sweep_.release();
    count_ = 0;
  }

 private:
  /// Removes deleted slots from the order, and appends new ones.
  void take(u32 n) {
    order_.grow(n, smaller(n, count_));
    u32 kept = 0;
    for (u32 k = 0; k < count_; k++) {
      u32 slot = order_[k];
      order_[kept] = slot;
      kept += slot < n;
    }
    for (; kept < n; kept++) order_[kept] = kept;
    count_ = n;
  }

  /// Distributes the order over cells along the axis.
  void deal(u32 n, const SceneSample<D>& world) {
    u32* cells = cells_.reserve(n + 4);
    u32* starts = starts_.reserve(n);
    __builtin_memset(starts, 0, n * sizeof(u32));
    Axis axis = Axis::make(world.low[axis_], world.high[axis_], n);
    Axes axes(axis, axis, axis, axis);
    for (u32 k = 0; k < n; k += 4) store(cells + k, axes(load<f32x4>(keys_.data() + k)));
    for (u32 k = 0; k < n; k++) starts[cells[k]]++;
    u32 at = 0;
    for (u32 c = 0; c < n; c++) {
      u32 size = starts[c];
      starts[c] = at;
      at += size;
    }
    dealt_keys_.reserve(n + 4);
    dealt_order_.reserve(n);
    for (u32 k = 0; k < n; k++) {
      u32 to = starts[cells[k]]++;
      dealt_keys_[to] = keys_[k];
      dealt_order_[to] = order_[k];
    }
    keys_.swap(dealt_keys_);
    order_.swap(dealt_order_);
  }

  /// Insertion sort of the order by keys, then by slots; false if that would take too long.
  bool repair(u32 n) {
    f32* keys = keys_.data();
    u32* order = order_.data();
    u32 moves = 0;
    for (u32 k = 1; k < n; k++) {
      f32 key = keys[k];
      if (keys[k - 1] < key) continue;
      u32 slot = order[k], at = k;
      auto is_behind = [&](u32 other) { return keys[other] > key || (keys[other] == key && order[other] > slot); };
      for (; at > 0 && is_behind(at - 1); at--) {
        keys[at] = keys[at - 1];
        order[at] = order[at - 1];
      }
      keys[at] = key;
      order[at] = slot;
      moves += k - at;
      if (moves > head_start + patience * k) return false;
    }
    return true;
  }
};
