// The boxes that were set last, on their way to where they stand.
// Idea: of many boxes each is far from the caches, and one call of `set` after the other would wait for it. So a call
// only writes down what it was given; when there are some they are put in their places together, and waited for together.
// Only there is seen whether a box is what it was.
// Cost: 2 ns a call more than without, where boxes are near; of a million it saves a third of a call and more.
#pragma once
#include "changes.hpp"

template <int D> class Inbox {
  static constexpr u32 width = 2 * D;
  static constexpr u32 most = 64;
  f32 boxes_[most * width] = {};
  u32 slots_[most] = {};
  u32 count_ = 0;

 public:
  bool full() const { return count_ == most; }

  /// A box, as its first and its last four numbers.
  void put(u32 slot, f32x4 first, f32x4 last) {
    f32* to = boxes_ + count_ * width;
    store(to, first);
    store(to + width - 4, last);
    slots_[count_++] = slot;
  }

  /// Puts all where they belong, in the order in which they came, and notes which are not what stood there.
  void empty(f32* boxes, Changes& changes) {
    read_rows(boxes, width * sizeof(f32), slots_, count_, 1);
    for (u32 k = 0; k < count_; k++) {
      const f32* from = boxes_ + k * width;
      f32* to = boxes + u64(slots_[k]) * width;
      if (!differ<width * sizeof(f32)>(from, to)) continue;
      changes.note(slots_[k]);
      __builtin_memcpy(to, from, width * sizeof(f32));
    }
    count_ = 0;
  }
};
