// A few fat boxes that come and go, to be searched: in rows, in bins along one axis.
// Idea: a box stands in each bin that it touches; two are tested in the first bin that both touch.
// Cost: a bin or two for each search, a quarter of a nanosecond for each box in them.
#pragma once
#include "fat_rows.hpp"
#include "statistics.hpp"

template <int D> class FatBins {
  static constexpr u32 bins = 32;
  FatRows<D, 0> rows_[bins];
  Axis along_;
  int axis_ = 0;

 public:
  /// Chooses the bins; there must be no boxes.
  COLD void divide(int axis, f64 low, f64 high) {
    axis_ = axis;
    along_ = Axis::make(low, high, bins);
  }

  COLD void put(const f32* fat, u32 tag) {
    for (u32 b = bin(fat[axis_]); b <= bin(fat[D + axis_]); b++) rows_[b].put(fat, tag);
  }

  /// Takes away a box that is there.
  COLD void take(const f32* fat, u32 slot) {
    for (u32 b = bin(fat[axis_]); b <= bin(fat[D + axis_]); b++) rows_[b].take(rows_[b].find(slot));
  }

  /// Calls `what` with the slot of each that overlaps this one and may meet this tag, once.
  template <class What> void each_hit(const f32* fat, u32 tag, What what) const {
    u32 first = bin(fat[axis_]), last = bin(fat[D + axis_]);
    for (u32 b = first; b <= last; b++) {
      const FatRows<D, 0>& rows = rows_[b];
      rows.each_hit(fat, tag, [&](u32 at) {
        if (b == first || bin(rows.row(u32(axis_))[at]) == b) what(rows.tags()[at] & slot_mask);
      });
    }
  }

  /// Calls `what` with the slot of each, perhaps several times, and takes away those for which it says so.
  template <class What> COLD void leave(What what) {
    for (FatRows<D, 0>& rows : rows_) {
      for (u32 k = rows.count; k-- > 0;) {
        if (what(rows.tags()[k] & slot_mask)) rows.take(k);
      }
    }
  }

  COLD void release() {
    for (FatRows<D, 0>& rows : rows_) rows.release();
  }

 private:
  u32 bin(f32 x) const { return Axes(along_, along_, along_, along_)(splat(x))[0]; }
};
