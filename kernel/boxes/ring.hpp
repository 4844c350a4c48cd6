// Boxes that were set, on their way into the space.
// Idea: JavaScript writes each into this memory by itself and calls the kernel only when there are many, or when
// somebody is about to look. They are then put in their places a batch at a time: of many boxes each is far from the
// caches, and so all of a batch are waited for together. The kernel says what may wait here without being able to
// fail later: boxes whose ids it knows, and as many new ones as it has room for. All others come alone, at once.
// Cost: about 3 ns a box in here, where boxes are near.
#pragma once
#include "base/simd.hpp"

template <int D> struct Ring {
  static constexpr u32 most_entries = 512, batch = 64;  // entries
  static constexpr u32 step = 2 * D + 1;        // numbers in one: the id, then the box

  f64 dense;  // the ids 0 … dense - 1 are in the space
  f64 room;   // so many more may be added behind them
  f64 pages;  // where ids have gaps: a table of the ids that may be set, see Ids::pages; else 0
  f64 entries[most_entries * step];

  /// The id of an entry. It is in the low bits of a number whose last bit is worth 1; a conversion would look for more.
  static u32 id(const f64* entry) { return u32(bits<u64>(*entry + 0x1p52)); }
};
