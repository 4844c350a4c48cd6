// Finds the items of a strip that touch a box, once the strip is in the order in which it was swept.
// Idea: of each block of 16 items, it is known where all items before it end, and where it and all items behind it
// begin, along the sweep axis. So the blocks before the box and those behind it are skipped.
// Cost: about 0.5 ns per block of the strip, and 1 ns for each item of the blocks that are left; half a byte per item.
#pragma once
#include "base/box_tests.hpp"
#include "boxes/box.hpp"

/// Whether the boxes of two items overlap or touch.
inline bool items_touch(const Item<2>& a, const Item<2>& b) {
  f32x4 facing = __builtin_shufflevector(b.box, b.box, 2, 3, 0, 1);
  return bitmask(turned(bits<i32x4>(a.box)) <= turned(bits<i32x4>(facing))) == 15;
}
inline bool items_touch(const Item<3>& a, const Item<3>& b) {
  return (bitmask((a.first() <= b.high) & (b.first() <= a.high)) & 7) == 7;
}

class StripIndex {
  static constexpr u32 block = 16, compared = 4;  // items; blocks that are compared at once

  // By block. Strips have some more than they need, which are never counted.
  Buffer<f32> ends_, begins_;

  static u64 first_block(u32 strip, u32 begin) { return begin / block + u64(strip) * compared; }

 public:
  /// Makes room for this many strips, and items in all of them.
  SMALL void reserve(u32 strips, u32 items) {
    u64 blocks = first_block(strips, items) + compared;
    ends_.reserve(blocks);
    begins_.reserve(blocks);
  }

  /// Takes in the items of a strip: where they begin and end, followed by three NaN. `begin`: the number of
  /// items in the strips before.
  NOINLINE void add(u32 strip, u32 begin, const f32* lo, const f32* hi, u32 count) {
    f32* ends = ends_.data() + first_block(strip, begin);
    f32* begins = begins_.data() + first_block(strip, begin);
    u32 blocks = (count + block - 1) / block, all = (blocks + compared - 1) & ~(compared - 1);
    f32x4 most = splat(-__builtin_inff()), least = splat(__builtin_inff());
    for (u32 b = 0; b < all; b++) {
      ends[b] = b < blocks ? largest(most) : __builtin_inff();
      for (u32 k = b * block, end = smaller(count, k + block); k < end; k += 4) most = max(load<f32x4>(hi + k), most);
    }
    for (u32 b = all; b-- > 0;) {
      for (u32 k = b * block, end = smaller(count, k + block); k < end; k += 4) least = min(load<f32x4>(lo + k), least);
      begins[b] = b < blocks ? -largest(-least) : __builtin_nanf("");
    }
  }

  /// Writes the slots of a strip's items that touch a box and share none of the `marks` with it; returns how many. `met`
  /// counts those tested.
  template <int D>
  u32 near(u32 strip, u32 begin, const ItemsAt<D>& items, u32 count, const Item<D>& box, u32 marks, u32* out,
           u64& met) const {
    const f32* ends = ends_.data() + first_block(strip, begin);
    const f32* begins = begins_.data() + first_block(strip, begin);
    f32x4 low = splat(box.lo(0)), high = splat(box.hi(0));
    i32x4 before = {}, until = {};
    for (u32 b = 0; b * block < count; b += compared) {
      before -= load<f32x4>(ends + b) < low;
      until -= load<f32x4>(begins + b) <= high;
    }
    u32 skipped = u32(before[0] + before[1] + before[2] + before[3]);
    u32 end = smaller(count, block * u32(until[0] + until[1] + until[2] + until[3]));
    u32 found = 0, k = skipped ? (skipped - 1) * block : 0;
    if (k < end) met += end - k;
    for (; k < end; k++) {
      Item<D> other = items[k];
      u32 tag = tag_of(other);
      out[found] = tag & slot_mask;
      found += items_touch(box, other) & !(tag & marks);
    }
    return found;
  }

  SMALL void release() {
    ends_.release();
    begins_.release();
  }
};
