// Where boxes were when the last list was made or, if there is none, when samples were taken. The next list compares
// boxes with that: some are at rest, and others have a velocity.
// Cost: a copy of all boxes.
#pragma once
#include "base/heap.hpp"
#include "boxes/box.hpp"
#include "coherence/watch.hpp"

template <int D> class Origins {
  static constexpr u32 width = 2 * D;
  static constexpr u32 padding = 4;  // vector loads may read this many floats past the last box

  Buffer<f32> boxes_;
  u32 count_ = 0, age_ = 0;
  Shift common_;  // the common motion until then

 public:
  SMALL void record(const Scene<D>& scene, const Shift& common) {
    u64 all = u64(scene.count) * width;
    __builtin_memcpy(boxes_.reserve(all + padding), scene.boxes, all * sizeof(f32));
    count_ = scene.count;
    age_ = 0;
    common_ = common;
  }

  /// Counts an update.
  void pass() { age_++; }
  /// The updates since boxes were recorded.
  u32 age() const { return age_; }
  /// The number of boxes that can be compared: none before an update has passed.
  u32 count() const { return age_ > 0 ? count_ : 0; }
  const Shift& common() const { return common_; }
  const f32* box(u32 slot) const { return boxes_.data() + u64(slot) * width; }

  /// Whether a box has not moved. In a world that wraps around, those at its border are never at rest.
  bool has_rested(const Scene<D>& scene, u32 slot) const {
    const f32 *now = scene.box(slot), *was = box(slot);
    u32 rests = (bitmask(load<f32x4>(now) == load<f32x4>(was)) == 15) & u32(scene.is_at_home(slot));
    if constexpr (D == 3) rests &= (bitmask(load<f32x4>(now + D) == load<f32x4>(was + D)) & 7) == 7;
    return rests;
  }

  SMALL void release() {
    boxes_.release();
    count_ = 0;
  }
};
