// A buffer of boxes that were set but are not in the space yet.
// Idea: JavaScript writes each box into this memory itself, and calls the kernel only when the buffer is full, or
// before boxes are read. They are then written to their slots in batches: the slots of many boxes are cache misses, so
// a whole batch is prefetched together. The kernel says which boxes may wait here because flushing them cannot fail:
// those with known ids, and as many new ones as it has room for. All others are flushed alone, at once. If the buffer
// was full before an update, it gets larger, so that all boxes of the next frame wait until its update: then what the
// last update saw need not be copied (see Store::take_for_update).
// Cost: 4 ns per box in the kernel natively, 6 in WebAssembly, if slots are in the cache.
#pragma once
#include "base/simd.hpp"

template <int D> struct Ring {
  static constexpr u32 batch = 64;  // entries
  // As many are still in the first cache when the kernel takes them.
  static constexpr u32 usual_entries = 512;
  static constexpr u32 step = 2 * D + 1;  // numbers per entry: the id, then the box
  static constexpr u32 head = 5;  // what the ring tells: numbers before `few`

  f64 dense;  // the ids 0 … dense - 1 are in the space
  f64 room;  // how many more may be added after them
  f64 pages;  // if ids have gaps: the table of ids that may be set, see Ids::pages; else 0
  f64 usable;  // entries that may be used
  f64 address;  // of the entries. Entry 0 is not used: in JavaScript, index 0 says that the ring is closed
  f64 few[(usual_entries + 1) * step];  // the entries, while there is no larger ring

  /// The first entry.
  f64* first() const { return reinterpret_cast<f64*>(size_t(address)) + step; }
  /// Where the entries are; null: in the ring itself.
  void place(const f64* entries) { address = f64(reinterpret_cast<size_t>(entries ? entries : few)); }

  /// The id of an entry. Adding 2^52 leaves the integer in the low bits: cheaper than a conversion, which would check
  /// its range.
  static u32 id(const f64* entry) { return u32(bits<u64>(*entry + 0x1p52)); }
};
static_assert(offsetof(Ring<2>, few) == Ring<2>::head * sizeof(f64));
