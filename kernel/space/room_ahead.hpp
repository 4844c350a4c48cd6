// How much memory is reserved ahead: growing it later would detach JavaScript's views. Untouched memory costs nothing.
// The numbers are `stats.bytes` per box in ordinary scenes, and a little more.
#pragma once
#include "base/heap.hpp"

template <int D> struct RoomAhead {
  // Bytes a box, pairs included, that an update takes in ordinary scenes; and that stand once all is kept.
  static constexpr u32 usual = D == 2 ? 448 : 640, kept = D == 2 ? 352 : 640;
  // Bytes that a few more boxes take, or the first filter, double, gap or question.
  static constexpr u32 spare = 1 << 17;
  // Bytes that the pairs of boxes that are written in place may take, of which nobody knows yet where they stand.
  static constexpr u32 in_place = 1 << 18;
  // Bytes a pair that the tables take in which pairs are looked up.
  static constexpr u32 lookup = 24;
  // Bytes a box that all arrays of boxes may take as they grow.
  static constexpr u32 most = 2 * (2 * D * (sizeof(f32) + sizeof(f64)) + 24);

  /// Takes memory for the updates to come of so many boxes, and so many bytes.
  SMALL static void take(u64 count, u64 more) {
    u64 usually = count * usual, all = usually + count * kept;
    heap::reach(larger(usually, all - smaller(all, u64(heap::used))) + more);
  }
};
