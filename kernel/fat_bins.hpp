// A few fat boxes that come and go, to be searched, in bins along one axis.
// Idea: a box stands in each bin that it touches; two are tested in the first bin that both touch.
// Cost: a bin or two for each search, a quarter of a nanosecond for each box in them.
#pragma once
#include "fat_boxes.hpp"
#include "statistics.hpp"

template <int D> class FatBins {
  static constexpr u32 bins = 32;
  FatBoxes<D, 0> bins_[bins];
  Axis along_;
  int axis_ = 0;

 public:
  /// Chooses the bins; there must be no boxes.
  COLD void divide(int axis, f64 low, f64 high) {
    axis_ = axis;
    along_ = Axis::make(low, high, bins);
  }

  COLD void put(const f32* fat, u32 tag) {
    for (u32 b = bin(fat[axis_]); b <= bin(fat[D + axis_]); b++) bins_[b].put(fat, tag);
  }

  /// Takes away a box that is there.
  COLD void take(const f32* fat, u32 slot) {
    for (u32 b = bin(fat[axis_]); b <= bin(fat[D + axis_]); b++) bins_[b].take(bins_[b].find(slot));
  }

  /// Calls `what` with the slot of each that overlaps this one and may meet this tag, once.
  template <class What> void each_hit(const f32* fat, u32 tag, What what) const {
    u32 first = bin(fat[axis_]), last = bin(fat[D + axis_]);
    for (u32 b = first; b <= last; b++) {
      const FatBoxes<D, 0>& boxes = bins_[b];
      boxes.each_hit(fat, tag, [&](u32 at) {
        if (b == first || bin(boxes.numbers(at)[4 * axis_]) == b) what(boxes.slot(at));
      });
    }
  }

  /// Calls `what` with the slot of each, perhaps several times, and takes away those for which it says so.
  template <class What> COLD void leave(What what) {
    for (FatBoxes<D, 0>& boxes : bins_) {
      for (u32 k = boxes.count; k-- > 0;) {
        if (what(boxes.slot(k))) boxes.take(k);
      }
    }
  }

  COLD void release() {
    for (FatBoxes<D, 0>& boxes : bins_) boxes.release();
  }

 private:
  u32 bin(f32 x) const { return Axes(along_, along_, along_, along_)(splat(x))[0]; }
};
