// How much memory is reserved ahead: growing it later would detach JavaScript's views. Untouched memory costs nothing.
// The numbers are `stats.bytes` per box in ordinary scenes, and a little more.
#pragma once
#include "boxes/box.hpp"

template <int D> struct RoomAhead {
  // Bytes per box, pairs included, that an update takes in ordinary scenes, and that everything retained takes.
  static constexpr u32 usual = D == 2 ? 448 : 640, kept = D == 2 ? 352 : 640;
  // Bytes for a few more boxes, or for the first filter, double, gap in the ids, or query.
  static constexpr u32 spare = 1 << 17;
  // Bytes for deletions, while events are on: a bit per id, and half as much again where the array has to grow.
  static constexpr u32 deletions = 3 * (max_slots / 16);
  // Bytes for the pairs of boxes that will be written in place, whose positions are not known yet.
  static constexpr u32 in_place = 1 << 18;
  // Bytes per pair of the lookup tables, at most: 20 for partners, 20 for where they begin, 16 for the table of pairs.
  static constexpr u32 lookup = 56;
  // Bytes per box that all arrays of boxes may take as they grow.
  static constexpr u32 most = 2 * (2 * D * (sizeof(f32) + sizeof(f64)) + 24);

  /// Reserves memory for updates of `count` boxes, and `more` bytes. `events`: deletions are recorded.
  SMALL static void take(u64 count, u64 more, bool events) {
    if (events) more += deletions;
    u64 usually = count * usual, all = usually + count * kept;
    heap::reach(larger(usually, all - smaller(all, u64(heap::used))) + more);
  }
};
