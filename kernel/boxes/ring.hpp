// A buffer of boxes that were set but are not in the space yet.
// Idea: JavaScript writes each box into this memory itself, and calls the kernel only when the buffer is full, or
// before boxes are read. They are then written to their slots in batches: the slots of many boxes are cache misses, so
// a whole batch is prefetched together. The kernel says which boxes may wait here because flushing them cannot fail:
// those with known ids, and as many new ones as it has room for. All others are flushed alone, at once.
// Cost: about 3 ns per box in the kernel, if slots are in the cache.
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
